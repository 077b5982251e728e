// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_BENCH_MACHINE_H_
#define TOUCHSTONE_TOOLS_BENCH_MACHINE_H_

#include <string>

namespace touchstone {

// The processor's name, and which of the clones of core/base/vector_clones.h the loader picked.
std::string ProcessorName();
std::string VectorClonesInUse();

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_BENCH_MACHINE_H_
