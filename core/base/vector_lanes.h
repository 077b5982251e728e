// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_BASE_VECTOR_LANES_H_
#define TOUCHSTONE_CORE_BASE_VECTOR_LANES_H_

#include <cstdint>
#include <cstring>

#include "touchstone/core/base/vector_clones.h"

// Eight doubles in the compiler's own vectors, for functions with TOUCHSTONE_VECTOR_CLONES: left to
// itself it runs such loops lane by lane at -O2, and comparisons of vectors, too; so what holds is
// told by sign bits. Vectors go by pointer: how they would be returned depends on the clone.
namespace touchstone::lanes {

inline constexpr int kWidth = 8;
using Reals = double __attribute__((vector_size(8 * kWidth)));
using Flags = std::int64_t __attribute__((vector_size(8 * kWidth)));

TOUCHSTONE_INLINE void Load(const double* from, Reals* to) { std::memcpy(to, from, sizeof *to); }
TOUCHSTONE_INLINE void Store(const Reals& from, double* to) { std::memcpy(to, &from, sizeof from); }
TOUCHSTONE_INLINE void LoadThree(const double (*from)[kWidth], Reals to[3]) {
  for (int k = 0; k < 3; ++k) Load(from[k], &to[k]);
}

// All bits of a lane where its sign bit is set, none elsewhere.
TOUCHSTONE_INLINE void SpreadSigns(const Reals& signs, Flags* mask) { *mask = (Flags)signs >> 63; }

// Lanes of `yes` where the mask is set, of `no` elsewhere.
TOUCHSTONE_INLINE void Choose(const Flags& mask, const Reals& yes, const Reals& no, Reals* chosen) {
  *chosen = (Reals)((mask & (Flags)yes) | (~mask & (Flags)no));
}

}  // namespace touchstone::lanes

#endif  // TOUCHSTONE_CORE_BASE_VECTOR_LANES_H_
