// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_MESH_NEAREST_POINTS_H_
#define TOUCHSTONE_CORE_MESH_NEAREST_POINTS_H_

#include <Eigen/Core>
#include <array>
#include <limits>

namespace touchstone {

// A point of each of two triangles: a corner plus the sides times weights in [0, 1] that add up to
// one at most but for a unit. With coordinates of at most one, sides of length two at most along
// each axis are rounded once (2 units), times a weight (2), the weights' unit (2), added up (4):
// each point is on its triangle but for 10 units.
struct NearestPoints {
  Eigen::Vector3d x = Eigen::Vector3d::Zero(), y = Eigen::Vector3d::Zero();
  double squared = std::numeric_limits<double>::infinity();  // |y - x|^2 in doubles

  void Offer(const Eigen::Vector3d& on_a, const Eigen::Vector3d& on_b);
};

// The nearest points of two triangles that do not meet, in doubles: where sides come nearest to
// each other, and corners to the faces under them. A guess, for the caller to prove. Where
// triangles meet, points of their boundaries.
NearestPoints NearestPointsOf(const std::array<Eigen::Vector3d, 3>& a,
                              const std::array<Eigen::Vector3d, 3>& b);

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_MESH_NEAREST_POINTS_H_
