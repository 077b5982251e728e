// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_MESH_FACE_LANES_H_
#define TOUCHSTONE_CORE_MESH_FACE_LANES_H_

#include <Eigen/Core>
#include <span>

#include "touchstone/core/mesh/box_tree.h"

namespace touchstone {

// The faces below a leaf of a tree in lanes, and a slab round them: across `direction`, which may
// be any, their corners' heights lie from `low` to `high`, as rounded: products and sums from left
// to right.
struct alignas(64) FaceLanes {
  double corners[3][3][kTreeWidth];  // of corner k, axis i; unused lanes repeat the first one
  Eigen::Vector3d direction;
  double length;  // the sum of the direction's coordinates, each taken positive
  double low, high;
};

// Sets the slabs of lanes whose corners are set. Requires as many directions as lanes.
void FindSlabs(std::span<const Eigen::Vector3d> directions, std::span<FaceLanes> lanes);

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_MESH_FACE_LANES_H_
