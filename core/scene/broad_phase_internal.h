// SPDX-License-Identifier: MIT
//
// Which boxes meet? Three ways to ask, one interface. Items are numbered by the caller, who keeps
// their boxes.
#ifndef TOUCHSTONE_CORE_SCENE_BROAD_PHASE_INTERNAL_H_
#define TOUCHSTONE_CORE_SCENE_BROAD_PHASE_INTERNAL_H_

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "touchstone/core/mesh/box_tree.h"
#include "touchstone/core/scene/options.h"

namespace touchstone::internal {

inline bool Meet(const Box3& a, const Box3& b) {
  return a.low[0] <= b.high[0] && b.low[0] <= a.high[0] && a.low[1] <= b.high[1] &&
         b.low[1] <= a.high[1] && a.low[2] <= b.high[2] && b.low[2] <= a.high[2];
}

class BroadPhaseFinder {
 public:
  virtual ~BroadPhaseFinder() = default;
  // The boxes of these items are new, or the items are.
  virtual void Update(std::span<const Box3> boxes, std::span<const int> items) = 0;
  virtual void Remove(int item) = 0;
  // Appends every pair of one of `items` and any other whose boxes meet, some pairs twice.
  virtual void FindPairs(std::span<const Box3> boxes, std::span<const int> items,
                         std::vector<std::pair<int, int>>* pairs) = 0;
  virtual std::size_t bytes() const = 0;
};

std::unique_ptr<BroadPhaseFinder> MakeBroadPhase(BroadPhase kind);

// A binary tree of boxes. A box that moves stretches its ancestors; the whole tree is made anew
// when half of the items have moved or an eighth were added, which keeps it balanced at O(log n) a
// change. Update: O(log n) an item; FindPairs: O(log n + k) an item.
class BoundingVolumeTree : public BroadPhaseFinder {
 public:
  void Update(std::span<const Box3> boxes, std::span<const int> items) override;
  void Remove(int item) override;
  void FindPairs(std::span<const Box3> boxes, std::span<const int> items,
                 std::vector<std::pair<int, int>>* pairs) override;
  std::size_t bytes() const override;

 private:
  static constexpr int kNone = -1;

  struct Node {
    Box3 box{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
    int parent = kNone;
    int left = kNone, right = kNone;  // children; of a leaf: the item, kNone
  };

  bool IsLeaf(int node) const { return nodes_[node].right == kNone; }
  int NewNode();
  void Insert(int item, const Box3& box);
  // From `node` upwards, each box the union of its children's, until nothing changes.
  void Refit(int node);
  void Rebuild(std::span<const Box3> boxes);
  int BuildNode(std::span<const Box3> boxes, std::span<int> items, int parent);

  std::vector<Node> nodes_;
  std::vector<int> free_, leaf_of_item_, items_, stack_;
  int root_ = kNone;
  int item_count_ = 0;
  int changes_ = 0;  // since the tree was made; an addition counts four times
};

// Boxes sorted by their lower ends along one axis, the one on which they spread most. Update and
// FindPairs: O(n) for the few, O(n log n + k) for all, k counting pairs that meet along the axis.
class Sweep : public BroadPhaseFinder {
 public:
  void Update(std::span<const Box3> boxes, std::span<const int> items) override;
  void Remove(int item) override;
  void FindPairs(std::span<const Box3> boxes, std::span<const int> items,
                 std::vector<std::pair<int, int>>* pairs) override;
  std::size_t bytes() const override;

 private:
  struct Entry {
    double low, high;
    int item;
  };

  void Sort(std::span<const Box3> boxes);

  std::vector<Entry> entries_;
  std::vector<std::uint8_t> is_known_;  // by item
  int axis_ = 0;
  double widest_ = 0.0;
};

// No boxes at all: every two items are a pair.
class AllPairs : public BroadPhaseFinder {
 public:
  void Update(std::span<const Box3> boxes, std::span<const int> items) override;
  void Remove(int item) override;
  void FindPairs(std::span<const Box3> boxes, std::span<const int> items,
                 std::vector<std::pair<int, int>>* pairs) override;
  std::size_t bytes() const override;

 private:
  std::vector<std::uint8_t> is_known_;
};

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_SCENE_BROAD_PHASE_INTERNAL_H_
