// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_PROXIMITY_PENETRATION_DEPTH_H_
#define TOUCHSTONE_CORE_PROXIMITY_PENETRATION_DEPTH_H_

#include "touchstone/core/base/relative_pose.h"
#include "touchstone/core/convex/convex_polyhedron.h"
#include "touchstone/core/proximity/inner_polytope.h"
#include "touchstone/core/proximity/result.h"

namespace touchstone {

struct PenetrationOptions {
  Certainty certainty = Certainty::kExact;
  // Copy out the inner polytope that proves the lower bound.
  bool certificate = false;
};

// The memory of a query and what it leaves for the next: the polytope grown inside M. Taken up
// again for a similar pose it is verified triangle by triangle, never trusted: it can cost time,
// never an answer. `Clear` makes the next query start afresh and keeps the memory.
struct PenetrationCache {
  InnerPolytope polytope;
  int cold_triangles = 0;  // how many it had when it was last grown from nothing
  void Clear() { polytope.Clear(); }
};

// How deep are P and Q in each other? Q is placed in P's frame by `pose`.
//
// Returns the least translation of Q that leaves the bodies just touching, the facet of M that it
// ends on with the features of P and Q, and the depth, |translation|, with a proven error bound; or
// that they touch or are separate (the verdict is Collide's). Under kExact the facet is proven to
// be one, and no facet is nearer to o, ties included, by exact signs. Depth moves by at most as
// much as the points of the bodies do. Never throws, never returns NaN.
//
// Algorithm: a polytope inside M around o grows over the support along the normal of its nearest
// triangle, until nothing of M lies beyond the nearest one. Terminates: the polytope is exactly
// convex, every support is a vertex of M strictly outside of it, and there are finitely many; one
// taken from a cache stops after a fixed number of rounds, and under kFloat so does any.
//
// Without a heap allocation once the cache's memory has grown to what is needed, unless big numbers
// are; without a cache the polytope is allocated anew. Complexity: a round is a support pair and
// the handful of triangles that change; rounds grow with the number of facets of M about as near as
// the nearest.
PenetrationResult PenetrationDepth(const ConvexPolyhedron& p, const ConvexPolyhedron& q,
                                   const RelativePose& pose, const PenetrationOptions& options = {},
                                   PenetrationCache* cache = nullptr);

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_PROXIMITY_PENETRATION_DEPTH_H_
