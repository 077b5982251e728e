// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_MINKOWSKI_SUM_FACET_H_
#define TOUCHSTONE_CORE_MINKOWSKI_SUM_FACET_H_

#include <compare>
#include <cstdint>

namespace touchstone {

// The point a - b of M for a vertex of A and one of B.
struct SumVertex {
  int a = -1, b = -1;
  friend auto operator<=>(const SumVertex&, const SumVertex&) = default;
};

enum class SumFacetKind : std::uint8_t { kFaceVertex, kVertexFace, kEdgeEdge };

// A facet of the convolution: a face of A against a vertex of B, a vertex of A against a face of B,
// or an edge of each, by their indices.
struct SumFacet {
  SumFacetKind kind;
  // For kEdgeEdge: whether the outward normal is along (head - tail of A's edge) x (the same of
  // B's), rather than against it, the edges run as their half-edges do.
  bool is_along_cross = false;
  int a = -1, b = -1;
  friend auto operator<=>(const SumFacet&, const SumFacet&) = default;
};

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_MINKOWSKI_SUM_FACET_H_
