// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef TOUCHSTONE_EXACT_JUDGE_NEAREST_ON_TRIANGLE_H_
#define TOUCHSTONE_EXACT_JUDGE_NEAREST_ON_TRIANGLE_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>

namespace touchstone::exact {

// The point of a triangle nearest to the origin, in doubles.
inline Eigen::Vector3d NearestOnTriangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                         const Eigen::Vector3d& c) {
  const Eigen::Vector3d normal = (b - a).cross(c - a);
  if (normal.dot((b - a).cross(-a)) > 0.0 && normal.dot((c - b).cross(-b)) > 0.0 &&
      normal.dot((a - c).cross(-c)) > 0.0) {
    return normal * (normal.dot(a) / normal.squaredNorm());
  }
  Eigen::Vector3d best = a;
  const Eigen::Vector3d* ends[] = {&a, &b, &c, &a};
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d side = *ends[k + 1] - *ends[k];
    const double squared = side.squaredNorm();
    const double t = squared > 0.0 ? std::clamp(-ends[k]->dot(side) / squared, 0.0, 1.0) : 0.0;
    const Eigen::Vector3d x = *ends[k] + t * side;
    if (x.squaredNorm() < best.squaredNorm()) best = x;
  }
  return best;
}

}  // namespace touchstone::exact

#endif  // TOUCHSTONE_EXACT_JUDGE_NEAREST_ON_TRIANGLE_H_
