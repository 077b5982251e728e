// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_MINKOWSKI_EQUAL_POINTS_INTERNAL_H_
#define TOUCHSTONE_CORE_MINKOWSKI_EQUAL_POINTS_INTERNAL_H_

#include <span>
#include <vector>

#include "touchstone/core/minkowski/sum_geometry_internal.h"

namespace touchstone::internal {

struct Segment;

// For every point of the geometry the smallest number of those equal to it, by exact comparison,
// among the points on the segments (others represent themselves). Wide roundings of those points
// are made narrow. Complexity: O(n), and one exact comparison for each two points that doubles
// cannot tell apart.
std::vector<int> FindEqualPoints(SumGeometry* geometry, std::span<const Segment> segments);

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_MINKOWSKI_EQUAL_POINTS_INTERNAL_H_
