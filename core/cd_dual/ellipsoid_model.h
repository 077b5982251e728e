// SPDX-License-Identifier: MIT
//
// M as the bodies' balls and ellipsoids see it (bounding_ellipsoid.h): where its exit should be,
// and what can be proven without a look at a vertex.
#ifndef TOUCHSTONE_CORE_CD_DUAL_ELLIPSOID_MODEL_H_
#define TOUCHSTONE_CORE_CD_DUAL_ELLIPSOID_MODEL_H_

#include <Eigen/Core>
#include <cmath>

#include "touchstone/core/base/lanes.h"
#include "touchstone/core/cd_dual/minkowski_difference.h"

namespace touchstone {

// Everything scaled as `m` is. Requires the central interior points as c for its proofs.
class EllipsoidModel {
 public:
  TOUCHSTONE_INLINE explicit EllipsoidModel(const MinkowskiDifference& m)
      : m_(m), p_(m.p().bounding_ellipsoid()), q_(m.q().bounding_ellipsoid()) {
    const Eigen::Matrix3d& r = m.pose().rotation();
    const double s = m.scale();
    double factor[3][3];  // R L_Q
    for (int i = 0; i < 3; ++i) {
      const double x = s * r(i, 0), y = s * r(i, 1), z = s * r(i, 2);
      factor[i][0] = x * q_.factor_xx + y * q_.factor_yx + z * q_.factor_zx;
      factor[i][1] = y * q_.factor_yy + z * q_.factor_zy;
      factor[i][2] = z * q_.factor_zz;
    }
    const auto dot = [&](int i, int j) {
      return factor[i][0] * factor[j][0] + factor[i][1] * factor[j][1] +
             factor[i][2] * factor[j][2];
    };
    moments_q_ = {dot(0, 0), dot(0, 1), dot(0, 2), dot(1, 1), dot(1, 2), dot(2, 2)};
    const double s2 = s * s;
    const Symmetric3& a = p_.moments;
    moments_p_ = {s2 * a.xx, s2 * a.xy, s2 * a.xz, s2 * a.yy, s2 * a.yz, s2 * a.zz};
  }

  // The normal, of any length, with which the ray from c through o leaves the ellipsoid whose
  // moments are the sum of the bodies': adj(S) (-c).
  TOUCHSTONE_INLINE Eigen::Vector3d ExitNormal() const {
    const Symmetric3 s = Sum(1.0, 1.0);
    const double x = -m_.c()[0], y = -m_.c()[1], z = -m_.c()[2];
    const double xy = s.xz * s.yz - s.xy * s.zz, xz = s.xy * s.yz - s.xz * s.yy,
                 yz = s.xy * s.xz - s.xx * s.yz;
    return {(s.yy * s.zz - s.yz * s.yz) * x + xy * y + xz * z,
            xy * x + (s.xx * s.zz - s.xz * s.xz) * y + yz * z,
            xz * x + yz * y + (s.xx * s.yy - s.xy * s.xy) * z};
  }

  // How far the ellipsoids with these moments reach along n.
  TOUCHSTONE_INLINE double ReachP(const Eigen::Vector3d& n) const {
    return std::sqrt(Form(moments_p_, n));
  }
  TOUCHSTONE_INLINE double ReachQ(const Eigen::Vector3d& n) const {
    return std::sqrt(Form(moments_q_, n));
  }

  TOUCHSTONE_INLINE Symmetric3 Sum(double a, double b) const {
    const Symmetric3 &p = moments_p_, &q = moments_q_;
    return {a * p.xx + b * q.xx, a * p.xy + b * q.xy, a * p.xz + b * q.xz,
            a * p.yy + b * q.yy, a * p.yz + b * q.yz, a * p.zz + b * q.zz};
  }

  // Whether the balls prove that all of M lies strictly on the negative side of -c. With e = fl(c),
  // within sqrt(3) E of c: max of -e.x over M <= -e.c + |e| (r_P + r_Q) <= |e| (sqrt(3) E - |e| +
  // r_P + r_Q).
  static TOUCHSTONE_INLINE bool BallsAreApart(const MinkowskiDifference& m) {
    const double radii =
        m.p().bounding_ellipsoid().ball_radius + kStretch * m.q().bounding_ellipsoid().ball_radius;
    return m.c_norm() > kUp * (m.scale() * radii + kSqrt3 * m.coordinate_error());
  }

  // Whether the ellipsoids, given their reaches along `n` (P's frame, taken exactly), prove that
  // all of M lies strictly on its negative side:
  //   max of n.x over M <= n.c + radius_P |L_Pᵀ n| + slack_P |n| + the same of R Q.
  // The reaches are square roots of sums of rounded products: with rows of R L_Q and L_P no longer
  // than 2.1 r (the mean of the vertices is in the ball) a form is off by less than 40 u (2.1 r
  // |n|)^2 and, since sqrt(a + b) <= sqrt(a) + sqrt(b), its root by less than 2^-22 r |n|: that is
  // the slack taken. The rotation's own error moves Q's reach by at most that much of its ball.
  TOUCHSTONE_INLINE bool IsApart(const Eigen::Vector3d& n, double reach_p, double reach_q) const {
    const double length = std::abs(n[0]) + std::abs(n[1]) + std::abs(n[2]);  // at least |n|
    const double slack = p_.slack + kStretch * q_.slack + 0x1p-22 * p_.radius * p_.ball_radius +
                         (0x1p-22 * q_.radius + 2.0 * m_.pose().rotation_error()) * q_.ball_radius;
    const double apart = -(n[0] * m_.c()[0] + n[1] * m_.c()[1] + n[2] * m_.c()[2]);
    return apart > kUp * (p_.radius * reach_p + q_.radius * reach_q +
                          length * (m_.scale() * slack + m_.coordinate_error() +
                                    4.0 * kRoundingUnit * m_.c_norm()));
  }

 private:
  // An entry of RᵀR - I is at most 1e-6, so R stretches by at most sqrt(1 + 3e-6).
  static constexpr double kStretch = 1.0 + 1.6e-6;
  static constexpr double kSqrt3 = 1.7320508075688774;  // rounded up
  // More than all roundings of a sum, a product or a length of three terms in a row.
  static constexpr double kUp = 1.0 + 0x1p-46;

  static TOUCHSTONE_INLINE double Form(const Symmetric3& a, const Eigen::Vector3d& n) {
    const double form = n[0] * n[0] * a.xx + n[1] * n[1] * a.yy + n[2] * n[2] * a.zz +
                        2.0 * (n[0] * n[1] * a.xy + n[0] * n[2] * a.xz + n[1] * n[2] * a.yz);
    return form > 0.0 ? form : 0.0;
  }

  const MinkowskiDifference& m_;
  const BoundingEllipsoid& p_;
  const BoundingEllipsoid& q_;
  Symmetric3 moments_p_, moments_q_;
};

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_CD_DUAL_ELLIPSOID_MODEL_H_
