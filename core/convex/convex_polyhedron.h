// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_CONVEX_CONVEX_POLYHEDRON_H_
#define TOUCHSTONE_CORE_CONVEX_CONVEX_POLYHEDRON_H_

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "touchstone/core/base/status.h"
#include "touchstone/core/convex/convex_polyhedron_data.h"

namespace touchstone {

// A full-dimensional convex polyhedron: a closed set, in the body's own frame.
//
// Immutable after building; a copy shares the data, so bodies are cheap to pass, and any number of
// threads may query one. Coordinates are taken exactly. Faces are exactly planar convex polygons of
// any size, their loops counterclockwise seen from outside. Coplanar adjacent faces are legal, and
// so are vertices within an edge or a face; `facet_of_face` tells which faces lie in one plane.
class ConvexPolyhedron {
 public:
  // Validates and builds. Every sign that decides is exact (filtered in doubles, then by big
  // numbers). Returns the body, or a status that names the first offending element: kNonFinite,
  // kOutOfRange, kTooFewVertices, kTooFewFaces, kBadIndex, kDegenerateFace, kDuplicateVertex,
  // kUnreferencedVertex, kOpen, kNonManifold, kInconsistentOrientation, kNonPlanarFace, kNotConvex,
  // kFlat, kNoInteriorPoint. Complexity: O(n log n) for n vertices.
  static StatusOr<ConvexPolyhedron> Build(std::span<const Eigen::Vector3d> vertices,
                                          std::span<const std::vector<int>> faces);

  int vertex_count() const { return data_->vertex_count(); }
  int face_count() const { return data_->face_count(); }
  int edge_count() const { return data_->edge_count(); }

  std::span<const Eigen::Vector3d> vertices() const { return data_->vertices; }
  const Eigen::Vector3d& vertex(int v) const { return data_->vertices[v]; }
  const Edge& edge(int e) const { return data_->edges[e]; }

  // The loop of face f, counterclockwise from outside, as it was given.
  std::span<const int> face(int f) const {
    return Range(data_->face_vertices, data_->face_begin, f);
  }
  // Edge k of face f joins face(f)[k] to the next vertex of the loop.
  std::span<const int> face_edges(int f) const {
    return Range(data_->face_edges, data_->face_begin, f);
  }
  // Three vertices of face f that are not collinear, counterclockwise from outside: its exact
  // plane.
  std::array<int, 3> face_plane(int f) const { return data_->face_plane(f); }
  // The exterior normal of face f: of unit length, each entry within 2^-46 of the exact one's.
  const Eigen::Vector3d& face_normal(int f) const { return data_->face_normals[f]; }
  // Faces in one plane share a number, the smallest of their indices.
  int facet_of_face(int f) const { return data_->facet_of_face[f]; }

  // What meets at vertex v, counterclockwise seen from outside; the three lists run in step:
  // edge k joins v to neighbour k, face k lies between edges k and k + 1.
  std::span<const int> vertex_neighbors(int v) const {
    return Range(data_->vertex_neighbors, data_->vertex_begin, v);
  }
  std::span<const int> vertex_edges(int v) const {
    return Range(data_->vertex_edges, data_->vertex_begin, v);
  }
  std::span<const int> vertex_faces(int v) const {
    return Range(data_->vertex_faces, data_->vertex_begin, v);
  }

  // Whether the faces at edge e lie in different planes.
  bool is_bend(int e) const { return facet_of_face(edge(e).left) != facet_of_face(edge(e).right); }
  // Whether v is an extreme point: three or more bends meet there. At a corner the neighbours span
  // the body's cone; at a vertex within an edge or a facet they need not.
  bool is_corner(int v) const;
  // How far the cone of v's edges is from flat: a unit axis makes at least this cosine with each of
  // them. Positive only at corners; if no edge w - v of a corner has n.(w - v) > eps |w - v|, then
  // no point of the body is further along n than v by more than eps times the diameter over this.
  double corner_margin(int v) const { return data_->corner_margins[v]; }

  // The face across edge e from face f.
  int face_across(int e, int f) const { return edge(e).left == f ? edge(e).right : edge(e).left; }

  // Two distinct points, proven strictly interior by exact signs: 0 near the middle, 1 off it, both
  // off its symmetries.
  const Eigen::Vector3d& interior_point(int i) const { return data_->interior[i]; }

  // An ellipsoid and a ball around interior_point(0) that hold the body: a bound for proofs and a
  // guide for searches.
  const BoundingEllipsoid& bounding_ellipsoid() const { return data_->bounding_ellipsoid; }

  // max over vertices of the largest absolute coordinate: the size that error bounds refer to.
  double max_coordinate() const { return data_->max_coordinate; }
  // At least the distance between any two points of the body, and less than twice that.
  double diameter_bound() const { return data_->diameter_bound; }

  // Asks for the memory that any query will touch.
  void Prefetch() const {
    const auto* first = reinterpret_cast<const char*>(data_.get());
    for (std::size_t i = 0; i < sizeof(ConvexPolyhedronData::interior) + sizeof(BoundingEllipsoid);
         i += 64)
      __builtin_prefetch(first + i);
    data_->support.Prefetch();
  }

  // What SupportVertex (support.h) climbs on.
  const SupportTable& support_table() const { return data_->support; }

  // Checks every structural invariant from scratch; kOk for any body that `Build` returned.
  Status FindValidationError() const;

 private:
  explicit ConvexPolyhedron(std::shared_ptr<const ConvexPolyhedronData> data)
      : data_(std::move(data)) {}

  static std::span<const int> Range(const std::vector<int>& items, const std::vector<int>& begin,
                                    int i) {
    return {items.data() + begin[i], items.data() + begin[i + 1]};
  }

  std::shared_ptr<const ConvexPolyhedronData> data_;
};

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_CONVEX_CONVEX_POLYHEDRON_H_
