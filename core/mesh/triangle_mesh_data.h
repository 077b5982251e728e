// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_MESH_TRIANGLE_MESH_DATA_H_
#define TOUCHSTONE_CORE_MESH_TRIANGLE_MESH_DATA_H_

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "touchstone/core/mesh/box_tree.h"

namespace touchstone {

// How the body bends at an edge, by its exact internal angle: below, equal to or above π.
enum class EdgeKind : std::uint8_t { kConvex, kFlat, kReflex };

std::string_view ToString(EdgeKind kind);

// A connected piece of a mesh's surface.
struct MeshComponent {
  int first_face;  // the smallest index of its faces
  int vertex_count, edge_count, face_count;
  // How many other components enclose it: the body lies inside a component of even depth, and
  // outside one of odd depth, which bounds a cavity.
  int depth;

  int euler_characteristic() const { return vertex_count - edge_count + face_count; }
  int genus() const { return 1 - euler_characteristic() / 2; }
};

// What a TriangleMesh holds; its accessors tell the meaning. Half-edge 3 f + k runs along side k of
// face f. Lists per vertex are flat: those of vertex v are [vertex_begin[v], vertex_begin[v + 1]).
struct TriangleMeshData {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Triangle> faces;
  std::vector<int> twins;
  std::vector<int> edge_of_half_edge, half_edge_of_edge;
  std::vector<EdgeKind> edge_kinds;
  std::vector<Eigen::Vector3d> face_normals;
  std::vector<int> facet_of_face;
  std::vector<int> vertex_begin, vertex_half_edges;
  std::vector<int> component_of_face;
  std::vector<MeshComponent> components;
  BoxTree box_tree;
  double max_coordinate = 0.0;

  int vertex_count() const { return static_cast<int>(vertices.size()); }
  int face_count() const { return static_cast<int>(faces.size()); }
  int half_edge_count() const { return 3 * face_count(); }
  int edge_count() const { return static_cast<int>(half_edge_of_edge.size()); }

  int tail(int h) const { return faces[h / 3][h % 3]; }
  int head(int h) const { return faces[h / 3][(h + 1) % 3]; }
  int apex(int h) const { return faces[h / 3][(h + 2) % 3]; }
};

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_MESH_TRIANGLE_MESH_DATA_H_
