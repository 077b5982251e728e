// SPDX-License-Identifier: MIT
#include "touchstone/core/base/orientation.h"

#include <algorithm>
#include <climits>
#include <cmath>

#include "touchstone/core/base/dyadic.h"

namespace touchstone {
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

// Written out: the order of operations is part of the bounds.
Eigen::Vector3d Cross(const Eigen::Vector3d& u, const Eigen::Vector3d& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

double SquaredLength(const Eigen::Vector3d& u) { return u[0] * u[0] + u[1] * u[1] + u[2] * u[2]; }

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

bool Orientation::IsCollinear(int a, int b, int c) const {
  return ExactTurn(a, b, c, 0) == 0 && ExactTurn(a, b, c, 1) == 0 && ExactTurn(a, b, c, 2) == 0;
}

// u, v are rounded differences, off by 1 unit (2^-52) of each entry. An entry of u x v then passes
// 4 roundings per term: it is off by 4.01 units of |u||v| at most, the vector by sqrt(3) times
// that. A unit vector made of it is off by 7 units of |u||v| / |u x v|, and normalising adds 4
// more. With the sine of the angle above 1/8 that is below 60 units. Thinner triangles, and those
// so small that squares of their cross product underflow, get their cross product exactly.
Eigen::Vector3d Orientation::UnitNormal(const std::array<int, 3>& plane) const {
  const Eigen::Vector3d u = point(plane[1]).scaled - point(plane[0]).scaled;
  const Eigen::Vector3d v = point(plane[2]).scaled - point(plane[0]).scaled;
  const Eigen::Vector3d cross = Cross(u, v);
  const double squared = SquaredLength(cross);
  if (squared > 0x1p-900 && 64.0 * squared > SquaredLength(u) * SquaredLength(v)) {
    return cross / std::sqrt(squared);
  }
  const DyadicVector origin = ToDyadic(point(plane[0]).exact);
  const DyadicVector exact = touchstone::Cross(ToDyadic(point(plane[1]).exact) - origin,
                                               ToDyadic(point(plane[2]).exact) - origin);
  std::array<int, 3> exponents;
  Eigen::Vector3d fractions;
  for (int i = 0; i < 3; ++i) fractions[i] = exact[i].ToScaledDouble(&exponents[i]);
  int greatest = INT_MIN;
  for (int i = 0; i < 3; ++i) {
    if (fractions[i] != 0.0) greatest = std::max(greatest, exponents[i]);
  }
  for (int i = 0; i < 3; ++i) fractions[i] = std::ldexp(fractions[i], exponents[i] - greatest);
  return fractions / std::sqrt(SquaredLength(fractions));
}

}  // namespace touchstone
