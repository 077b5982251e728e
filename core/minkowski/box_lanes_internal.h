// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_MINKOWSKI_BOX_LANES_INTERNAL_H_
#define TOUCHSTONE_CORE_MINKOWSKI_BOX_LANES_INTERNAL_H_

#include <span>
#include <vector>

#include "touchstone/core/mesh/box_tree.h"

namespace touchstone::internal {

// Boxes in lanes of eight, for questions too few to repay a tree. Infinite and NaN bounds meet all.
class BoxLanes {
 public:
  BoxLanes() = default;
  explicit BoxLanes(std::span<const Box3> boxes) {
    for (const Box3& box : boxes) Add(box);
  }

  void Clear();
  void Add(const Box3& box);
  bool empty() const { return count_ == 0; }
  // Appends the numbers of the boxes that meet this one, in order. Complexity: O(n / 8).
  void Meeting(const Box3& box, std::vector<int>* hits) const;
  bool MeetsAny(const Box3& box) const;

 private:
  struct alignas(64) Lanes {
    double low[3][kTreeWidth], high[3][kTreeWidth];
  };
  static unsigned Mask(const Lanes& lanes, const Box3& box);

  std::vector<Lanes> lanes_;
  int count_ = 0;
};

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_MINKOWSKI_BOX_LANES_INTERNAL_H_
