// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_CD_DUAL_EXACT_PORTAL_H_
#define TOUCHSTONE_CORE_CD_DUAL_EXACT_PORTAL_H_

#include <array>

#include "touchstone/core/cd_dual/result.h"
#include "touchstone/core/cd_dual/signs.h"

namespace touchstone {

struct ExactExit {
  std::array<VertexPair, 3> triangle;  // of the exit facet, counterclockwise from outside
  int side_of_origin;                  // 1 inside the facet's plane, 0 in it, -1 beyond it
};

// The exit facet by exact signs: what finishes a query that doubles could not. `start` is a
// triangle of M's vertices that the ray from c through o probably crosses; it is checked, and if it
// fails the search starts from where the ray leaves P - q0.
//
// The ray's direction r is perturbed symbolically, to r + (eps, eps^2, eps^3) for an eps smaller
// than any number in sight: a determinant det[a b r] that vanishes takes the sign of the first
// coordinate of a x b that does not. So the ray always crosses the interior of exactly one triangle
// of a fan.
//
// Terminates: each round replaces the triangle by one that the perturbed ray crosses strictly
// further from c (the new vertex lies strictly beyond the old plane, and the ray leaves the
// tetrahedron they span through the new triangle), so no triple of M's vertices comes back, and
// there are finitely many. What it returns is exact: the plane supports M, and the ray crosses the
// closed triangle. Complexity: O(F) exact predicates to start afresh, then a few dozen a round.
ExactExit FindExactExit(Signs* signs, const std::array<VertexPair, 3>& start, PhaseCounts* counts);

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_CD_DUAL_EXACT_PORTAL_H_
