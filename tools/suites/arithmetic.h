// SPDX-License-Identifier: MIT
//
// Vector arithmetic with every rounding where it is written. Eigen's products may sum in an order
// that depends on the vector unit compiled for; what suites generate may not.
#ifndef TOUCHSTONE_TOOLS_SUITES_ARITHMETIC_H_
#define TOUCHSTONE_TOOLS_SUITES_ARITHMETIC_H_

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <span>

namespace touchstone {

inline double PlainDot(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
}

inline Eigen::Vector3d PlainCross(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline Eigen::Vector3d PlainRotate(const Eigen::Matrix3d& r, const Eigen::Vector3d& x) {
  Eigen::Vector3d y;
  for (int i = 0; i < 3; ++i) y[i] = (r(i, 0) * x[0] + r(i, 1) * x[1]) + r(i, 2) * x[2];
  return y;
}

inline Eigen::Vector3d PlainMean(std::span<const Eigen::Vector3d> points) {
  double x = 0.0, y = 0.0, z = 0.0;
  for (const Eigen::Vector3d& point : points) {
    x += point[0];
    y += point[1];
    z += point[2];
  }
  const double n = static_cast<double>(points.size());
  return {x / n, y / n, z / n};
}

inline double PlainMaxCoordinate(std::span<const Eigen::Vector3d> points) {
  double max = 0.0;
  for (const Eigen::Vector3d& point : points) {
    for (int i = 0; i < 3; ++i) max = std::fmax(max, std::fabs(point[i]));
  }
  return max;
}

// The axis along which `v` is longest; the first of equals.
inline int LongestAxis(const Eigen::Vector3d& v) {
  int axis = 0;
  for (int i = 1; i < 3; ++i) {
    if (std::fabs(v[i]) > std::fabs(v[axis])) axis = i;
  }
  return axis;
}

// The neighbouring double above (or below) `x`; for |x| below `size`, a step of the ulp of `size`,
// so that a step from zero is a step that the bodies can feel, not a denormal.
inline double StepUlp(double x, bool up, double size) {
  const double ulp =
      std::nextafter(std::fabs(size), std::numeric_limits<double>::max()) - std::fabs(size);
  if (std::fabs(x) < size * 0x1p-20) return up ? x + ulp : x - ulp;
  return std::nextafter(
      x, up ? std::numeric_limits<double>::max() : std::numeric_limits<double>::lowest());
}

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_SUITES_ARITHMETIC_H_
