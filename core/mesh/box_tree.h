// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_MESH_BOX_TREE_H_
#define TOUCHSTONE_CORE_MESH_BOX_TREE_H_

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace touchstone {

using Triangle = std::array<int, 3>;
struct FaceLanes;

// A closed box, its sides parallel to the axes.
struct Box3 {
  Eigen::Vector3d low, high;
};

inline constexpr int kTreeWidth = 8;

// Eight boxes, their coordinates in lanes. Lane l holds a box round node children[l], or that of
// the single item ~children[l]; of a tree's nodes the leaves hold items only, the others none.
// Unused lanes come last and hold boxes that nothing meets. `whole` holds all lanes; unless it is
// set, all of space.
struct alignas(64) BoxNode {
  double low[3][kTreeWidth];
  double high[3][kTreeWidth];
  std::int32_t children[kTreeWidth];
  int lane_count;
  int leaf = -1;  // which leaf of the tree it is, if it is one
  Box3 whole = {Eigen::Vector3d::Constant(-std::numeric_limits<double>::infinity()),
                Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity())};
};

// Which lanes of one node meet which of the other, moved by `offset`: bit i of masks[j] for lane i
// of `a` and lane j of `b`. Boxes that come within `margin` of each other along every axis count.
void MeetingLanes(const BoxNode& a, const BoxNode& b, const Eigen::Vector3d& offset, double margin,
                  std::uint8_t masks[kTreeWidth]);

// A tree of boxes, over the faces of a mesh or other items. Its shape is made once; the boxes may
// be fitted again wherever the items are placed.
class BoxTree {
 public:
  BoxTree() = default;
  // Item i is faces[i], or boxes[i]. Complexity: O(n log n).
  BoxTree(std::span<const Eigen::Vector3d> points, std::span<const Triangle> faces);
  explicit BoxTree(std::span<const Box3> boxes);

  // Fits the boxes to the points, whose number and faces are those of the construction: closed
  // boxes of the doubles as they are. Sets the corners of lanes[l] to those of the faces of leaf l.
  // Complexity: O(n).
  void Fit(std::span<const Eigen::Vector3d> points, std::span<const Triangle> faces,
           std::span<FaceLanes> lanes);

  // Appends all pairs i < j of items whose boxes meet. Complexity: O(n log n + k) for k pairs of
  // items of similar size.
  void MeetingItems(std::vector<std::pair<int, int>>* pairs) const;

  // Node 0 is the root; children come after their parents.
  std::span<const BoxNode> nodes() const { return nodes_; }
  const BoxNode& node(int i) const { return nodes_[i]; }
  int leaf_count() const { return leaf_count_; }
  // The box of everything.
  const Eigen::Vector3d& low() const { return all_.low; }
  const Eigen::Vector3d& high() const { return all_.high; }

 private:
  int AddNode(std::span<const Box3> boxes, std::span<int> members);
  template <class FitLeaf>
  void FitBoxes(const FitLeaf& fit_leaf);

  std::vector<BoxNode> nodes_;
  int leaf_count_ = 0;
  Box3 all_{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
};

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_MESH_BOX_TREE_H_
