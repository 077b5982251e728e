// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/directions_internal.h"

#include <Eigen/Geometry>
#include <bit>

namespace touchstone::internal {
namespace {

using Eigen::Vector3d;

std::uint64_t HashOf(const Vector3d& v) {
  std::uint64_t hash = 0;
  for (int i = 0; i < 3; ++i) {
    // -0 and 0 are one.
    hash = (hash ^ std::bit_cast<std::uint64_t>(v[i] + 0.0)) * 0x9e3779b97f4a7c15u;
    hash ^= hash >> 29;
  }
  return hash;
}

}  // namespace

Direction MakeDirection(const IntegerVector& v) {
  IntegerVector exact = Primitive(v);
  const Vector3d unit = UnitOf(exact);
  return {std::move(exact), unit};
}

Direction Opposite(const Direction& x) { return {-x.exact, -x.unit}; }

// Both vectors are off by sqrt(3) 2^-51 at most, their dot product by twice that and three
// roundings: below 2^-49 + 2^-50.
int SideOf(const Direction& pole, const Direction& x) {
  const double height = pole.unit.dot(x.unit);
  if (height > 0x1p-48) return 1;
  if (height < -0x1p-48) return -1;
  return Dot(pole.exact, x.exact).sign();
}

// With u = b - a and v = c - a, each off by d = 2 sqrt(3) 2^-51 < 2^-49.2 and a rounding, the
// determinant of a, u, v is off by |u||v| (sqrt(3) 2^-51 + 12 2^-53) + d (|u| + |v|) + d^2, and
// |u||v| <= |u| + |v|.
int TurnOf(const Direction& a, const Direction& b, const Direction& c) {
  const Vector3d u = b.unit - a.unit, v = c.unit - a.unit;
  const double turn = a.unit.dot(u.cross(v));
  const double bound = 0x1p-47 * (u.cwiseAbs().sum() + v.cwiseAbs().sum()) + 0x1p-90;
  if (turn > bound) return 1;
  if (turn < -bound) return -1;
  return Determinant(a.exact, b.exact, c.exact).sign();
}

int DirectionTable::Add(const Direction& x) {
  const std::uint64_t hash = HashOf(x.unit);
  const auto [begin, end] = numbers_.equal_range(hash);
  for (auto i = begin; i != end; ++i) {
    if (directions_[i->second].exact == x.exact) return i->second;
  }
  numbers_.emplace(hash, size());
  directions_.push_back(x);
  return size() - 1;
}

}  // namespace touchstone::internal
