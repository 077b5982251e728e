// SPDX-License-Identifier: MIT
//
//   paper        here                 meaning
//   G(A)         GaussMap             of a mesh A
//   C(A)         ConvexMap            a convex polyhedron whose Gauss map subdivides that of A
//   f̄, G(f̄)      face, direction      a face of it, a point of the sphere
//   ē, G(ē)      edge, pole           an edge, the arc between two such points, and its pole
//   v̄, G(v̄)      vertex               a vertex, a convex region of the sphere
//   F̄, Ē, V̄      faces_at,            correspondence sets: the features of A that a feature of the
//                edges_along,         map stands for
//                vertices_over
#ifndef TOUCHSTONE_CORE_MINKOWSKI_CONVEX_MAP_H_
#define TOUCHSTONE_CORE_MINKOWSKI_CONVEX_MAP_H_

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "touchstone/core/mesh/triangle_mesh.h"
#include "touchstone/core/minkowski/gauss_map.h"
#include "touchstone/core/minkowski/integers.h"

namespace touchstone {

// Of which edges the arcs count.
enum class MapArcs : std::uint8_t {
  kAll,     // convex and reflex, as the paper has it
  kConvex,  // convex alone: they bound the cone of every vertex that can be in contact. Nearly
            // whole great circles of reflex edges, each crossing each other, are what makes the
            // rest big
};

// An edge of the map: counterclockwise seen from outside the sphere, `left` lies on the left on the
// way from `tail` to `head`.
struct MapEdge {
  int tail, head;   // faces of the map: points of the sphere
  int left, right;  // vertices of the map: regions
};

// A plane of the map: normal . x = offset, offset > 0, exactly.
struct MapPlane {
  IntegerVector normal;
  Integer offset;
};

// The convex map of a mesh: a convex polyhedron round the origin, whose faces, edges and vertices
// stand for directions, arcs and regions on the sphere. Immutable; a copy is cheap.
class ConvexMap {
 public:
  // Algorithm 1 as printed: the planes tangent to the unit sphere at the vertices of the
  // arrangement of G(A), their normals rounded to doubles n, {x : n.x = 1} taken exactly. The
  // arrangement itself is exact. Planes that no part of the surface lies in (nearly equal normals)
  // leave no face. Its arcs need not run along edges, nor its cones be unions of regions (README):
  // `edges_along` lists what arcs do run along an edge, `vertices_over` whose cones hold the middle
  // of the region.
  static ConvexMap AsPublished(const TriangleMesh& mesh, const GaussMap& map,
                               MapArcs arcs = MapArcs::kAll);

  // A convex map that conforms: every arc is a chain of edges, so every cone a union of regions.
  // For a convex body it is the body itself, coplanar faces merged, moved so that the origin lies
  // inside. Else the planes are tangent to the unit sphere but for 2^-128, and more of them cut off
  // the edges that cross arcs (conform_internal.h).
  //
  // Complexity: O(n log n) expected for n vertices of the arrangement, and O(1) for each arc and
  // edge that cross; the signs are exact.
  static ConvexMap Conforming(const TriangleMesh& mesh, const GaussMap& map,
                              MapArcs arcs = MapArcs::kAll);

  int face_count() const { return static_cast<int>(data_->planes.size()); }
  int edge_count() const { return static_cast<int>(data_->edges.size()); }
  int vertex_count() const { return static_cast<int>(data_->vertex_begin.size()) - 1; }

  // The outward normal of a face, of unit length, each coordinate within 2^-51.
  const Eigen::Vector3d& direction(int face) const { return data_->directions[face]; }
  const MapPlane& plane(int face) const { return data_->planes[face]; }
  const MapEdge& edge(int e) const { return data_->edges[e]; }
  // tail x head, of unit length, each coordinate within 2^-51: positive towards the left.
  const Eigen::Vector3d& pole(int e) const { return data_->poles[e]; }

  // The faces that meet at a vertex, counterclockwise round its region; edge k is between faces k
  // and k + 1.
  std::span<const int> vertex_faces(int v) const {
    return Range(data_->vertex_begin, data_->vertex_faces, v);
  }
  std::span<const int> vertex_edges(int v) const {
    return Range(data_->vertex_begin, data_->vertex_edges, v);
  }
  // A direction within the region, of unit length up to rounding; on its border only where it is
  // thinner than that.
  const Eigen::Vector3d& middle(int v) const { return data_->middles[v]; }

  // The mesh's faces with this normal: none where arcs cross or were cut.
  std::span<const int> faces_at(int face) const {
    return Range(data_->faces_at_begin, data_->faces_at, face);
  }
  // The mesh's edges whose arcs run along the edge: none on a phantom arc.
  std::span<const int> edges_along(int e) const {
    return Range(data_->edges_along_begin, data_->edges_along, e);
  }
  // The mesh's vertices whose cones hold the region; those of kind kCorner.
  std::span<const int> vertices_over(int v) const {
    return Range(data_->vertices_over_begin, data_->vertices_over, v);
  }
  // The map's face along the normal of a face of the mesh; -1 if it has none.
  int face_of_mesh_face(int f) const { return data_->face_of_mesh_face[f]; }

  // The region that `direction` lies in, or on the border of: from region `start`, across edges
  // that it lies beyond by more than `margin` of its length, each of which leads to a vertex that
  // is further along it. `margin` must exceed the rounding of pole . direction.
  int Walk(const Eigen::Vector3d& direction, int start, double margin) const;

  // What went into it.
  struct Counts {
    int arcs = 0, pieces = 0;  // of G(A), long ones in two, before and after the arrangement
    int missing_pieces = 0;    // that are no edge, or chain of edges
    int directions = 0;        // vertices of the arrangement
    int added_directions = 0;  // planes that make it conform
  };
  const Counts& counts() const { return data_->counts; }

 private:
  struct Data {
    std::vector<Eigen::Vector3d> directions;
    std::vector<MapPlane> planes;
    std::vector<MapEdge> edges;
    std::vector<Eigen::Vector3d> poles;
    std::vector<int> vertex_begin, vertex_faces, vertex_edges;
    std::vector<Eigen::Vector3d> middles;
    std::vector<int> faces_at_begin, faces_at;
    std::vector<int> edges_along_begin, edges_along;
    std::vector<int> vertices_over_begin, vertices_over;
    std::vector<int> face_of_mesh_face;
    Counts counts;
  };
  class Assembler;

  static std::span<const int> Range(const std::vector<int>& begin, const std::vector<int>& items,
                                    int i) {
    return {items.data() + begin[i], items.data() + begin[i + 1]};
  }

  std::shared_ptr<const Data> data_;
};

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_MINKOWSKI_CONVEX_MAP_H_
