// SPDX-License-Identifier: MIT
#include "touchstone/tools/bench/machine.h"

#include <fstream>

namespace touchstone {

std::string ProcessorName() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown processor";
}

std::string VectorClonesInUse() {
#if defined(__x86_64__)
#if !defined(TOUCHSTONE_NO_AVX512)
  if (__builtin_cpu_supports("avx512f")) return "AVX-512";
#endif
  if (__builtin_cpu_supports("avx2")) return "AVX2";
#endif
  return "baseline";
}

}  // namespace touchstone
