// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_MINKOWSKI_CONFORM_INTERNAL_H_
#define TOUCHSTONE_CORE_MINKOWSKI_CONFORM_INTERNAL_H_

#include <span>
#include <vector>

#include "touchstone/core/minkowski/gauss_arrangement_internal.h"
#include "touchstone/core/minkowski/half_spaces_internal.h"

namespace touchstone::internal {

// Makes every piece an edge of the polyhedron, or a chain of edges, none of them flat, by cutting
// off edges that the piece crosses. `plane_of_vertex` names the plane of each vertex of the
// arrangement. Returns for each piece the planes along it, from tail to head.
//
// Where the great arc from plane p to plane q leaves the triangles round p through an edge (r, s),
// it meets it in a direction m on that edge, where both of the edge's corners are as far along m as
// any corner gets. A plane along m that passes closely below them cuts off the edge and no more, so
// p, m is an edge afterwards, and what is left of the arc crosses one edge fewer. So the chain has
// no more links than the arc crosses edges, whatever the angles. m is taken on the arc exactly and
// rounded along it, the more finely the more corners there are nearby; in the limit it is exact.
//
// Source: it takes the place of the claim in section 4.2 that the intersection of the half-spaces
// tangent at the vertices has the arcs by itself.
std::vector<std::vector<int>> MakeConforming(std::span<const ArcPiece> pieces,
                                             std::span<const Direction> poles,
                                             std::span<const int> plane_of_vertex,
                                             HalfSpaceIntersection* polyhedron);

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_MINKOWSKI_CONFORM_INTERNAL_H_
