// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/convolution.h"

#include <algorithm>
#include <utility>

#include "touchstone/core/minkowski/cone_tree.h"
#include "touchstone/core/minkowski/support_signs_internal.h"

namespace touchstone {
namespace {

using internal::Other;
using internal::Side;
using internal::SupportSigns;

SumFacet FaceVertexFacet(Side side, int face, int vertex) {
  if (side == Side::kA) return {SumFacetKind::kFaceVertex, false, face, vertex};
  return {SumFacetKind::kVertexFace, false, vertex, face};
}

class Gatherer {
 public:
  Gatherer(const MeshPair& pair, const GaussMap& a, const GaussMap& b)
      : pair_(pair), maps_{&a, &b}, signs_(pair, a, b) {}

  Convolution ByBruteForce() {
    for (const Side side : {Side::kA, Side::kB}) {
      for (int f = 0; f < mesh(side).face_count(); ++f) {
        for (int v = 0; v < mesh(Other(side)).vertex_count(); ++v) TryFaceVertex(side, f, v);
      }
    }
    for (int e = 0; e < mesh(Side::kA).edge_count(); ++e) {
      for (int g = 0; g < mesh(Side::kB).edge_count(); ++g) TryEdgeEdge(e, g);
    }
    return Result();
  }

  Convolution ByTrees() {
    // Everything as seen from A, with B's normals reversed: a face's normal must lie in the cone of
    // a vertex, an arc must meet an arc.
    const Eigen::Matrix3d turn = -pair_.pose().rotation();
    const ConeTree vertices_of_a = VertexTree(Side::kA), edges_of_a = EdgeTree(Side::kA);
    const ConeTree vertices_of_b = VertexTree(Side::kB).Turned(turn);
    const ConeTree edges_of_b = EdgeTree(Side::kB).Turned(turn);
    std::vector<int> vertices;
    for (int f = 0; f < mesh(Side::kA).face_count(); ++f) {
      vertices.clear();
      vertices_of_b.Along(mesh(Side::kA).face_normal(f), &vertices);
      for (const int v : vertices) TryFaceVertex(Side::kA, f, v);
    }
    for (int f = 0; f < mesh(Side::kB).face_count(); ++f) {
      vertices.clear();
      vertices_of_a.Along(turn * mesh(Side::kB).face_normal(f), &vertices);
      for (const int v : vertices) TryFaceVertex(Side::kB, f, v);
    }
    std::vector<std::pair<int, int>> edges;
    edges_of_a.Pairs(edges_of_b, &edges);
    for (const auto& [e, g] : edges) TryEdgeEdge(e, g);
    return Result();
  }

 private:
  const TriangleMesh& mesh(Side side) const {
    return side == Side::kA ? pair_.a().mesh : pair_.b().mesh;
  }
  const GaussMap& map(Side side) const { return *maps_[side == Side::kA ? 0 : 1]; }

  ConeTree VertexTree(Side side) const {
    std::vector<NormalCone> cones;
    std::vector<int> items;
    for (int v = 0; v < mesh(side).vertex_count(); ++v) {
      cones.push_back(map(side).vertex_cone(v));
      const VertexKind kind = map(side).vertex_kind(v);
      if (kind == VertexKind::kCorner || kind == VertexKind::kSpecial) items.push_back(v);
    }
    return ConeTree(cones, std::move(items));
  }

  ConeTree EdgeTree(Side side) const {
    std::vector<NormalCone> cones;
    std::vector<int> items;
    for (int e = 0; e < mesh(side).edge_count(); ++e) {
      cones.push_back(map(side).edge_cone(e));
      if (mesh(side).edge_kind(e) == EdgeKind::kConvex) items.push_back(e);
    }
    return ConeTree(cones, std::move(items));
  }

  void TryFaceVertex(Side side, int face, int vertex) {
    if (signs_.FaceVertex(side, face, vertex)) {
      facets_.push_back(FaceVertexFacet(side, face, vertex));
    }
  }

  void TryEdgeEdge(int edge_a, int edge_b) {
    if (mesh(Side::kA).edge_kind(edge_a) != EdgeKind::kConvex ||
        mesh(Side::kB).edge_kind(edge_b) != EdgeKind::kConvex) {
      return;
    }
    if (const auto facet = signs_.EdgeEdge(edge_a, edge_b)) facets_.push_back(*facet);
  }

  Convolution Result() {
    std::sort(facets_.begin(), facets_.end());
    return {std::move(facets_), signs_.exact_count()};
  }

  const MeshPair& pair_;
  const GaussMap* maps_[2];
  SupportSigns signs_;
  std::vector<SumFacet> facets_;
};

}  // namespace

SumCorners CornersOf(const MeshPair& pair, const SumFacet& facet) {
  const TriangleMesh &a = pair.a().mesh, &b = pair.b().mesh;
  switch (facet.kind) {
    case SumFacetKind::kFaceVertex: {
      const Triangle& f = a.face(facet.a);
      return {{SumVertex{f[0], facet.b}, {f[1], facet.b}, {f[2], facet.b}, {}}, 3};
    }
    case SumFacetKind::kVertexFace: {
      // Reflected points run the same way round, but the outside is the other side.
      const Triangle& f = b.face(facet.b);
      return {{SumVertex{facet.a, f[0]}, {facet.a, f[2]}, {facet.a, f[1]}, {}}, 3};
    }
    case SumFacetKind::kEdgeEdge:
      break;
  }
  const int ha = a.half_edge_of(facet.a), hb = b.half_edge_of(facet.b);
  const int a0 = a.tail(ha), a1 = a.head(ha), b0 = b.tail(hb), b1 = b.head(hb);
  // Along A's edge, then along minus B's: the normal is against the cross product.
  if (facet.is_along_cross) return {{SumVertex{a0, b0}, {a0, b1}, {a1, b1}, {a1, b0}}, 4};
  return {{SumVertex{a0, b0}, {a1, b0}, {a1, b1}, {a0, b1}}, 4};
}

Convolution ConvolutionByBruteForce(const MeshPair& pair, const GaussMap& a, const GaussMap& b) {
  return Gatherer(pair, a, b).ByBruteForce();
}

Convolution ReducedConvolution(const MeshPair& pair, const GaussMap& a, const GaussMap& b) {
  return Gatherer(pair, a, b).ByTrees();
}

}  // namespace touchstone
