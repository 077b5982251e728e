// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_MINKOWSKI_EQUAL_POINTS_INTERNAL_H_
#define TOUCHSTONE_CORE_MINKOWSKI_EQUAL_POINTS_INTERNAL_H_

#include <span>
#include <vector>

#include "touchstone/core/minkowski/sum_geometry_internal.h"

namespace touchstone::internal {

// For every point of the geometry the smallest number of those equal to it, by exact comparison,
// among the points listed (others represent themselves). Wide roundings of the listed are made
// narrow. Complexity: O(n), and O(k log k) comparisons for k points within 2^-36 of each other.
std::vector<int> FindEqualPoints(SumGeometry* geometry, std::span<const int> points);

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_MINKOWSKI_EQUAL_POINTS_INTERNAL_H_
