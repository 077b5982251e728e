// SPDX-License-Identifier: MIT
#include "touchstone/core/cd_dual/ray_frame.h"

#include <Eigen/Geometry>
#include <cmath>

#include "touchstone/core/convex/support.h"

namespace touchstone {
namespace {

// An orthonormal pair across the unit vector z (Duff et al. 2017), without a branch on its axis.
void CompleteFrame(Eigen::Matrix3d* axes) {
  const Eigen::Vector3d z = axes->col(2);
  const double sign = std::copysign(1.0, z[2]);
  const double a = -1.0 / (sign + z[2]), b = z[0] * z[1] * a;
  axes->col(0) << 1.0 + sign * z[0] * z[0] * a, sign * b, -sign * z[0];
  axes->col(1) << b, sign + z[1] * z[1] * a, -z[1];
}

}  // namespace

RayFrame::RayFrame(const MinkowskiDifference& m) : m_(m) {
  axes_.col(2) = -m.c() / m.c_norm();
  CompleteFrame(&axes_);
  axes_in_q_.noalias() = m.pose().rotation().transpose() * axes_;
  offset_.noalias() = axes_.transpose() * m.pose().translation();
  const double squared_scale = m.scale() * m.scale();
  const auto in_frame = [squared_scale](const Eigen::Matrix3d& axes,
                                        const Eigen::Matrix3d& moments) {
    const Eigen::Matrix3d half = moments * axes;
    return Eigen::Matrix3d(squared_scale * (axes.transpose() * half));
  };
  moments_p_ = in_frame(axes_, m.p().second_moments());
  moments_q_ = in_frame(axes_in_q_, m.q().second_moments());
}

FramePoint RayFrame::Support(double nx, double ny, double nz, VertexPair hint,
                             PhaseCounts* counts) const {
  ++counts->support_calls;
  const Eigen::Vector3d n(nx, ny, nz);
  FramePoint point;
  point.pair = {SupportVertex(m_.p(), axes_ * n, hint.p, &counts->climb_steps),
                SupportVertex(m_.q(), -(axes_in_q_ * n), hint.q, &counts->climb_steps)};
  const Eigen::Vector3d w =
      m_.scale() * (axes_.transpose() * m_.p().vertex(point.pair.p) -
                    axes_in_q_.transpose() * m_.q().vertex(point.pair.q) - offset_);
  point.x = w[0];
  point.y = w[1];
  point.z = w[2];
  return point;
}

}  // namespace touchstone
