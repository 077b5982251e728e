// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/facet_order_internal.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace touchstone::internal {
namespace {

constexpr int kBits = 20;

// The lowest 20 bits, each followed by two zeros.
std::uint64_t Spread(std::uint64_t bits) {
  bits = (bits | bits << 32) & 0x1f00000000ffff;
  bits = (bits | bits << 16) & 0x1f0000ff0000ff;
  bits = (bits | bits << 8) & 0x100f00f00f00f00f;
  bits = (bits | bits << 4) & 0x10c30c30c30c30c3;
  return (bits | bits << 2) & 0x1249249249249249;
}

// Of a point whose coordinates are at most one in magnitude.
std::uint64_t KeyOf(const Eigen::Vector3d& x) {
  std::uint64_t key = 0;
  for (int k = 0; k < 3; ++k) {
    const double unit = std::clamp(0.5 * (x[k] + 1.0), 0.0, 1.0);
    key |= Spread(static_cast<std::uint64_t>(unit * ((1 << kBits) - 1))) << k;
  }
  return key;
}

int CornerOf(const TriangleMesh& mesh, bool is_face, bool is_edge, int feature) {
  if (is_face) return mesh.face(feature)[0];
  return is_edge ? mesh.tail(mesh.half_edge_of(feature)) : feature;
}

// The vertices times a matrix, and the largest of their coordinates.
struct Turned {
  Turned(const TriangleMesh& mesh, const Eigen::Matrix3d& rotation) {
    points.reserve(static_cast<std::size_t>(mesh.vertex_count()));
    for (int v = 0; v < mesh.vertex_count(); ++v) {
      points.push_back(rotation * mesh.vertex(v));
      extent = std::max(extent, points.back().cwiseAbs().maxCoeff());
    }
  }
  std::vector<Eigen::Vector3d> points;
  double extent = 0.0;
};

}  // namespace

std::vector<int> AlongCurve(const MeshPair& pair, std::span<const SumFacet> facets) {
  const Turned a(pair.a().mesh, Eigen::Matrix3d::Identity());
  const Turned b(pair.b().mesh, pair.pose().rotation());
  const double extent = a.extent + b.extent;
  std::vector<std::pair<std::uint64_t, int>> keys;
  keys.reserve(facets.size());
  for (const SumFacet& facet : facets) {
    const bool has_edges = facet.kind == SumFacetKind::kEdgeEdge;
    const int u =
        CornerOf(pair.a().mesh, facet.kind == SumFacetKind::kFaceVertex, has_edges, facet.a);
    const int v =
        CornerOf(pair.b().mesh, facet.kind == SumFacetKind::kVertexFace, has_edges, facet.b);
    keys.emplace_back(KeyOf((a.points[u] - b.points[v]) / extent), static_cast<int>(keys.size()));
  }
  std::sort(keys.begin(), keys.end());
  std::vector<int> order;
  order.reserve(keys.size());
  for (const auto& [key, number] : keys) order.push_back(number);
  return order;
}

}  // namespace touchstone::internal
