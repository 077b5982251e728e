// SPDX-License-Identifier: MIT
//
//   paper        here              meaning, in A's frame
//   M°           Membership        int A ⊕ -int B: x lies in it iff the interiors of A and B + x
//                                  meet
//   ∂M           SumBoundary       closure(M°) minus M°
//   A ⊗ -B       Convolution       the facets that ∂M is made of pieces of
#ifndef TOUCHSTONE_CORE_MINKOWSKI_BOUNDARY_H_
#define TOUCHSTONE_CORE_MINKOWSKI_BOUNDARY_H_

#include "touchstone/core/mesh/mesh_pair.h"
#include "touchstone/core/minkowski/convolution.h"
#include "touchstone/core/minkowski/gauss_map.h"
#include "touchstone/core/minkowski/sum_boundary.h"

namespace touchstone {

// ∂M whole: facets in all orders of the plane cut against each other, pieces kept or dropped by one
// membership test for each patch of them. Every decision is exact.
//
// Complexity: O(n log n + k log k) for n facets and k pairs of them that come near each other, when
// planes hold few facets each. No errors.
SumBoundary BuildSumBoundary(const MeshPair& pair, const GaussMap& a, const GaussMap& b);

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_MINKOWSKI_BOUNDARY_H_
