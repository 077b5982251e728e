// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_CONVEX_TOPOLOGY_INTERNAL_H_
#define TOUCHSTONE_CORE_CONVEX_TOPOLOGY_INTERNAL_H_

#include "touchstone/core/base/status.h"
#include "touchstone/core/convex/convex_polyhedron_data.h"

namespace touchstone::internal {

// Fills edges, face_edges and the lists around vertices from the loops alone. Returns kOpen,
// kNonManifold or kInconsistentOrientation unless the faces, glued along their edges, make one
// oriented sphere: every edge has two faces that run it in opposite senses, the faces at every
// vertex make one cycle, all hang together, and V - E + F = 2.
// Requires loops of three or more distinct vertices, and every vertex in some loop.
// Complexity: O(n log d), d the largest number of edges at a vertex.
Status BuildTopology(ConvexPolyhedronData* data);

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_CONVEX_TOPOLOGY_INTERNAL_H_
