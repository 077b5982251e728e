// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_CONVEX_BOUNDING_ELLIPSOID_H_
#define TOUCHSTONE_CORE_CONVEX_BOUNDING_ELLIPSOID_H_

#include <Eigen/Core>
#include <span>

namespace touchstone {

// A symmetric 3 x 3 matrix.
struct Symmetric3 {
  double xx = 1.0, xy = 0.0, xz = 0.0, yy = 1.0, yz = 0.0, zz = 1.0;
};

// An ellipsoid and a ball around a body's first interior point m: every point x of the body is
// m + factor y + z with |y| <= radius and |z| <= slack, and |x - m| <= ball_radius. Bounds, valid
// in any rounding mode. So along a direction n the body reaches no further than
//   n.m + radius |factorᵀ n| + slack |n|.
// moments = factor factorᵀ up to rounding, three times the covariance of the vertices: exact, with
// radius 1, for points spread evenly over an ellipsoid. That makes sqrt(n.moments n) the searches'
// guess of the reach.
struct BoundingEllipsoid {
  // Row and column; lower triangular, with positive diagonal.
  double factor_xx = 1.0, factor_yx = 0.0, factor_zx = 0.0, factor_yy = 1.0, factor_zy = 0.0,
         factor_zz = 1.0;
  Symmetric3 moments;
  double radius = 0.0;
  double slack = 0.0;
  double ball_radius = 0.0;
};

// Complexity: O(n).
BoundingEllipsoid BoundVertices(std::span<const Eigen::Vector3d> vertices,
                                const Eigen::Vector3d& middle);

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_CONVEX_BOUNDING_ELLIPSOID_H_
