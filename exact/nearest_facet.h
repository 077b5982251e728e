// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef TOUCHSTONE_EXACT_NEAREST_FACET_H_
#define TOUCHSTONE_EXACT_NEAREST_FACET_H_

#include <optional>

#include "touchstone/exact/convert.h"

namespace touchstone::exact {

// A plane of M, n.x = height over M at most, with its distance from o: height / |n|, compared by
// squares, in the integer coordinates of the PlacedPair.
struct SupportingPlane {
  IntegerVector normal;  // outward
  Integer height;        // positive: o is strictly inside
};

// sign(distance of a - distance of b).
int CompareDistances(const SupportingPlane& a, const SupportingPlane& b);
// height / |n| in true lengths.
Real DistanceOf(const PlacedPair& pair, const SupportingPlane& plane);

// The facet of M nearest to o, exactly, by looking at all: every face of P, every face of Q and
// every pair of edges whose Gaussian arcs cross, in doubles with a bound, and exactly at what the
// bound leaves. Nothing when o is not strictly inside M. Facets with parallel features are among
// those of a face. Complexity: O(mn).
std::optional<SupportingPlane> NearestFacet(const PlacedPair& pair);

}  // namespace touchstone::exact

#endif  // TOUCHSTONE_EXACT_NEAREST_FACET_H_
