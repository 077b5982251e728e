// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_SCENE_SURFACE_INTERNAL_H_
#define TOUCHSTONE_CORE_SCENE_SURFACE_INTERNAL_H_

#include <vector>

#include "touchstone/core/convex/convex_polyhedron.h"
#include "touchstone/core/mesh/box_tree.h"

namespace touchstone::internal {

// The surface of a convex body as triangles of its own vertices, none degenerate: vertices within
// an edge of a face are apexes of no fan that their edge takes part in. Complexity: O(n) exact
// signs.
std::vector<Triangle> TrianglesOf(const ConvexPolyhedron& body);

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_SCENE_SURFACE_INTERNAL_H_
