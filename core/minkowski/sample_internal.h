// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_MINKOWSKI_SAMPLE_INTERNAL_H_
#define TOUCHSTONE_CORE_MINKOWSKI_SAMPLE_INTERNAL_H_

#include <array>
#include <span>

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

// A plane, and whether facets in it face as its normal does, 1, or the other way, 0.
using FacingPlane = std::array<int, 2>;

// Whether planes that all pass through one point certainly face one side more or less: their
// outward normals all agree with some direction. If facets in these planes, with borders there, are
// all that holds the point, M° near it lies below one plane or another: a way out of a cone of M°
// leaves it through a facet, upwards, so where it began was below. So along that direction there is
// none of M°, unless the point lies in it; and since there is some beside, ∂M has a cell there.
bool FaceOneSide(const SumGeometry& geometry, std::span<const FacingPlane> planes);

// Four times the square of a triangle's area, rounded.
double SquaredArea(const SumGeometry& geometry, const std::array<int, 3>& triangle);

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_MINKOWSKI_SAMPLE_INTERNAL_H_
