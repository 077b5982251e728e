// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_MINKOWSKI_SAMPLE_INTERNAL_H_
#define TOUCHSTONE_CORE_MINKOWSKI_SAMPLE_INTERNAL_H_

#include <Eigen/Core>
#include <array>

#include "touchstone/core/base/verdict.h"
#include "touchstone/core/mesh/membership.h"
#include "touchstone/core/mesh/translation.h"
#include "touchstone/core/minkowski/arrangement_internal.h"
#include "touchstone/core/minkowski/sum_geometry_internal.h"

namespace touchstone::internal {

// A point with big numbers and its rounding, in A's frame and true lengths.
struct Sample {
  Eigen::Vector3d rounded;
  double error;
  ExactPoint exact;
};

// A point strictly inside a triangle of points in the facet's plane, and exactly in that plane.
Sample SampleIn(SumGeometry* geometry, const ArrangedFacet& facet,
                const std::array<int, 3>& triangle);

// The middle between two points.
Sample SampleBetween(SumGeometry* geometry, int x, int y);

// Whether B moved to the same samples overlaps A: first with the samples' roundings, and with big
// numbers only where doubles cannot tell.
Verdict VerdictIn(SumGeometry* geometry, const ArrangedFacet& facet,
                  const std::array<int, 3>& triangle, MembershipCache* cache);
Verdict VerdictBetween(SumGeometry* geometry, int x, int y, MembershipCache* cache);

// Four times the square of a triangle's area, rounded.
double SquaredArea(const SumGeometry& geometry, const std::array<int, 3>& triangle);

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_MINKOWSKI_SAMPLE_INTERNAL_H_
