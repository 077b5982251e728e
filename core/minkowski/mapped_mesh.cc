// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/mapped_mesh.h"

#include <algorithm>

#include "touchstone/core/minkowski/gauss_arrangement_internal.h"

namespace touchstone {

using Eigen::Vector3d;

MappedMesh::MappedMesh(const TriangleMesh& mesh_in)
    : mesh(mesh_in),
      gauss_map(mesh),
      convex_map(ConvexMap::Conforming(mesh, gauss_map, MapArcs::kConvex)) {
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    if (gauss_map.vertex_kind(v) == VertexKind::kSpecial) special_vertices.push_back(v);
  }
  for (int e = 0; e < mesh.edge_count(); ++e) {
    along.push_back(internal::DirectionOfEdge(mesh, e).unit);
  }
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    cone_begin.push_back(static_cast<int>(cone_sides.size()));
    const auto essential = gauss_map.essential_neighbors(v);
    for (const int h : mesh.vertex_half_edges(v)) {
      const int e = mesh.edge_of(h);
      const bool bounds =
          gauss_map.vertex_kind(v) == VertexKind::kSpecial ||
          std::find(essential.begin(), essential.end(), mesh.head(h)) != essential.end();
      if (bounds) cone_sides.push_back(mesh.half_edge_of(e) == h ? along[e] : Vector3d(-along[e]));
    }
  }
  cone_begin.push_back(static_cast<int>(cone_sides.size()));
}

}  // namespace touchstone
