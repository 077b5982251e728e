// SPDX-License-Identifier: MIT
//
// The half-spaces that a convex map is the intersection of.
#ifndef TOUCHSTONE_CORE_MINKOWSKI_TANGENT_PLANES_INTERNAL_H_
#define TOUCHSTONE_CORE_MINKOWSKI_TANGENT_PLANES_INTERNAL_H_

#include <vector>

#include "touchstone/core/mesh/triangle_mesh.h"
#include "touchstone/core/minkowski/directions_internal.h"
#include "touchstone/core/minkowski/gauss_arrangement_internal.h"
#include "touchstone/core/minkowski/half_spaces_internal.h"

namespace touchstone::internal {

bool IsConvexBody(const TriangleMesh& mesh);

// The planes of a convex body's faces, one for each vertex of the arrangement, about the mean of
// its vertices.
std::vector<HalfSpace> OwnPlanes(const TriangleMesh& mesh, const GaussArrangement& arrangement);

// Tangent to the unit sphere, moved out by up to 2^-128 of the radius, by a fixed rule.
HalfSpace NearlyTangentPlane(const Direction& direction, int number);

// {x : n.x <= 1} for the rounded normal n.
HalfSpace RoundedTangentPlane(const Direction& direction);

// Cuts by all planes, in an order of its own; plane k, with direction k, has number
// plane_of_vertex[k] in the polyhedron. Complexity: as HalfSpaceIntersection has it.
HalfSpaceIntersection IntersectionOf(const std::vector<Direction>& directions,
                                     const std::vector<HalfSpace>& planes, bool keep_all,
                                     std::vector<int>* plane_of_vertex);

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_MINKOWSKI_TANGENT_PLANES_INTERNAL_H_
