// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_MINKOWSKI_SUM_POINT_NAME_H_
#define TOUCHSTONE_CORE_MINKOWSKI_SUM_POINT_NAME_H_

#include <array>
#include <cstdint>

#include "touchstone/core/minkowski/sum_facet.h"

namespace touchstone {

// What a point of ∂M is, exactly.
enum class SumPointKind : std::uint8_t {
  kVertex,       // a vertex of A less one of B
  kEdgeFacet,    // where an edge of M crosses the plane of a facet
  kEdgeEdge,     // where two edges of coplanar facets cross
  kThreeFacets,  // where the planes of three facets meet
};

struct SumPointName {
  SumPointKind kind = SumPointKind::kVertex;
  // kVertex: one; kEdgeFacet: the edge's two; kEdgeEdge: those of both edges.
  std::array<SumVertex, 4> vertices{};
  // Numbers in the list of facets that the name comes with. kEdgeFacet: one; kEdgeEdge: one that
  // lies in the plane; kThreeFacets: three.
  std::array<int, 3> facets = {-1, -1, -1};
};

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_MINKOWSKI_SUM_POINT_NAME_H_
