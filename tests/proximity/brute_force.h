// SPDX-License-Identifier: MIT
//
// The proximity queries' slow twins: every pair of features, in doubles.
#ifndef TOUCHSTONE_TESTS_PROXIMITY_BRUTE_FORCE_H_
#define TOUCHSTONE_TESTS_PROXIMITY_BRUTE_FORCE_H_

#include <vector>

#include "touchstone/core/base/relative_pose.h"
#include "touchstone/core/convex/convex_polyhedron.h"
#include "touchstone/tests/cd_dual/placements.h"

namespace touchstone::testing {

// The distance of separate bodies: the least over all vertices of one and faces of the other, and
// over all pairs of edges. Good to 1e-13 of the size. O(E^2).
double DistanceByBruteForce(const ConvexPolyhedron& p, const ConvexPolyhedron& q,
                            const RelativePose& pose);

// The depth of overlapping bodies: the least height of M over o, over the normals of all faces of
// P, all faces of Q and all pairs of edges, in either sense; all facets of M are among them, and
// every supporting plane is at least as far as the nearest facet. Good to 1e-12 of the size for
// edges that are not nearly parallel, which are left out below a sine of 1e-6. O(E^2 n).
double DepthByBruteForce(const ConvexPolyhedron& p, const ConvexPolyhedron& q,
                         const RelativePose& pose);

// What the same planes leave of the line {t s}: those that face along s bound the travel from
// above, the others from below; `least_across` is the least height of M over o along normals across
// s, over the edges of P and Q. Planes nearly along s are left out.
struct TravelBounds {
  double enter, leave, least_across;
};
TravelBounds TravelByBruteForce(const ConvexPolyhedron& p, const ConvexPolyhedron& q,
                                const RelativePose& pose, const Eigen::Vector3d& s);

// The largest coordinate of P, of Q and of the translation, added up.
double SizeOf(const ConvexPolyhedron& p, const ConvexPolyhedron& q, const RelativePose& pose);

// Q seen from P turned into P seen from Q, for a rotation that is exactly orthonormal.
RelativePose Inverse(const RelativePose& pose);

// P and Q with all lengths multiplied by a power of two.
Placement Scaled(const Placement& x, double power_of_two);

// Round bodies of 20 to 60 vertices at any rotation, from deep in each other to far apart.
std::vector<Placement> RoundPlacements(std::uint64_t seed, int count);

// Bodies of very different sizes, and thin as needles, at any rotation; apart by the size over a
// random power of two from `low` to `high`: 240 of them.
std::vector<Placement> ExtremePlacements(std::uint64_t seed, int low, int high);

}  // namespace touchstone::testing

#endif  // TOUCHSTONE_TESTS_PROXIMITY_BRUTE_FORCE_H_
