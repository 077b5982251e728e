// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_MESH_HALF_EDGES_INTERNAL_H_
#define TOUCHSTONE_CORE_MESH_HALF_EDGES_INTERNAL_H_

#include "touchstone/core/base/status.h"
#include "touchstone/core/mesh/triangle_mesh_data.h"

namespace touchstone::internal {

// Fills twins, edges, the lists around vertices and the components (all but their depth) from the
// faces alone. Returns kOpen, kNonManifold or kInconsistentOrientation unless every edge has two
// faces that run it in opposite senses and the faces at every vertex make one cycle. Requires
// faces of three distinct vertices, and every vertex in some face.
// Complexity: O(n log d), d the largest number of edges at a vertex.
Status BuildHalfEdges(TriangleMeshData* data);

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_MESH_HALF_EDGES_INTERNAL_H_
