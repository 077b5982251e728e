// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef TOUCHSTONE_EXACT_SELF_INTERSECTION_H_
#define TOUCHSTONE_EXACT_SELF_INTERSECTION_H_

#include <optional>
#include <utility>

#include "touchstone/core/mesh/triangle_mesh.h"

namespace touchstone::exact {

// Two faces, the smaller number first, that share a point beyond the vertices and edges that both
// name; nothing if the surface is embedded. Of all such pairs, the first in order. Exact: boxes
// choose the pairs, fractions decide. Touching is sharing: components that meet in one point do.
// Complexity: O(k log n) for k pairs of faces whose boxes meet; each vertex brings all pairs of its
// faces.
std::optional<std::pair<int, int>> FindSelfIntersection(const TriangleMesh& mesh);

}  // namespace touchstone::exact

#endif  // TOUCHSTONE_EXACT_SELF_INTERSECTION_H_
