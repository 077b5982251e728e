// SPDX-License-Identifier: MIT
//
// Why the checks below prove that the surface bounds a convex body. The method is that of Mehlhorn,
// Näher, Seel, Seidel, Schilz, Schirra, Uhrig, "Checking geometric programs or verification of
// geometric structures", Computational Geometry 12 (1999).
//
// Given: faces that are convex simple polygons in their planes, glued to one closed oriented
// connected surface S whose vertices have one cycle of faces each (BuildTopology, BuildFacePlanes);
// a point o strictly below every face's plane; at every edge, each face strictly below the other's
// plane, or coplanar with it and not folded back on it.
//
// Project S from o onto the unit sphere. A face's plane misses o, so the face maps one to one, and
// orientation is kept because o is below. Two faces at an edge run it in opposite senses, so their
// images lie on either side of the image of the edge. Hence the map is a local homeomorphism away
// from the vertices, and at a vertex it winds w >= 1 times: a branched covering. All points of the
// sphere off the branch points then have the same number of preimages, the degree. Convexity at the
// edges does not make that number one: the bipyramid over a pentagram is convex at all its 15
// edges, has V - E + F = 2 and a centre below all its planes, and covers the sphere twice. So it is
// counted: a ray strictly inside the cone of one face must miss the closed cones of all others (a
// point whose preimages lay on two faces would have neighbours with two preimages). With degree
// one, S meets every ray from o once (and V - E + F = 2 follows).
//
// Then let h_f be the linear function (about o) that is 1 on the plane of f, and g the function
// that equals h_f on the cone of f. It is continuous, S = {g = 1}, and across the wall between the
// cones of two faces it bends upward or not at all: that is what convexity at their edge says. A
// generic line crosses cones through such walls only, so g is convex along it, and by continuity
// along every line. So {g <= 1} is convex, S is its boundary, and o lies in its interior.
#ifndef TOUCHSTONE_CORE_CONVEX_CONVEXITY_INTERNAL_H_
#define TOUCHSTONE_CORE_CONVEX_CONVEXITY_INTERNAL_H_

#include <optional>
#include <vector>

#include "touchstone/core/base/orientation.h"
#include "touchstone/core/base/status.h"
#include "touchstone/core/convex/convex_polyhedron_data.h"
#include "touchstone/core/convex/face_planes_internal.h"

namespace touchstone::internal {

// Returns kFlat if all vertices lie in one plane. Complexity: O(n).
Status CheckFullDimensional(const Orientation& orientation, const ConvexPolyhedronData& data);

// Checks every edge and fills facet_of_face. Returns kNotConvex, or kInconsistentOrientation when
// every edge is convex seen from the other side. Complexity: O(n α(n)).
Status CheckLocalConvexity(const Orientation& orientation, const std::vector<FaceAxis>& axes,
                           ConvexPolyhedronData* data);

// Returns kNotConvex unless the projection from `o`, strictly below every face's plane, has degree
// one. Complexity: O(n).
Status CheckSingleWinding(const Orientation& orientation, const ConvexPolyhedronData& data,
                          const ScaledPoint& o);

// A vertex strictly beyond the plane of face f. Complexity: O(n).
std::optional<int> FindVertexBeyond(const Orientation& orientation,
                                    const ConvexPolyhedronData& data, int f);

Status VertexBeyondFace(int face, int vertex);

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_CONVEX_CONVEXITY_INTERNAL_H_
