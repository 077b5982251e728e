// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_MINKOWSKI_DIRECTIONS_INTERNAL_H_
#define TOUCHSTONE_CORE_MINKOWSKI_DIRECTIONS_INTERNAL_H_

#include <Eigen/Core>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "touchstone/core/minkowski/integers.h"

namespace touchstone::internal {

// A point of the sphere of directions, exactly, up to a positive factor; and its unit vector, each
// coordinate within 2^-51.
struct Direction {
  IntegerVector exact;
  Eigen::Vector3d unit;
};

// Requires a vector other than zero. The coordinates get no common divisor, so that equal
// directions have equal coordinates, and equal unit vectors.
Direction MakeDirection(const IntegerVector& v);
Direction Opposite(const Direction& x);

// The sign of pole . x: 1 where x lies on the left of the great circle round the pole. Exact.
int SideOf(const Direction& pole, const Direction& x);
// The sign of det [a b c]: 1 where c lies on the left of the way from a to b. Exact.
int TurnOf(const Direction& a, const Direction& b, const Direction& c);

// Directions, each once, numbered as they come.
class DirectionTable {
 public:
  int Add(const Direction& x);
  int size() const { return static_cast<int>(directions_.size()); }
  const Direction& operator[](int i) const { return directions_[i]; }

 private:
  std::vector<Direction> directions_;
  std::unordered_multimap<std::uint64_t, int> numbers_;  // by a hash of the unit vector
};

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_MINKOWSKI_DIRECTIONS_INTERNAL_H_
