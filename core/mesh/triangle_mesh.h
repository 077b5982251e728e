// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_MESH_TRIANGLE_MESH_H_
#define TOUCHSTONE_CORE_MESH_TRIANGLE_MESH_H_

#include <Eigen/Core>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "touchstone/core/base/status.h"
#include "touchstone/core/mesh/triangle_mesh_data.h"

namespace touchstone {

// A solid bounded by triangles, in its own frame: several pieces, holes and cavities are allowed.
//
// Immutable after building; a copy shares the data, so meshes are cheap to pass, and any number of
// threads may query one. Coordinates are taken exactly. Faces run counterclockwise seen from
// outside the solid. Coplanar adjacent faces are legal; `facet_of_face` tells which hang together
// in one plane.
//
// The surface must be embedded: no two faces may share points beyond the vertices and edges that
// they name. `Build` checks what hangs together (see there); that faces far apart in the structure
// do not cross is for the caller to know, or for exact::FindSelfIntersection to check.
class TriangleMesh {
 public:
  // Validates and builds. Every sign that decides is exact (filtered in doubles, then by big
  // numbers). Returns the mesh, or a status that names the first offending element:
  //   kNonFinite, kOutOfRange           a coordinate
  //   kTooFewVertices, kTooFewFaces     fewer than four
  //   kBadIndex, kDegenerateFace        a face's vertices: unknown, repeated, collinear
  //   kDuplicateVertex, kUnreferencedVertex
  //   kOpen, kNonManifold, kInconsistentOrientation   an edge, by its vertices
  //   kNonManifold                      a vertex whose faces make more than one cycle
  //   kFolded                           an edge whose two faces lie on top of each other
  //   kFlat                             a component that encloses no volume, by its first face
  //   kInward                           a component that faces the wrong way, by its first face
  //
  // Which way is right: a component that an even number of others enclose must enclose positive
  // volume, one that an odd number enclose bounds a cavity and must enclose negative volume. It
  // is enclosed where a ray from a vertex of it meets the other an odd number of times.
  //
  // Complexity: O(n log n + n c) for n vertices and c components.
  static StatusOr<TriangleMesh> Build(std::span<const Eigen::Vector3d> vertices,
                                      std::span<const Triangle> faces);

  int vertex_count() const { return data_->vertex_count(); }
  int face_count() const { return data_->face_count(); }
  int edge_count() const { return data_->edge_count(); }
  int half_edge_count() const { return data_->half_edge_count(); }

  std::span<const Eigen::Vector3d> vertices() const { return data_->vertices; }
  std::span<const Triangle> faces() const { return data_->faces; }
  const Eigen::Vector3d& vertex(int v) const { return data_->vertices[v]; }
  const Triangle& face(int f) const { return data_->faces[f]; }

  // Half-edge h = 3 f + k runs from face(f)[k] to face(f)[(k + 1) % 3] with face f on its left.
  static int face_of(int h) { return h / 3; }
  static int next(int h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static int previous(int h) { return h % 3 == 0 ? h + 2 : h - 1; }
  int tail(int h) const { return data_->tail(h); }
  int head(int h) const { return data_->head(h); }
  // The vertex of its face opposite to it.
  int apex(int h) const { return data_->apex(h); }
  // The half-edge that runs the other way.
  int twin(int h) const { return data_->twins[h]; }

  // Edges are numbered; each is named by one of its half-edges, the smaller.
  int edge_of(int h) const { return data_->edge_of_half_edge[h]; }
  int half_edge_of(int e) const { return data_->half_edge_of_edge[e]; }
  EdgeKind edge_kind(int e) const { return data_->edge_kinds[e]; }

  // The half-edges that leave v, counterclockwise seen from outside.
  std::span<const int> vertex_half_edges(int v) const {
    return {data_->vertex_half_edges.data() + data_->vertex_begin[v],
            data_->vertex_half_edges.data() + data_->vertex_begin[v + 1]};
  }

  // The exterior normal of face f: of unit length, each entry within 2^-46 of the exact one's.
  const Eigen::Vector3d& face_normal(int f) const { return data_->face_normals[f]; }
  // Faces that hang together through flat edges share a number, the smallest of their indices.
  int facet_of_face(int f) const { return data_->facet_of_face[f]; }

  std::span<const MeshComponent> components() const { return data_->components; }
  int component_of_face(int f) const { return data_->component_of_face[f]; }

  // max over vertices of the largest absolute coordinate: the size that error bounds refer to.
  double max_coordinate() const { return data_->max_coordinate; }

  // Boxes round the faces, in the body's own frame.
  const BoxTree& box_tree() const { return data_->box_tree; }

  // Checks every invariant from scratch; kOk for any mesh that `Build` returned.
  Status FindValidationError() const;

 private:
  explicit TriangleMesh(std::shared_ptr<const TriangleMeshData> data) : data_(std::move(data)) {}

  std::shared_ptr<const TriangleMeshData> data_;
};

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_MESH_TRIANGLE_MESH_H_
