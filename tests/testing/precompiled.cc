// SPDX-License-Identifier: MIT
// Nothing: what is wanted are the headers that are precompiled with it (tests/CMakeLists.txt).
