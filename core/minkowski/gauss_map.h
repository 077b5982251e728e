// SPDX-License-Identifier: MIT
//
//   paper   here            meaning
//   G(f)    face_normal     a point of the unit sphere
//   G(e)    Arc             the great arc between the normals of the edge's faces: shorter than π
//                           where the edge is convex, longer where it is reflex
//   G(v)    VertexCone      of a vertex, here only the directions along which it is locally
//   extreme:
//                           all of G(v) where the body is convex
#ifndef TOUCHSTONE_CORE_MINKOWSKI_GAUSS_MAP_H_
#define TOUCHSTONE_CORE_MINKOWSKI_GAUSS_MAP_H_

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "touchstone/core/mesh/triangle_mesh.h"

namespace touchstone {

// How a vertex can be in contact, by the directions n with n.(w - v) <= 0 for all neighbours w.
enum class VertexKind : std::uint8_t {
  kNever,    // there are none, or the solid lies on their far side: the apex of a dent
  kCorner,   // they are a cone with an inside, and the solid lies below
  kWithin,   // within a flat facet or a straight edge: stands for nothing that these do not
  kSpecial,  // they are a cone without an inside: only exact signs tell, by all neighbours
};

// Directions within `cosine` of an axis; cosine -1: all.
struct NormalCone {
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  double cosine = -1.0;
};

// A great arc of G: of edge `edge`, from `tail` to `head`, unit vectors rounded. A reflex edge has
// two, split at the middle.
struct Arc {
  int edge;
  Eigen::Vector3d tail, head;
};

// What a mesh contributes to convolutions, whatever its pose. Immutable; a copy is cheap.
//
// Complexity of making it: O(sum over vertices of d h) for d neighbours of which h are extreme.
class GaussMap {
 public:
  explicit GaussMap(const TriangleMesh& mesh);

  VertexKind vertex_kind(int v) const { return data_->vertex_kinds[v]; }
  // The neighbours that bound the cone of a kCorner: v is extreme along n iff n.(w - v) <= 0 for
  // these.
  std::span<const int> essential_neighbors(int v) const {
    return {data_->neighbors.data() + data_->neighbor_begin[v],
            data_->neighbors.data() + data_->neighbor_begin[v + 1]};
  }
  // Directions that span the cone of a kCorner, or hold that of a kSpecial between them: unit
  // vectors within 2^-40 of the exact ones.
  std::span<const Eigen::Vector3d> rays(int v) const {
    return {data_->rays.data() + data_->ray_begin[v], data_->rays.data() + data_->ray_begin[v + 1]};
  }
  // A bound on the cone of a vertex that is kCorner or kSpecial, or on a convex edge's arc. Others
  // have none that means anything.
  const NormalCone& vertex_cone(int v) const { return data_->vertex_cones[v]; }
  const NormalCone& edge_cone(int e) const { return data_->edge_cones[e]; }

  // The arcs of all edges that are not flat.
  std::span<const Arc> arcs() const { return data_->arcs; }

 private:
  struct Data {
    std::vector<VertexKind> vertex_kinds;
    std::vector<int> neighbor_begin, neighbors, ray_begin;
    std::vector<Eigen::Vector3d> rays;
    std::vector<NormalCone> vertex_cones, edge_cones;
    std::vector<Arc> arcs;
  };
  class Builder;

  std::shared_ptr<const Data> data_;
};

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_MINKOWSKI_GAUSS_MAP_H_
