// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_MESH_NEAREST_ON_TRIANGLE_H_
#define TOUCHSTONE_CORE_MESH_NEAREST_ON_TRIANGLE_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

namespace touchstone {

// The point of the closed triangle nearest to p, up to rounding; of a flat one, of its sides.
inline Eigen::Vector3d NearestOnTriangle(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                                         const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  using Eigen::Vector3d;
  // In units of the largest length, so that fourth powers stay in range.
  const double unit = std::max({(b - a).cwiseAbs().maxCoeff(), (c - a).cwiseAbs().maxCoeff(),
                                (p - a).cwiseAbs().maxCoeff()});
  if (!(unit > 0.0)) return a;
  const Vector3d u = (b - a) / unit, v = (c - a) / unit, w = (p - a) / unit;
  const Vector3d normal = u.cross(v);
  if (normal.dot(u.cross(w)) > 0.0 && normal.dot((v - u).cross(w - u)) > 0.0 &&
      normal.dot(w.cross(v)) > 0.0) {
    return p - unit * (normal.dot(w) / normal.squaredNorm()) * normal;
  }
  double least = std::numeric_limits<double>::infinity();
  Vector3d nearest = a;
  const Vector3d* ends[] = {&a, &b, &c, &a};
  for (int k = 0; k < 3; ++k) {
    const Vector3d side = (*ends[k + 1] - *ends[k]) / unit, to = (p - *ends[k]) / unit;
    const double squared = side.squaredNorm();
    const double t = squared > 0.0 ? std::clamp(to.dot(side) / squared, 0.0, 1.0) : 0.0;
    const double distance = (t * side - to).squaredNorm();
    if (distance < least) least = distance, nearest = *ends[k] + t * (*ends[k + 1] - *ends[k]);
  }
  return nearest;
}

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_MESH_NEAREST_ON_TRIANGLE_H_
