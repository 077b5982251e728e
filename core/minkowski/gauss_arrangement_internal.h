// SPDX-License-Identifier: MIT
//
//   paper            here                 meaning
//   arrangement of   GaussArrangement     the arcs of G(A), cut where they meet
//   G(A)
#ifndef TOUCHSTONE_CORE_MINKOWSKI_GAUSS_ARRANGEMENT_INTERNAL_H_
#define TOUCHSTONE_CORE_MINKOWSKI_GAUSS_ARRANGEMENT_INTERNAL_H_

#include <vector>

#include "touchstone/core/mesh/triangle_mesh.h"
#include "touchstone/core/minkowski/directions_internal.h"
#include "touchstone/core/minkowski/gauss_map.h"

namespace touchstone::internal {

// A piece of an arc, or of several that run on top of each other: shorter than half a circle, with
// no vertex of the arrangement inside. It runs counterclockwise round its pole.
struct ArcPiece {
  int tail, head;
  int pole;                // which of GaussArrangement::poles
  std::vector<int> edges;  // of the mesh; none: the cone of a special vertex
};

// The arrangement on the sphere, exact throughout. Its vertices are the normals of all faces, the
// points where arcs cross, the middles of arcs longer than half a circle, and the ends of the cones
// of special vertices, which are rays or sectors and go with it as arcs.
//
// Complexity: O(n log n + p) for p pairs of arcs whose cones meet.
struct GaussArrangement {
  DirectionTable vertices;
  std::vector<int> vertex_of_face;  // by face of the mesh
  std::vector<Direction> poles;
  std::vector<ArcPiece> pieces;
  int arc_count = 0;  // before cutting
};

// With `with_reflex`, of all arcs; else of those of convex edges, which bound all cones along which
// anything can be in contact.
GaussArrangement ArrangeGaussMap(const TriangleMesh& mesh, const GaussMap& map, bool with_reflex);

// Along edge e as its half-edge runs.
Direction DirectionOfEdge(const TriangleMesh& mesh, int e);
Direction NormalOfFace(const TriangleMesh& mesh, int f);

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_MINKOWSKI_GAUSS_ARRANGEMENT_INTERNAL_H_
