// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_PROXIMITY_DIRECTIONAL_DISTANCE_H_
#define TOUCHSTONE_CORE_PROXIMITY_DIRECTIONAL_DISTANCE_H_

#include "touchstone/core/base/relative_pose.h"
#include "touchstone/core/base/status.h"
#include "touchstone/core/convex/convex_polyhedron.h"
#include "touchstone/core/proximity/result.h"

namespace touchstone {

struct DirectionalOptions {
  Certainty certainty = Certainty::kExact;
};

// For which travels t do P and Q, moved by t s from where `pose` places it, meet?
//
// Returns the closed interval [enter, leave] of t at which they touch or overlap, with the facets
// of M at both ends, or the proof that there is none. The travel is the plain parameter t of Q + t
// s, not a length: any s of doubles is taken exactly, so the question is exact whatever |s|; t |s|
// is the length. Works alike for separate and overlapping bodies, and for s and -s (then the
// interval is mirrored). `s` is in P's frame.
//
// Errors: a status kNonFinite or kOutOfRange if s is not finite or |s| not within [1e-100, 1e100];
// zero is out of range. Never throws, never returns NaN. Algorithm: the line {t s} and M seen along
// s. First whether the line's shadow, a point, is in M's: a search among the edges of the shadow of
// M from the shadow of c. Then a triangle of M's vertices around the line is pushed either way, as
// in kPortal. Proven by signs; what doubles leave open is finished by exact ones with the line
// moved symbolically towards c, which loses nothing: the ends depend on the line continuously.
// Complexity: about twenty support pairs.
StatusOr<DirectionalResult> DirectionalDistance(const ConvexPolyhedron& p,
                                                const ConvexPolyhedron& q, const RelativePose& pose,
                                                const Eigen::Vector3d& s,
                                                const DirectionalOptions& options = {});

// Section 6 of the paper to the letter, in doubles: the silhouettes of P and Q seen along s, their
// Minkowski difference, the triangle of its fan that holds the shadow of o, c = k s from the
// triangle's vertices and weights, and then CD-DUALITY from c. It exists to be judged: it answers
// for one end of the interval only, the one that the ray from c through o leaves M by; its search
// fails as CD-DUALITY does; and c may be on the boundary of M, which is a status. Complexity: O(m +
// n) but for sorting. Same errors.
StatusOr<PublishedTravel> DirectionalDistanceAsPublished(const ConvexPolyhedron& p,
                                                         const ConvexPolyhedron& q,
                                                         const RelativePose& pose,
                                                         const Eigen::Vector3d& s);

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_PROXIMITY_DIRECTIONAL_DISTANCE_H_
