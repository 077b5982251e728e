// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_CD_DUAL_RAY_FRAME_H_
#define TOUCHSTONE_CORE_CD_DUAL_RAY_FRAME_H_

#include <Eigen/Core>
#include <cmath>

#include "touchstone/core/base/lanes.h"
#include "touchstone/core/cd_dual/minkowski_difference.h"

namespace touchstone {

// A vertex of M in the ray's frame: the ray from c through o is the upward z axis, o at height 0.
struct FramePoint {
  int p = 0, q = 0;  // corners (support_table.h) of P and Q
  double x = 0.0, y = 0.0, z = 0.0;
};

// 2-D cross product of the shadows: positive when the ray's axis lies to the left of a -> b, and
// equal to det[a - c, b - c, o - c] over |o - c|.
TOUCHSTONE_INLINE double Turn(const FramePoint& a, const FramePoint& b) {
  return a.x * b.y - a.y * b.x;
}

// M seen along the ray. Where the ray leaves M is a problem of two variables: over the directions
// N = (nx, ny, 1), the height at which the plane that supports M along N meets the axis is
// h(N) = max over M of nx x + ny y + z, convex and piecewise linear, with the shadow (x, y) of the
// supporting vertex as its gradient. Its least value is the height of the exit point.
//
// Directions and points are rounded: what this says is a proposal.
class RayFrame {
 public:
  TOUCHSTONE_INLINE explicit RayFrame(const MinkowskiDifference& m)
      : table_p_(m.p().support_table()), table_q_(m.q().support_table()) {
    const double z[3] = {-m.c()[0] / m.c_norm(), -m.c()[1] / m.c_norm(), -m.c()[2] / m.c_norm()};
    // An orthonormal pair across z (Duff et al. 2017), without a branch on its axis.
    const double sign = std::copysign(1.0, z[2]);
    const double a = -1.0 / (sign + z[2]), b = z[0] * z[1] * a;
    in_p_ << 1.0 + sign * z[0] * z[0] * a, b, z[0],  //
        sign * b, sign + z[1] * z[1] * a, z[1],      //
        -sign * z[0], -z[1], z[2];
    const Eigen::Matrix3d& r = m.pose().rotation();
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        in_q_(i, j) = r(0, i) * in_p_(0, j) + r(1, i) * in_p_(1, j) + r(2, i) * in_p_(2, j);
      }
      const Eigen::Vector3d& t = m.pose().translation();
      offset_[i] = m.scale() * (in_p_(0, i) * t[0] + in_p_(1, i) * t[1] + in_p_(2, i) * t[2]);
    }
    point_p_ = m.scale() * in_p_;
    point_q_ = m.scale() * in_q_;
  }

  // A vertex of M that is extreme along (nx, ny, nz), or nearly: one look at each body's table.
  TOUCHSTONE_INLINE FramePoint Look(double nx, double ny, double nz) const {
    const Eigen::Vector3d p = Along(in_p_, nx, ny, nz), q = Along(in_q_, nx, ny, nz);
    return Point(table_p_.Look(p[0], p[1], p[2]), table_q_.Look(-q[0], -q[1], -q[2]));
  }

  TOUCHSTONE_INLINE FramePoint Point(int p, int q) const {
    const SupportTable::Corner& a = table_p_.corner(p);
    const SupportTable::Corner& b = table_q_.corner(q);
    return {p, q, Coordinate(0, a, b), Coordinate(1, a, b), Coordinate(2, a, b)};
  }

  // From `start` on, by climbs that no neighbour beats.
  FramePoint Climb(double nx, double ny, double nz, const FramePoint& start, int* steps) const {
    const Eigen::Vector3d n(nx, ny, nz);
    return Point(table_p_.Climb(start.p, in_p_ * n, steps).corner,
                 table_q_.Climb(start.q, -(in_q_ * n), steps).corner);
  }

  // The direction in P's frame.
  Eigen::Vector3d Direction(double nx, double ny, double nz) const {
    return in_p_ * Eigen::Vector3d(nx, ny, nz);
  }

  const Eigen::Matrix3d& in_p() const { return in_p_; }
  const Eigen::Matrix3d& in_q() const { return in_q_; }

 private:
  static TOUCHSTONE_INLINE Eigen::Vector3d Along(const Eigen::Matrix3d& axes, double x, double y,
                                                 double z) {
    return {x * axes(0, 0) + y * axes(0, 1) + z * axes(0, 2),
            x * axes(1, 0) + y * axes(1, 1) + z * axes(1, 2),
            x * axes(2, 0) + y * axes(2, 1) + z * axes(2, 2)};
  }

  // In an order with short chains; the scale is a power of two, so that it rounds nothing.
  TOUCHSTONE_INLINE double Coordinate(int i, const SupportTable::Corner& a,
                                      const SupportTable::Corner& b) const {
    return ((point_p_(0, i) * a.x + point_p_(1, i) * a.y) + (point_p_(2, i) * a.z - offset_[i])) -
           ((point_q_(0, i) * b.x + point_q_(1, i) * b.y) + point_q_(2, i) * b.z);
  }

  const SupportTable& table_p_;
  const SupportTable& table_q_;
  Eigen::Matrix3d in_p_;               // columns: the frame's axes in P
  Eigen::Matrix3d in_q_;               // the same seen from Q: Rᵀ in_p_
  Eigen::Matrix3d point_p_, point_q_;  // the same, scaled
  Eigen::Vector3d offset_;             // in_p_ᵀ t, scaled
};

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_CD_DUAL_RAY_FRAME_H_
