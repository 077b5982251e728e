// SPDX-License-Identifier: MIT
//
// Two solids touch at a point z. Near z each is a cone: all that counts of it is its link, the
// region it cuts from a small sphere round z. Do the interiors of the two links meet? Then the
// interiors of the solids meet, however near z one looks.
#ifndef TOUCHSTONE_CORE_MESH_LINK_H_
#define TOUCHSTONE_CORE_MESH_LINK_H_

#include <Eigen/Core>
#include <vector>

#include "touchstone/core/base/dyadic.h"
#include "touchstone/core/mesh/triangle_mesh.h"

namespace touchstone {

// A direction, exact, and in doubles for filters: each coordinate of `rounded` is within 2^-53 of
// the exact one divided by a positive number, the largest is in [0.5, 1].
struct LinkDirection {
  DyadicVector exact;
  Eigen::Vector3d rounded;
};
LinkDirection MakeLinkDirection(const DyadicVector& exact);

// A link: the corners of a spherical polygon in order, with the solid on the left seen from
// outside the sphere. Sides are shorter than π; the polygon is simple, and no two consecutive sides
// lie on top of each other.
using Link = std::vector<LinkDirection>;

// Whether the interiors of two links share a point, exactly. Complexity: O(m n).
//
// Their boundaries are closed curves. Where they have a point in common, either sides cross, and
// the interiors meet; or a corner of one lies on the other, and there the interiors meet iff their
// two sectors do. If the curves meet somewhere but nowhere so, each stays outside the other's
// interior: the links only touch. If the curves have no point in common, the interiors meet iff
// a corner of one lies inside the other.
bool LinksOverlap(const Link& p, const Link& q);

// Whether a direction that is not on the link's boundary points into the solid, exactly.
// Complexity: O(n) in general position.
bool LinkHolds(const Link& link, const LinkDirection& direction);

// The link of mesh vertex v.
Link VertexLink(const TriangleMesh& mesh, int v);

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_MESH_LINK_H_
