// SPDX-License-Identifier: MIT
#include "touchstone/core/base/relative_pose.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <string>

#include "touchstone/core/base/dyadic.h"

namespace touchstone {
namespace {

constexpr double kMaxTranslation = 1e100;
constexpr double kMaxDeviation = 1e-6;  // of an entry of RᵀR from the identity's

// The unit of rounding used in all bounds here: 2^-52 holds in every rounding mode.
constexpr double kUnit = 0x1p-52;

Status Fail(StatusCode code, ElementKind element, int index, std::string message) {
  return {code, element, index, -1, std::move(message)};
}

// Whether entry (i, j) of RᵀR is within kMaxDeviation of the identity's; by exact signs where
// doubles leave it open. Requires entries of R below 2.
bool IsNearIdentity(const Eigen::Matrix3d& r, int i, int j) {
  const double identity = i == j ? 1.0 : 0.0;
  const double deviation = std::abs(r.col(i).dot(r.col(j)) - identity);
  // Six roundings, each relative to at most 3 * 2 * 2 + 1 = 13: below 6 * 13 * 2^-52 < 2e-14.
  if (std::abs(deviation - kMaxDeviation) > 2e-14) return deviation < kMaxDeviation;
  Dyadic exact = Dot(ToDyadic(r.col(i)), ToDyadic(r.col(j))) - Dyadic(identity);
  if (exact.sign() < 0) exact = -exact;
  return (exact - Dyadic(kMaxDeviation)).sign() <= 0;
}

Status CheckPose(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation) {
  for (int i = 0; i < 3; ++i) {
    if (!rotation.row(i).allFinite() || !std::isfinite(translation[i])) {
      return Fail(StatusCode::kNonFinite, ElementKind::kRow, i,
                  "row " + std::to_string(i) + " of the pose is not finite");
    }
  }
  for (int i = 0; i < 3; ++i) {
    if (std::abs(translation[i]) > kMaxTranslation) {
      return Fail(StatusCode::kOutOfRange, ElementKind::kRow, i,
                  "entry " + std::to_string(i) + " of the translation is above 1e100");
    }
  }
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (std::abs(rotation(i, j)) >= 2.0) {
        return Fail(StatusCode::kBadRotation, ElementKind::kRow, i,
                    "row " + std::to_string(i) + " of the rotation is longer than 1");
      }
    }
  }
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j <= i; ++j) {
      if (!IsNearIdentity(rotation, i, j)) {
        return Fail(StatusCode::kBadRotation, ElementKind::kRow, i,
                    "row " + std::to_string(i) + " of R^T R is off the identity by more than 1e-6");
      }
    }
  }
  // |det R| is within 1e-5 of 1 by now, so doubles give its sign.
  if (rotation.determinant() <= 0.0) {
    return Fail(StatusCode::kBadRotation, ElementKind::kNone, -1,
                "the rotation is a reflection: its determinant is not positive");
  }
  return {};
}

// R^-1 as cofactors over the determinant.
Eigen::Matrix3d Inverse(const Eigen::Matrix3d& r) {
  Eigen::Matrix3d cofactors;
  cofactors.row(0) = r.row(1).cross(r.row(2));
  cofactors.row(1) = r.row(2).cross(r.row(0));
  cofactors.row(2) = r.row(0).cross(r.row(1));
  const double determinant = r.row(0).dot(cofactors.row(0));
  return cofactors.transpose() / determinant;
}

// Error of the relative pose R = Rp^-1 Rq, t = Rp^-1 (tq - tp) as FromWorld computes it, in units
// u = 2^-52. Every entry of RᵀR is within 1e-6 of the identity's, so ‖RᵀR - I‖ <= 3e-6, and rows
// and columns of R, of its cofactors and of R^-1 have lengths below k = 1 + 1e-5, as has 1/det.
// Below, sums of products |a||b| along rows are at most k^2 by Cauchy-Schwarz, and sums of the
// three entries of a row at most sqrt(3) k; k's powers and second-order terms are covered by
// rounding the constants up.
//   cofactor   two products and a difference               2 u
//   det        sqrt(3) * 2 u + three roundings             6.5 u
//   inverse    2 u + 6.5 u + the division's                9.6 u
//   R          sqrt(3) * 9.6 u + three roundings           19.7 u
// With s the largest entry of the rounded tq - tp, whose own rounding is at most u s each:
//   t          3 * 9.6 u s + sqrt(3) * 3 u s + sqrt(3) u s  35.8 u s
// Underflow adds less than 2^-1000 to either.
constexpr double kRotationError = 24.0 * kUnit;
constexpr double kTranslationError = 40.0 * kUnit;
constexpr double kUnderflow = 0x1p-1000;

}  // namespace

StatusOr<RelativePose> RelativePose::Make(const Eigen::Matrix3d& rotation,
                                          const Eigen::Vector3d& translation) {
  if (Status status = CheckPose(rotation, translation); !status.ok()) return status;
  RelativePose pose;
  pose.rotation_ = rotation;
  pose.translation_ = translation;
  return pose;
}

StatusOr<RelativePose> RelativePose::FromWorld(const WorldPose& p, const WorldPose& q) {
  for (const auto& [name, world] : {std::pair("P: ", &p), std::pair("Q: ", &q)}) {
    if (Status status = CheckPose(world->rotation, world->translation); !status.ok()) {
      status.message = name + status.message;
      return status;
    }
  }
  const Eigen::Matrix3d inverse = Inverse(p.rotation);
  const Eigen::Vector3d difference = q.translation - p.translation;
  RelativePose pose;
  pose.rotation_ = inverse * q.rotation;
  pose.translation_ = inverse * difference;
  pose.rotation_error_ = kRotationError;
  pose.translation_error_ = kTranslationError * difference.cwiseAbs().maxCoeff() + kUnderflow;
  pose.world_ = std::pair(p, q);
  for (int i = 0; i < 3; ++i) {
    if (std::abs(pose.translation_[i]) > kMaxTranslation) {
      return Fail(StatusCode::kOutOfRange, ElementKind::kRow, i,
                  "entry " + std::to_string(i) + " of the relative translation is above 1e100");
    }
  }
  return pose;
}

}  // namespace touchstone
