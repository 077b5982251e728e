// SPDX-License-Identifier: MIT
//
// Which facets cut each other, and where: exactly.
#ifndef TOUCHSTONE_CORE_MINKOWSKI_FACET_CROSSING_INTERNAL_H_
#define TOUCHSTONE_CORE_MINKOWSKI_FACET_CROSSING_INTERNAL_H_

#include <array>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "touchstone/core/minkowski/facet_triage_internal.h"
#include "touchstone/core/minkowski/sum_geometry_internal.h"

namespace touchstone::internal {

// Facets f < g that each have corners on both sides of the other's plane, or in it.
struct FacetPair {
  int f, g;
  CornerSides of_f, of_g;
};

struct FacetPairs {
  std::vector<FacetPair> pairs;  // in order
  long box_pairs = 0;            // pairs compared
};

// All pairs of facets that may cross: of those given, or of all. Coplanar ones are united.
// Complexity: O(k) for k pairs given, else O(n log n + k) for k pairs of boxes that meet.
FacetPairs FindCrossingFacets(SumGeometry* geometry, std::span<const ArrangedFacet> facets,
                              std::optional<std::span<const std::pair<int, int>>> near);

// The segment in which two facets cross.
struct FacetCrossing {
  int axis;                       // a coordinate that rises along it
  std::array<int, 2> ends;        // points
  bool is_inside_f, is_inside_g;  // whether it passes through the inside, rather than along an edge
};

// Nothing if the facets of the pair share no segment.
std::optional<FacetCrossing> CrossingOf(SumGeometry* geometry,
                                        std::span<const ArrangedFacet> facets,
                                        const FacetPair& pair);

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_MINKOWSKI_FACET_CROSSING_INTERNAL_H_
