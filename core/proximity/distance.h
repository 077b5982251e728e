// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_PROXIMITY_DISTANCE_H_
#define TOUCHSTONE_CORE_PROXIMITY_DISTANCE_H_

#include "touchstone/core/base/relative_pose.h"
#include "touchstone/core/convex/convex_polyhedron.h"
#include "touchstone/core/proximity/nearest_point.h"
#include "touchstone/core/proximity/result.h"

namespace touchstone {

struct DistanceOptions {
  Certainty certainty = Certainty::kExact;
};

// What one query leaves for the next of the same pair, or of any other: where to begin. Verified
// when used, never trusted: it can cost time, never an answer.
struct DistanceCache {
  Simplex simplex;
};

// How far apart are P and Q, and where are they closest? Q is placed in P's frame by `pose`.
//
// Returns the Euclidean distance with a proven error bound, closest points of both bodies, the
// features that support them, and zero for bodies that touch or overlap (the verdict is Collide's).
// Under kExact the closest simplex is optimal by exact signs, not up to a tolerance, and the error
// is below 1e-12 of the size of the pair. Distance moves by at most as much as the points of the
// bodies do (1-Lipschitz), and does not change when P and Q are exchanged and the pose inverted, up
// to rounding. Never throws, never returns NaN; the search in doubles stops after a fixed number of
// rounds, the exact one visits no simplex twice. Without a heap allocation unless big numbers are
// needed. Complexity: five to ten support pairs; one or two from a good cache.
DistanceResult Distance(const ConvexPolyhedron& p, const ConvexPolyhedron& q,
                        const RelativePose& pose, const DistanceOptions& options = {},
                        DistanceCache* cache = nullptr);

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_PROXIMITY_DISTANCE_H_
