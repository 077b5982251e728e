// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_MINKOWSKI_SAMPLE_INTERNAL_H_
#define TOUCHSTONE_CORE_MINKOWSKI_SAMPLE_INTERNAL_H_

#include <array>

#include "touchstone/core/base/verdict.h"
#include "touchstone/core/mesh/membership.h"
#include "touchstone/core/minkowski/arrangement_internal.h"
#include "touchstone/core/minkowski/sum_geometry_internal.h"

namespace touchstone::internal {

// Whether B overlaps A when it is moved to a point strictly inside a triangle of points in the
// facet's plane, exactly in that plane; and to one between two points. First with the points'
// roundings, and with big numbers only where doubles cannot tell.
Verdict VerdictIn(SumGeometry* geometry, const ArrangedFacet& facet,
                  const std::array<int, 3>& triangle, MembershipCache* cache);
Verdict VerdictBetween(SumGeometry* geometry, int x, int y, MembershipCache* cache);

// Four times the square of a triangle's area, rounded.
double SquaredArea(const SumGeometry& geometry, const std::array<int, 3>& triangle);

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_MINKOWSKI_SAMPLE_INTERNAL_H_
