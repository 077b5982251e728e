// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/rotation_travel_internal.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace touchstone::internal {
namespace {

using Eigen::Matrix3d;

// Signs are those of pole . (turn * direction), or of direction . (turn * along). Vectors are
// within sqrt(3) 2^-51 of exact ones, the turn (a rotation, or its cofactors: three roundings an
// entry) within 9 2^-52, and the product adds less than 2^-50: 2^-48 in all, as lengths are within
// 1e-6 of one.
constexpr double kRounding = 0x1p-47;
// Entries of a pose from two world poses are off by `error`; cofactors by 2 (2 + 1e-5) of it, as a
// matrix by three times that.
constexpr double kPoseFactor = 13.0;
// Travel is a sum of doubles, each addition off by at most kTravelUnit / 2 up to here; beyond, all
// is found anew.
constexpr double kGreatestTravel = 8.0, kTravelUnit = 0x1p-49;
// How far round a feature its candidates are listed: so many steps of the present motion, but not
// so far that lists get long. Motion that would use up a list in a few steps gets none: only what
// a feature meets.
constexpr double kStepsOfReach = 16.0, kFewSteps = 8.0;
constexpr double kLeastReach = 0.02, kGreatestReach = 0.06;

// At least the 2-norm: the root of the greatest eigenvalue of MᵀM, at most the eighth root of the
// trace of its fourth power.
double NormBound(const Matrix3d& matrix) {
  const double scale = matrix.cwiseAbs().maxCoeff();
  if (scale == 0.0) return 0.0;
  const Matrix3d unit = matrix / scale;
  const Matrix3d squared = unit.transpose() * unit;
  const Matrix3d fourth = squared * squared;
  const double trace = (fourth * fourth).trace();
  return scale * std::pow(trace, 0.125) * (1.0 + 1e-12);
}

Matrix3d CofactorsOf(const Matrix3d& m) {
  Matrix3d cofactors;
  for (int i = 0; i < 3; ++i) {
    cofactors.row(i) = m.row((i + 1) % 3).cross(m.row((i + 2) % 3));
  }
  return cofactors;
}

}  // namespace

bool RotationTravel::GoTo(const RelativePose& pose) {
  const Matrix3d rotation = pose.rotation();
  const Matrix3d cofactors = CofactorsOf(rotation);
  margin_ = kRounding + kPoseFactor * pose.rotation_error();
  if (rotation_) {
    const double step =
        std::max(NormBound(rotation - *rotation_), NormBound(cofactors - *cofactors_));
    // Rounded, it must not fall short.
    if (step > 0.0) travel_ += step + kTravelUnit;
    const double reach = std::clamp(kStepsOfReach * step, kLeastReach, kGreatestReach);
    reach_ = reach > kFewSteps * step ? reach : 0.0;
  } else {
    reach_ = kLeastReach;
  }
  const bool holds = rotation_ && travel_ < kGreatestTravel;
  if (!holds) travel_ = 0.0;
  rotation_ = rotation;
  cofactors_ = cofactors;
  directions_ = {-rotation.transpose(), -cofactors};
  along_ = {cofactors.transpose(), rotation};
  return holds;
}

}  // namespace touchstone::internal
