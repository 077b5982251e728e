// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_MINKOWSKI_FACET_ORDER_INTERNAL_H_
#define TOUCHSTONE_CORE_MINKOWSKI_FACET_ORDER_INTERNAL_H_

#include <span>
#include <vector>

#include "touchstone/core/mesh/mesh_pair.h"
#include "touchstone/core/minkowski/sum_facet.h"

namespace touchstone::internal {

// The facets' numbers along a curve that fills space (Morton 1966), by one corner of each: what
// meets then lies close together in memory, too. Ties keep their order. The order depends neither
// on B's translation nor on powers of two in the scale. Complexity: O(n log n).
std::vector<int> AlongCurve(const MeshPair& pair, std::span<const SumFacet> facets);

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_MINKOWSKI_FACET_ORDER_INTERNAL_H_
