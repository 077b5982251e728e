// SPDX-License-Identifier: MIT
#include "touchstone/tools/engines/scan_support.h"

#include <cstring>

#include "touchstone/core/base/vector_clones.h"

namespace touchstone {
namespace {

// Eight at a time: a register of AVX-512; narrower processors take it in pieces.
using Lanes = double __attribute__((vector_size(8 * sizeof(double))));
using Places = long __attribute__((vector_size(8 * sizeof(long))));

// Vectors are handed back through references: how a return value travels depends on the clone.
template <class Block>
[[gnu::always_inline]] inline void Heights(const Block& block, double nx, double ny, double nz,
                                           Lanes& heights) {
  Lanes x, y, z;
  std::memcpy(&x, block.x, sizeof x);
  std::memcpy(&y, block.y, sizeof y);
  std::memcpy(&z, block.z, sizeof z);
  heights = nx * x + ny * y + nz * z;
}

[[gnu::always_inline]] inline void Raise(Lanes& highest, Places& where, const Lanes& heights,
                                         const Places& here) {
  const Places better = heights > highest;
  highest = better ? heights : highest;
  where = better ? here : where;
}

}  // namespace

// A vertex with the largest dot product. Requires count > 0.
TOUCHSTONE_VECTOR_CLONES
std::size_t ScanSupport::Scan(const Block* blocks, std::size_t count, double nx, double ny,
                              double nz) {
  // Two at a time, so that a comparison need not wait for the one before.
  Lanes even, odd, heights;
  Heights(blocks[0], nx, ny, nz, even);
  odd = even;
  Places where_even = {0, 1, 2, 3, 4, 5, 6, 7};
  Places where_odd = where_even;
  Places here = where_even + kLanes;
  std::size_t i = 1;
  for (; i + 1 < count; i += 2) {
    Heights(blocks[i], nx, ny, nz, heights);
    Raise(odd, where_odd, heights, here);
    here += kLanes;
    Heights(blocks[i + 1], nx, ny, nz, heights);
    Raise(even, where_even, heights, here);
    here += kLanes;
  }
  if (i < count) {
    Heights(blocks[i], nx, ny, nz, heights);
    Raise(odd, where_odd, heights, here);
  }
  Raise(even, where_even, odd, where_odd);
  double top = even[0];
  long place = where_even[0];
  for (int k = 1; k < kLanes; ++k) {
    const bool better = even[k] > top;
    top = better ? even[k] : top;
    place = better ? where_even[k] : place;
  }
  return static_cast<std::size_t>(place);
}

ScanSupport::ScanSupport(const ConvexPolyhedron& body) {
  const int n = body.vertex_count();
  for (int begin = 0; begin < n; begin += kLanes) {
    Block& block = blocks_.emplace_back();
    for (int k = 0; k < kLanes; ++k) {
      const Eigen::Vector3d& v = body.vertex(begin + k < n ? begin + k : 0);
      block.x[k] = v[0];
      block.y[k] = v[1];
      block.z[k] = v[2];
    }
  }
}

int ScanSupport::Find(const Eigen::Vector3d& direction) const {
  // What fills up the last block stands for vertex 0, which comes first.
  return static_cast<int>(
      Scan(blocks_.data(), blocks_.size(), direction[0], direction[1], direction[2]));
}

}  // namespace touchstone
