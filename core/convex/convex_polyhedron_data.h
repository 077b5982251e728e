// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_CONVEX_CONVEX_POLYHEDRON_DATA_H_
#define TOUCHSTONE_CORE_CONVEX_CONVEX_POLYHEDRON_DATA_H_

#include <Eigen/Core>
#include <array>
#include <vector>

#include "touchstone/core/convex/bounding_ellipsoid.h"
#include "touchstone/core/convex/support_table.h"

namespace touchstone {

// An edge, run from `tail` to `head`: `left` lies on its left seen from outside (the face whose
// loop runs tail -> head), `right` on its right.
struct Edge {
  int tail, head;
  int left, right;
};

// What a ConvexPolyhedron holds; its accessors tell the meaning. Lists per face and per vertex are
// flat: those of face f are [face_begin[f], face_begin[f + 1]). What every query reads comes first,
// in one run of cache lines.
struct alignas(64) ConvexPolyhedronData {
  std::array<Eigen::Vector3d, 2> interior;
  double max_coordinate = 0.0;
  double diameter_bound = 0.0;
  BoundingEllipsoid bounding_ellipsoid;
  SupportTable support;

  std::vector<Eigen::Vector3d> vertices;
  std::vector<int> face_begin, face_vertices, face_edges;
  std::vector<std::array<int, 3>> face_planes;  // empty where all faces are triangles
  std::vector<Eigen::Vector3d> face_normals;
  std::vector<int> facet_of_face;
  std::vector<Edge> edges;
  std::vector<int> vertex_begin, vertex_neighbors, vertex_edges, vertex_faces;
  std::vector<double> corner_margins;

  std::array<int, 3> face_plane(int f) const {
    if (!face_planes.empty()) return face_planes[f];
    const int* loop = &face_vertices[3 * static_cast<std::size_t>(f)];
    return {loop[0], loop[1], loop[2]};
  }

  int vertex_count() const { return static_cast<int>(vertices.size()); }
  int face_count() const { return static_cast<int>(face_begin.size()) - 1; }
  int edge_count() const { return static_cast<int>(edges.size()); }
};

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_CONVEX_CONVEX_POLYHEDRON_DATA_H_
