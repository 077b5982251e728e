// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_MESH_BOX_TREE_H_
#define TOUCHSTONE_CORE_MESH_BOX_TREE_H_

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace touchstone {

using Triangle = std::array<int, 3>;

inline constexpr int kTreeWidth = 8;

// Eight boxes, their coordinates in lanes. Lane l holds a box of faces below node children[l], or
// of the single face ~children[l]. Unused lanes come last and hold boxes that nothing meets.
struct alignas(64) BoxNode {
  double low[3][kTreeWidth];
  double high[3][kTreeWidth];
  std::int32_t children[kTreeWidth];
  int lane_count;
};

// Which lanes of one node meet which of the other, moved by `offset`: bit i of masks[j] for lane i
// of `a` and lane j of `b`. Boxes that come within `margin` of each other along every axis count.
void MeetingLanes(const BoxNode& a, const BoxNode& b, const Eigen::Vector3d& offset, double margin,
                  std::uint8_t masks[kTreeWidth]);

// A tree of axis-parallel boxes over the faces of a mesh. Its shape is made once, from the body's
// own frame; the boxes are fitted again wherever the body is placed.
class BoxTree {
 public:
  BoxTree() = default;
  // Complexity: O(n log n).
  BoxTree(std::span<const Eigen::Vector3d> points, std::span<const Triangle> faces);

  // Fits the boxes to the points, whose number and faces are those of the construction: closed
  // boxes of the doubles as they are. Complexity: O(n).
  void Fit(std::span<const Eigen::Vector3d> points, std::span<const Triangle> faces);

  // Node 0 is the root; children come after their parents.
  std::span<const BoxNode> nodes() const { return nodes_; }
  const BoxNode& node(int i) const { return nodes_[i]; }
  // The box of everything.
  const Eigen::Vector3d& low() const { return low_; }
  const Eigen::Vector3d& high() const { return high_; }

 private:
  int AddNode(std::span<const Eigen::Vector3d> points, std::span<const Triangle> faces,
              std::span<int> members);

  std::vector<BoxNode> nodes_;
  Eigen::Vector3d low_ = Eigen::Vector3d::Zero(), high_ = Eigen::Vector3d::Zero();
};

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_MESH_BOX_TREE_H_
