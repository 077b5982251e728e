// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_MINKOWSKI_BOX_LANES_INTERNAL_H_
#define TOUCHSTONE_CORE_MINKOWSKI_BOX_LANES_INTERNAL_H_

#include <span>
#include <vector>

#include "touchstone/core/mesh/box_tree.h"

namespace touchstone::internal {

// Boxes in lanes of eight, and boxes round eight of them in lanes of eight again, for questions too
// few to repay a tree: best where boxes listed one after the other are near each other. Infinite
// and NaN bounds meet all.
class BoxLanes {
 public:
  BoxLanes() = default;
  explicit BoxLanes(std::span<const Box3> boxes) {
    for (const Box3& box : boxes) Add(box);
  }

  void Clear();
  void Add(const Box3& box);
  bool empty() const { return count_ == 0; }
  // Appends the numbers of the boxes that meet this one, in order. Complexity: O(n / 64 + k) for k
  // blocks of eight that come near.
  void Meeting(const Box3& box, std::vector<int>* hits) const;
  bool MeetsAny(const Box3& box) const;

 private:
  struct alignas(64) Lanes {
    double low[3][kTreeWidth], high[3][kTreeWidth];
  };
  static unsigned Mask(const Lanes& lanes, const Box3& box);
  // The first `count` of them.
  static unsigned Mask(const Lanes& lanes, int count, const Box3& box) {
    return Mask(lanes, box) & (count < kTreeWidth ? (1u << count) - 1 : ~0u);
  }
  static Lanes& LanesAt(int lane, std::vector<Lanes>* lanes);

  std::vector<Lanes> lanes_;
  std::vector<Lanes> blocks_;  // lane l of entry k: round all lanes of lanes_[8 k + l]
  int count_ = 0;
};

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_MINKOWSKI_BOX_LANES_INTERNAL_H_
