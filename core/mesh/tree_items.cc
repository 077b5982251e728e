// SPDX-License-Identifier: MIT
#include "touchstone/core/mesh/tree_items.h"

namespace touchstone {

using Eigen::Vector3d;

int ItemsOf(const BoxTree& tree, std::span<const Vector3d> points, std::span<const Triangle> faces,
            int code, TreeItem items[kTreeWidth]) {
  if (code < 0) {
    const Triangle& face = faces[~code];
    const Vector3d &a = points[face[0]], &b = points[face[1]], &c = points[face[2]];
    items[0] = {a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c), code};
    return 1;
  }
  const BoxNode& node = tree.node(code);
  for (int lane = 0; lane < node.lane_count; ++lane) {
    items[lane] = {Vector3d(node.low[0][lane], node.low[1][lane], node.low[2][lane]),
                   Vector3d(node.high[0][lane], node.high[1][lane], node.high[2][lane]),
                   node.children[lane]};
  }
  return node.lane_count;
}

}  // namespace touchstone
