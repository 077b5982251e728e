// SPDX-License-Identifier: MIT
//
// From the facets that matter to the local sum: what all builders share.
#ifndef TOUCHSTONE_CORE_MINKOWSKI_LOCAL_ASSEMBLY_INTERNAL_H_
#define TOUCHSTONE_CORE_MINKOWSKI_LOCAL_ASSEMBLY_INTERNAL_H_

#include <utility>
#include <vector>

#include "touchstone/core/mesh/membership.h"
#include "touchstone/core/minkowski/local_sum.h"
#include "touchstone/core/minkowski/scaled_ball_internal.h"
#include "touchstone/core/minkowski/sum_geometry_internal.h"

namespace touchstone::internal {

// Facets in the order of their names. Active are those that meet the ball, by `gathering_reach`;
// the others listed include all that meet an active one, but where both name what they share.
struct GatheredFacets {
  std::vector<SumFacet> facets;
  std::vector<char> is_active;
  // Numbers f < g of facets, one of them active: all that may meet, but where both name what they
  // share. Not set where all facets of the convolution are active.
  std::vector<std::pair<int, int>> near;
};

enum class AssemblyScope {
  kBall,   // only cells that meet the ball are told from others
  kWhole,  // the whole boundary first; needs all facets, and finds which are near each other
};

// Fills everything in the sum that follows from the facets: all but `status`, `changes`, `dropped`
// and `candidates`. The geometry is the pair's, and is made anew in its storage. Complexity: O(k
// log k) for k facets and crossings.
void AssembleLocalSum(SumGeometry* geometry, const GatheredFacets& gathered, const ScaledBall& ball,
                      AssemblyScope scope, MembershipCache* cache, LocalSum* sum);

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_MINKOWSKI_LOCAL_ASSEMBLY_INTERNAL_H_
