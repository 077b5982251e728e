// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_MINKOWSKI_TRIANGULATE_CELL_INTERNAL_H_
#define TOUCHSTONE_CORE_MINKOWSKI_TRIANGULATE_CELL_INTERNAL_H_

#include <array>
#include <span>
#include <vector>

#include "touchstone/core/minkowski/sum_geometry_internal.h"

namespace touchstone::internal {

// Cuts a polygon with holes into triangles between its points, all of positive area: ears are
// clipped, after holes are joined to the outer loop by bridges. Loops are as in Cell; `plane` has
// the normal against which they are seen. Every sign is exact. Empty only for a loop that winds
// round nothing. Complexity: O(n^3) at worst, n mostly below ten.
std::vector<std::array<int, 3>> TriangulateCell(SumGeometry* geometry, int plane,
                                                std::span<const std::span<const int>> loops);

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_MINKOWSKI_TRIANGULATE_CELL_INTERNAL_H_
