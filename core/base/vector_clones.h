// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_BASE_VECTOR_CLONES_H_
#define TOUCHSTONE_CORE_BASE_VECTOR_CLONES_H_

// TOUCHSTONE_VECTOR_CLONES before a function compiles it several times, for AVX-512, AVX2 and the
// baseline, and lets the loader pick by the processor. Only for loops over lanes that the compiler
// vectorises; operations and their order are the same in every clone (no contraction to fused
// multiply-add), and so are the results, bit for bit.
//
// TOUCHSTONE_NO_AVX512 leaves the first out, to time what processors without it would do;
// TOUCHSTONE_HAS_AVX512_CLONES tells that it is there.
//
// Left out where the loader's choice does not get along with the tool: sanitizers, other compilers.
#if defined(__x86_64__) && defined(__gnu_linux__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#ifdef TOUCHSTONE_NO_AVX512
#define TOUCHSTONE_VECTOR_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define TOUCHSTONE_VECTOR_CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
#define TOUCHSTONE_HAS_AVX512_CLONES
#endif
#else
#define TOUCHSTONE_VECTOR_CLONES
#endif

// What such a function calls must become part of it, or it would not be compiled with it.
#define TOUCHSTONE_INLINE __attribute__((always_inline)) inline

#endif  // TOUCHSTONE_CORE_BASE_VECTOR_CLONES_H_
