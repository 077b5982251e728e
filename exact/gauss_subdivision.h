// SPDX-License-Identifier: GPL-3.0-or-later
//
//   paper          here              meaning
//   C(A)           Subdivision       a convex polyhedron, by planes and by which meet at each
//   vertex Definition 2   FindMissingArcs   its Gauss map subdivides the arrangement of G(A)
#ifndef TOUCHSTONE_EXACT_GAUSS_SUBDIVISION_H_
#define TOUCHSTONE_EXACT_GAUSS_SUBDIVISION_H_

#include <array>
#include <string>
#include <vector>

#include "touchstone/core/mesh/triangle_mesh.h"
#include "touchstone/exact/integer.h"

namespace touchstone::exact {

// What claims to be a convex polyhedron round the origin: {x : normal.x = offset} the planes of its
// faces, and for each vertex the faces round it, counterclockwise seen from outside.
struct Subdivision {
  std::vector<IntegerVector> normals;
  std::vector<Integer> offsets;
  std::vector<std::vector<int>> vertices;
};

// What is wrong with it; empty if nothing is. Checked exactly: offsets are positive; the planes at
// a vertex pass through one point, and their normals run counterclockwise; every edge has two
// vertices and each lies strictly below the planes of the other that are not the edge's; the whole
// is connected, a sphere by Euler's formula, and covers each direction once. That makes it the
// boundary of a convex polyhedron, each of its normals one face's.
std::string FindPolyhedronError(const Subdivision& subdivision);

// An arc of G(A): of the mesh's edge from vertex `tail` to `head`.
struct MissingArc {
  int tail, head;
  bool is_reflex;
};
struct ArcFindings {
  int arcs = 0;
  std::vector<MissingArc> missing;
};

// The arcs of G(A), of convex edges and, if asked for, of reflex ones, that are not unions of arcs
// between faces of the subdivision that share an edge. If none is missing, every region of the
// arrangement of these arcs is a union of regions of the subdivision. Exactly: an arc is followed
// from one face normal to the other through faces whose normals are orthogonal to the edge.
// Complexity: O(n d log n) for d edges at a face.
ArcFindings FindMissingArcs(const TriangleMesh& mesh, const Subdivision& subdivision,
                            bool with_reflex);

// The same for a subdivision whose normals are rounded: followed through faces within an angle of
// `tolerance` of the arc, in doubles.
ArcFindings FindMissingArcsNear(const TriangleMesh& mesh, const Subdivision& subdivision,
                                bool with_reflex, double tolerance);

// Does the subdivision equal what CGAL's convex hull makes of the planes' poles, normal / offset?
// Its regions cut into triangles and in any order. For planes all of whose poles are extreme.
bool IsIntersectionOfHalfSpaces(const Subdivision& subdivision);

}  // namespace touchstone::exact

#endif  // TOUCHSTONE_EXACT_GAUSS_SUBDIVISION_H_
