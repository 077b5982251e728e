// SPDX-License-Identifier: MIT
//
// Signs of points of M that distances and depths rest on, as cd_dual/signs.h: filtered in doubles
// with derived bounds, exact where the filter fails and the caller allows it, nothing otherwise.
#ifndef TOUCHSTONE_CORE_PROXIMITY_SIGNS_OF_POINTS_H_
#define TOUCHSTONE_CORE_PROXIMITY_SIGNS_OF_POINTS_H_

#include <array>
#include <optional>

#include "touchstone/core/cd_dual/signs.h"

namespace touchstone {

// The sign of (to - from).at, three points of M.
std::optional<int> AlongEdge(Signs* signs, VertexPair to, VertexPair from, VertexPair at);

// N.(a x b) with the plane's normal N: positive when the foot of o on the plane lies to the left of
// a -> b seen against N. For the three sides of a triangle that spans the plane, the signs of the
// foot's weights.
std::optional<int> FootSide(Signs* signs, const FacetPlane& plane, VertexPair a, VertexPair b);

// The sign of N.(w - points[0]) with N the normal of the plane through three points of M: positive
// when w lies beyond the plane. Four points that features make coplanar are known to be without
// computing.
std::optional<int> Beyond(Signs* signs, const std::array<VertexPair, 3>& points, VertexPair w);

// Whether the four points lie in one plane by what they are: a parallelogram of two vertices of P
// and two of Q, or four vertices of one facet of a body over one vertex of the other.
bool CoplanarByIdentity(const MinkowskiDifference& m, const std::array<VertexPair, 4>& points);

// The sign of (distance of o from the plane through a) - (that from the plane through b), both
// planes with o strictly on their inner side. Exact.
int CompareDistances(Signs* signs, const std::array<VertexPair, 3>& a,
                     const std::array<VertexPair, 3>& b);

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_PROXIMITY_SIGNS_OF_POINTS_H_
