// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef TOUCHSTONE_EXACT_CONVEX_MINKOWSKI_H_
#define TOUCHSTONE_EXACT_CONVEX_MINKOWSKI_H_

#include "touchstone/exact/convert.h"
#include "touchstone/exact/minkowski_difference.h"

namespace touchstone::exact {

// The construction tier: M = {a - b} as the exact convex hull of all differences of vertices.
// Complexity: O(mn log mn), for small bodies.
MinkowskiDifference ConvexMinkowski(const PlacedPair& pair);

}  // namespace touchstone::exact

#endif  // TOUCHSTONE_EXACT_CONVEX_MINKOWSKI_H_
