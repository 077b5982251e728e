// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_MINKOWSKI_CONE_TREE_H_
#define TOUCHSTONE_CORE_MINKOWSKI_CONE_TREE_H_

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "touchstone/core/minkowski/gauss_map.h"

namespace touchstone {

// A tree of normal cones, eight to a node.
class ConeTree {
 public:
  ConeTree() = default;
  // Over the items listed, item k with cones[items[k]]. Complexity: O(n log n).
  ConeTree(std::span<const NormalCone> cones, std::vector<int> items);

  // The same tree with all axes x turned to rotation * x, for a matrix within 1e-6 of orthonormal
  // (or minus one).
  ConeTree Turned(const Eigen::Matrix3d& rotation) const;

  // Appends every item whose cone holds `direction`, a unit vector within 1e-6, and some others.
  void Along(const Eigen::Vector3d& direction, std::vector<int>* items) const;

  // Appends every item of this tree with every item of the other where their cones meet, and some
  // other pairs.
  void Pairs(const ConeTree& other, std::vector<std::pair<int, int>>* pairs) const;

 private:
  static constexpr int kWidth = 8;
  struct alignas(64) Node {
    double axis[3][kWidth];
    double cosine[kWidth], sine[kWidth];
    std::int32_t children[kWidth];  // a node, or ~item
    int lane_count;
  };

  // Adds a node for some items, and returns a cone round it.
  NormalCone AddNode(std::span<const NormalCone> cones, std::span<int> items);
  static Node LaneAlone(const Node& node, int lane);
  static std::uint8_t LanesAlong(const Node& node, const Eigen::Vector3d& direction);
  static void MeetingCones(const Node& a, const Node& b, std::uint8_t masks[kWidth]);

  std::vector<Node> nodes_;
};

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_MINKOWSKI_CONE_TREE_H_
