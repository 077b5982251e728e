// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef TOUCHSTONE_EXACT_HULL_OF_INTEGERS_INTERNAL_H_
#define TOUCHSTONE_EXACT_HULL_OF_INTEGERS_INTERNAL_H_

#include <array>
#include <vector>

#include "touchstone/exact/integer.h"

namespace touchstone::exact {

// Triangles of the convex hull of distinct points that span space, as indices, counterclockwise
// from outside. CGAL stays behind this one function: it compiles slowly.
std::vector<std::array<int, 3>> HullOfIntegers(const std::vector<IntegerVector>& points);

}  // namespace touchstone::exact

#endif  // TOUCHSTONE_EXACT_HULL_OF_INTEGERS_INTERNAL_H_
