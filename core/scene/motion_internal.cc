// SPDX-License-Identifier: MIT
#include "touchstone/core/scene/motion_internal.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

namespace touchstone::internal {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kUnit = 0x1p-52;          // of rounding, in any mode
constexpr double kUp = 1.0 + 0x1p-46;      // more than a handful of roundings in a row
constexpr double kStretch = 1.0 + 1.6e-6;  // R stretches by sqrt(1 + 3e-6) at most
constexpr double kUnderflow = 0x1p-500;    // more than what squares and roots lose to underflow

// Far enough from the limits of RelativePose::Make that doubles tell: an entry of R^T R is off by
// less than 2e-14 there, the determinant within 1e-5 of 1 or -1.
bool IsClearlyRigid(const Matrix3d& r) {
  const Vector3d a = r.col(0), b = r.col(1), c = r.col(2);
  const double deviation =
      std::max({std::abs(a.dot(a) - 1.0), std::abs(b.dot(b) - 1.0), std::abs(c.dot(c) - 1.0),
                std::abs(a.dot(b)), std::abs(b.dot(c)), std::abs(c.dot(a))});
  return deviation < 9e-7 && a.cross(b).dot(c) > 0.5;
}

}  // namespace

Status CheckWorldPose(const WorldPose& pose) {
  const double largest = pose.translation.cwiseAbs().maxCoeff();
  // NaN fails every comparison; the sum is finite only if all terms are.
  const double sum = pose.translation.sum() + pose.rotation.sum();
  if (std::isfinite(sum) && largest <= kMaxWorldTranslation && IsClearlyRigid(pose.rotation)) {
    return {};
  }
  const auto exact = RelativePose::Make(pose.rotation, pose.translation);
  if (!exact.ok()) return exact.status();
  for (int i = 0; i < 3; ++i) {
    if (std::abs(pose.translation[i]) > kMaxWorldTranslation) {
      return {StatusCode::kOutOfRange, ElementKind::kRow, i, -1,
              "entry " + std::to_string(i) + " of the translation is above 2.5e99"};
    }
  }
  return {};
}

// x moves by D (x - m) + (D m + dt) with D = R' - R. The first part is at most ‖D‖ r, and
// ‖D‖^2 = ‖D^T D‖ <= ‖D^T D‖_F, which for rotations is at most 2^(1/4) times too much. D and dt are
// off by one rounding of each entry; a coordinate of D m + dt by 4.01 roundings of the sum of
// absolute terms, at most |D|_F |m|_1 + |dt|_1.
double MotionBound(const WorldPose& from, const WorldPose& to, const Vector3d& middle,
                   double radius) {
  const Matrix3d d = to.rotation - from.rotation;
  const Vector3d dt = to.translation - from.translation;
  const bool turned = !(d.array() == 0.0).all();
  if (!turned && (dt.array() == 0.0).all()) return 0.0;
  if (!turned) return kUp * dt.norm() + kUnderflow;
  const Matrix3d gram = d.transpose() * d;
  const double norm = std::sqrt(gram.norm());
  const double shift = (d * middle + dt).norm();
  const double rounding = 8.0 * kUnit * (2.0 * norm * middle.lpNorm<1>() + dt.lpNorm<1>());
  return kUp * (shift + norm * radius + rounding) + kUnderflow * (1.0 + radius);
}

// Of three boxes that hold the part the common one: around its ball, around its own box turned, and
// around its ellipsoid. A coordinate of R x + t is off by less than 8 units of 1.75 |x| + |t|.
Box3 PlacedBox(const ScenePart& part, const WorldPose& pose) {
  const Matrix3d& r = pose.rotation;
  const Vector3d middle = r * part.middle() + pose.translation;
  const Vector3d half = kUp * (0.5 * part.box().high - 0.5 * part.box().low);
  const Vector3d box_middle = r * (0.5 * part.box().low + 0.5 * part.box().high) + pose.translation;
  const Vector3d slack =
      8.0 * kUnit * (pose.translation.cwiseAbs() + Vector3d::Constant(2.0 * part.max_coordinate()));
  Box3 box;
  for (int i = 0; i < 3; ++i) {
    double reach = kStretch * part.outer_radius();
    if (part.is_convex()) {
      const BoundingEllipsoid& e = part.convex().bounding_ellipsoid();
      const double x = r(i, 0) * e.factor_xx + r(i, 1) * e.factor_yx + r(i, 2) * e.factor_zx;
      const double y = r(i, 1) * e.factor_yy + r(i, 2) * e.factor_zy, z = r(i, 2) * e.factor_zz;
      // A form's root is off by less than 2^-22 of the ball times the radius (ellipsoid_model.h).
      const double ellipsoid = e.radius * std::sqrt(x * x + y * y + z * z) + kStretch * e.slack +
                               0x1p-22 * e.radius * e.ball_radius;
      reach = std::min(reach, ellipsoid);
    }
    const double turned =
        std::abs(r(i, 0)) * half[0] + std::abs(r(i, 1)) * half[1] + std::abs(r(i, 2)) * half[2];
    box.low[i] = std::max(middle[i] - kUp * reach, box_middle[i] - kUp * turned) - slack[i];
    box.high[i] = std::min(middle[i] + kUp * reach, box_middle[i] + kUp * turned) + slack[i];
  }
  return box;
}

}  // namespace touchstone::internal
