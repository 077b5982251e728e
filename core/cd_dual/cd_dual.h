// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_CD_DUAL_CD_DUAL_H_
#define TOUCHSTONE_CORE_CD_DUAL_CD_DUAL_H_

#include "touchstone/core/base/relative_pose.h"
#include "touchstone/core/cd_dual/cache.h"
#include "touchstone/core/cd_dual/result.h"
#include "touchstone/core/convex/convex_polyhedron.h"

namespace touchstone {

struct CollideOptions {
  Search search = Search::kPortal;
  Certainty certainty = Certainty::kExact;
  // Stop as soon as the verdict is certain: no exit face, d or g then.
  bool early_exit = false;
  // Also name a point of both bodies where they touch or overlap. (Where they are separate, the
  // certificate's direction says all.)
  bool common_point = false;
  // Record every face visited (the paper's Figure 11).
  bool trace = false;
};

// Do P and Q meet? Q is placed in P's frame by `pose`.
//
// Returns the verdict of the closed bodies with a certificate that proves it, and, unless it exits
// early, the facet of M that the ray from c through o leaves by, with d and g. Directions, points
// and the certificate are in P's frame. Never throws, never returns NaN; every search ends:
// kPublished and kPhased because the signed distance strictly increases over finitely many faces,
// kPortal because it stops after a fixed number of rounds and the exact search that then takes over
// visits no triangle twice (exact_portal.h). Complexity: O(log n) to O(sqrt n) a round in practice,
// a dozen rounds. Source: Choi, Li, Wang, Cameron, "Collision Detection of Convex Polyhedra Based
// on Duality Transformation", sections 3 and 4.
//
// With a `cache` of the pair's last query, the verdict may come from there, proven anew; it is
// left ready for the next. Cold and warm answers agree: the same verdict, and where the exit face
// is asked for the same d and g within their errors. Only kPortal under early_exit looks for a
// verdict in it; kPortal looks there for an exit face, too.
CollideResult Collide(const ConvexPolyhedron& p, const ConvexPolyhedron& q,
                      const RelativePose& pose, const CollideOptions& options = {},
                      CollideCache* cache = nullptr);

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_CD_DUAL_CD_DUAL_H_
