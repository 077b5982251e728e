// SPDX-License-Identifier: MIT
//
// Eight numbers side by side, in the compiler's own vectors. Left to itself it gathers masks lane
// by lane in clones, and so it does with comparisons of such vectors: what is less is told by the
// sign bits of differences. None is returned: how it would be depends on the clone.
#ifndef TOUCHSTONE_CORE_MESH_LANES_INTERNAL_H_
#define TOUCHSTONE_CORE_MESH_LANES_INTERNAL_H_

#include <Eigen/Core>
#include <cstdint>
#include <cstring>

#include "touchstone/core/base/vector_clones.h"
#include "touchstone/core/mesh/box_tree.h"

namespace touchstone::internal {

using Reals = double __attribute__((vector_size(8 * kTreeWidth), may_alias));
using Flags = std::uint64_t __attribute__((vector_size(8 * kTreeWidth)));
using Bytes = std::uint8_t __attribute__((vector_size(kTreeWidth)));

// Bit j: whether bit 63 of lane j is clear.
TOUCHSTONE_INLINE std::uint64_t ClearLanes(const Flags& flags) {
  const Flags bits = {1, 2, 4, 8, 16, 32, 64, 128};
  const Bytes bytes = __builtin_convertvector(((flags >> 63) - 1) & bits, Bytes);
  std::uint64_t all;
  std::memcpy(&all, &bytes, sizeof all);
  return all * 0x0101010101010101 >> 56;
}

// The same in halves: vectors of eight that the processor lacks GCC 12 keeps in memory.
using HalfReals = double __attribute__((vector_size(4 * kTreeWidth), may_alias));
using HalfFlags = std::uint64_t __attribute__((vector_size(4 * kTreeWidth)));
TOUCHSTONE_INLINE std::uint64_t ClearLanes(const HalfFlags& low, const HalfFlags& high) {
  const HalfFlags low_bits = {1, 2, 4, 8}, high_bits = {16, 32, 64, 128};
  const HalfFlags bits = (((low >> 63) - 1) & low_bits) | (((high >> 63) - 1) & high_bits);
  return bits[0] | bits[1] | bits[2] | bits[3];
}

// The least of all lows and the greatest of all highs.
TOUCHSTONE_INLINE void FindExtent(const double low[kTreeWidth], const double high[kTreeWidth],
                                  double* lowest, double* highest) {
  double lows[4], highs[4];
  for (int i = 0; i < 4; ++i) {
    lows[i] = low[i] < low[i + 4] ? low[i] : low[i + 4];
    highs[i] = high[i] < high[i + 4] ? high[i + 4] : high[i];
  }
  const double l0 = lows[0] < lows[1] ? lows[0] : lows[1],
               l1 = lows[2] < lows[3] ? lows[2] : lows[3],
               h0 = highs[0] < highs[1] ? highs[1] : highs[0],
               h1 = highs[2] < highs[3] ? highs[3] : highs[2];
  *lowest = l0 < l1 ? l0 : l1;
  *highest = h0 < h1 ? h1 : h0;
}

struct Lanes {
  Reals low_x, low_y, low_z, high_x, high_y, high_z;
};

// The node's boxes, moved and grown. (Axis by axis: of loops GCC 12 keeps the vectors in memory.)
TOUCHSTONE_INLINE void Move(const BoxNode& node, const Eigen::Vector3d& offset, double margin,
                            Lanes* moved) {
  const auto* low = reinterpret_cast<const Reals*>(node.low);
  const auto* high = reinterpret_cast<const Reals*>(node.high);
  moved->low_x = low[0] + offset[0] - margin;
  moved->low_y = low[1] + offset[1] - margin;
  moved->low_z = low[2] + offset[2] - margin;
  moved->high_x = high[0] + offset[0] + margin;
  moved->high_y = high[1] + offset[1] + margin;
  moved->high_z = high[2] + offset[2] + margin;
}

// Bit 63 of each lane: whether it misses the box.
TOUCHSTONE_INLINE void FindMisses(const Lanes& lanes, const double low[3], const double high[3],
                                  Flags* misses) {
  *misses = (Flags)(lanes.high_x - low[0]) | (Flags)(high[0] - lanes.low_x) |
            (Flags)(lanes.high_y - low[1]) | (Flags)(high[1] - lanes.low_y) |
            (Flags)(lanes.high_z - low[2]) | (Flags)(high[2] - lanes.low_z);
}

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_MESH_LANES_INTERNAL_H_
