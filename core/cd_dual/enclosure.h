// SPDX-License-Identifier: MIT
//
//   here        meaning, P's frame
//   c, o        interior point of M, origin
//   side        of a triangle of M: the plane through c and two of its points
#ifndef TOUCHSTONE_CORE_CD_DUAL_ENCLOSURE_H_
#define TOUCHSTONE_CORE_CD_DUAL_ENCLOSURE_H_

#include <array>
#include <optional>

#include "touchstone/core/cd_dual/signs.h"

namespace touchstone {

// A triangle of M that, with c, encloses o for certain in doubles, though `triangle`, nearly where
// the ray leaves M, has a side too near to the ray to tell. Where that side is a diagonal of a
// facet (four points of parallel edges, a face plus an edge or a face) the facet has other
// triangles around the ray; where it is an edge of M, triangles below the edge serve if o is below
// them, too. The points across the side are supports along the triangle's normal tilted over the
// side, by ever more: from the facet's own points to those far out and deep. Nothing if none of
// them serves: so it is where c and o are in one plane with an edge of M that o is next to, since
// no triangle of M's vertices comes nearer to the edge's middle. Complexity: at most 30 support
// queries and 60 proofs.
std::optional<std::array<VertexPair, 3>> FindClearEnclosure(
    Signs* signs, const std::array<VertexPair, 3>& triangle, PhaseCounts* counts);

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_CD_DUAL_ENCLOSURE_H_
