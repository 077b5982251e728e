// SPDX-License-Identifier: MIT
#include "touchstone/core/convex/orientation_internal.h"

#include <cmath>

#include "touchstone/core/base/dyadic.h"

namespace touchstone::internal {
namespace {

// Relative roundings are counted in units of 2^-52, which holds in every rounding mode.
//
// Each of the six terms of the determinant of differences passes at most 8 roundings: three
// differences, a product, a difference of products, a product and two sums. So the computed value
// is off by at most (1 + u)^8 - 1 < 8.001 u times the sum of the terms' magnitudes, and that sum is
// computed with as many roundings: 9 u covers both and the final product. Scaled coordinates are
// below 1, so every intermediate is below 2^5 and underflow, anywhere, adds less than 2^-1000.
constexpr double kSideError = 9.0 * 0x1p-52;
// Each of the two terms passes 4 roundings: two differences, a product, a difference.
constexpr double kTurnError = 5.0 * 0x1p-52;
constexpr double kUnderflow = 0x1p-1000;

}  // namespace

Orientation::Orientation(std::span<const Eigen::Vector3d> vertices, double max_coordinate) {
  int exponent = 0;
  std::frexp(max_coordinate, &exponent);
  scale_ = std::ldexp(1.0, -exponent);
  points_.reserve(vertices.size());
  for (const Eigen::Vector3d& vertex : vertices) points_.push_back(Scale(vertex));
}

Estimate Orientation::TriageSide(const ScaledPoint& a, const ScaledPoint& b, const ScaledPoint& c,
                                 const ScaledPoint& d) {
  const double ux = b.scaled[0] - a.scaled[0], uy = b.scaled[1] - a.scaled[1],
               uz = b.scaled[2] - a.scaled[2];
  const double vx = c.scaled[0] - a.scaled[0], vy = c.scaled[1] - a.scaled[1],
               vz = c.scaled[2] - a.scaled[2];
  const double wx = d.scaled[0] - a.scaled[0], wy = d.scaled[1] - a.scaled[1],
               wz = d.scaled[2] - a.scaled[2];
  const double yz = uy * vz, zy = uz * vy, zx = uz * vx, xz = ux * vz, xy = ux * vy, yx = uy * vx;
  const double value = (yz - zy) * wx + (zx - xz) * wy + (xy - yx) * wz;
  const double magnitude = (std::abs(yz) + std::abs(zy)) * std::abs(wx) +
                           (std::abs(zx) + std::abs(xz)) * std::abs(wy) +
                           (std::abs(xy) + std::abs(yx)) * std::abs(wz);
  return {value, kSideError * magnitude + kUnderflow};
}

int Orientation::ExactSide(const ScaledPoint& a, const ScaledPoint& b, const ScaledPoint& c,
                           const ScaledPoint& d) {
  const Estimate estimate = TriageSide(a, b, c, d);
  if (estimate.value > estimate.error) return 1;
  if (estimate.value < -estimate.error) return -1;
  const DyadicVector origin = ToDyadic(a.exact);
  return Determinant(ToDyadic(b.exact) - origin, ToDyadic(c.exact) - origin,
                     ToDyadic(d.exact) - origin)
      .sign();
}

int Orientation::ExactTurn(int a, int b, int c, int axis) const {
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  const Eigen::Vector3d u = point(b).scaled - point(a).scaled;
  const Eigen::Vector3d v = point(c).scaled - point(a).scaled;
  const double left = u[i] * v[j], right = u[j] * v[i];
  const double value = left - right;
  const double error = kTurnError * (std::abs(left) + std::abs(right)) + kUnderflow;
  if (value > error) return 1;
  if (value < -error) return -1;
  const auto difference = [&](int to, int k) {
    return Dyadic(point(to).exact[k]) - Dyadic(point(a).exact[k]);
  };
  return (difference(b, i) * difference(c, j) - difference(b, j) * difference(c, i)).sign();
}

}  // namespace touchstone::internal
