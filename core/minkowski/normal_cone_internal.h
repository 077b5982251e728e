// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_MINKOWSKI_NORMAL_CONE_INTERNAL_H_
#define TOUCHSTONE_CORE_MINKOWSKI_NORMAL_CONE_INTERNAL_H_

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "touchstone/core/minkowski/gauss_map.h"

namespace touchstone::internal {

// A cone that is wider than a half-space counts as all directions. With these for its cosine c and
// sine s, c cos t - s sin t < -1 for every t up to a right angle, and c² - s² < -1.
inline constexpr double kAllCosine = -2.0, kAllSine = 4.0;

inline double SineOf(double cosine) { return std::sqrt(std::max(0.0, 1.0 - cosine * cosine)); }

// A cone round two: all directions where they span a half-space or more.
inline NormalCone ConeRound(const NormalCone& a, const NormalCone& b) {
  if (a.cosine <= 0.0 || b.cosine <= 0.0) return {};
  Eigen::Vector3d axis = a.axis + b.axis;
  const double length = axis.norm();
  if (length < 1e-3) return {};
  axis /= length;
  // cos(angle to the axis + own angle), the smaller of the two.
  const auto reach = [&](const NormalCone& cone) {
    const double cosine = std::clamp(axis.dot(cone.axis), -1.0, 1.0);
    return cosine * cone.cosine - SineOf(cosine) * SineOf(cone.cosine) - 1e-9;
  };
  const double cosine = std::min(reach(a), reach(b));
  return cosine > 0.0 ? NormalCone{axis, cosine} : NormalCone{};
}

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_MINKOWSKI_NORMAL_CONE_INTERNAL_H_
