// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_CD_DUAL_RAY_FRAME_H_
#define TOUCHSTONE_CORE_CD_DUAL_RAY_FRAME_H_

#include <Eigen/Core>

#include "touchstone/core/cd_dual/minkowski_difference.h"

namespace touchstone {

// A vertex of M in the ray's frame: the ray from c through o is the upward z axis, o at height 0.
struct FramePoint {
  VertexPair pair;
  double x = 0.0, y = 0.0, z = 0.0;
};

// 2-D cross product of the shadows: positive when the ray's axis lies to the left of a -> b, and
// equal to det[a - c, b - c, o - c] over |o - c|.
inline double Turn(const FramePoint& a, const FramePoint& b) { return a.x * b.y - a.y * b.x; }

// M seen along the ray. Where the ray leaves M is a problem of two variables: over the directions
// N = (nx, ny, 1), the height at which the plane that supports M along N meets the axis is
// h(N) = max over M of nx x + ny y + z, convex and piecewise linear, with the shadow (x, y) of the
// supporting vertex as its gradient. Its least value is the height of the exit point.
//
// Directions and points are rounded: what this says is a proposal.
class RayFrame {
 public:
  explicit RayFrame(const MinkowskiDifference& m);

  // The vertex of M that is extreme along (nx, ny, nz). `hint` starts the climbs.
  FramePoint Support(double nx, double ny, double nz, VertexPair hint, PhaseCounts* counts) const;

  // The direction in P's frame.
  Eigen::Vector3d Direction(double nx, double ny, double nz) const {
    return nx * axes_.col(0) + ny * axes_.col(1) + nz * axes_.col(2);
  }

  // Height of c: minus |c|.
  double c_height() const { return -m_.c_norm(); }

  // The second moments of P and of Q in this frame, scaled.
  const Eigen::Matrix3d& moments_p() const { return moments_p_; }
  const Eigen::Matrix3d& moments_q() const { return moments_q_; }

 private:
  const MinkowskiDifference& m_;
  Eigen::Matrix3d axes_;       // columns: the frame's axes in P
  Eigen::Matrix3d axes_in_q_;  // Rᵀ axes
  Eigen::Vector3d offset_;     // axesᵀ t
  Eigen::Matrix3d moments_p_, moments_q_;
};

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_CD_DUAL_RAY_FRAME_H_
