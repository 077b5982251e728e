// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef TOUCHSTONE_EXACT_SUPPORT_H_
#define TOUCHSTONE_EXACT_SUPPORT_H_

#include <optional>
#include <vector>

#include "touchstone/core/cd_dual/result.h"
#include "touchstone/exact/convert.h"

namespace touchstone::exact {

// Sets `extreme` to all vertices of the body that maximise n.x, in increasing order, exactly: a
// scan in doubles keeps those within the error bound of the largest value, exact signs do the rest.
// n is in the body's own frame. Complexity: O(n).
void ExtremeVertices(const ExactBodyData& body, const IntegerVector& n, std::vector<int>* extreme);
// The one of smallest index.
int ExtremeVertex(const ExactBodyData& body, const IntegerVector& n);

// The vertices of P and of Q whose differences maximise n.x over M.
struct SupportingFeatures {
  std::vector<int> p, q;
};
SupportingFeatures Supporting(const PlacedPair& pair, const IntegerVector& n);
VertexPair SupportingPair(const PlacedPair& pair, const IntegerVector& n);

// 0, 1 or 2: the dimension of the hull of these vertices, which lie in one plane.
int Dimension(const ExactBodyData& body, const std::vector<int>& vertices);

// The class of the facet with these supporting features; nothing when they span no plane.
std::optional<FaceClass> ClassOf(const PlacedPair& pair, const SupportingFeatures& features);

// 1 + d |c| = 1/s for the supporting plane of M with normal n: n.v / (h(n) - n.c). Requires c
// interior.
Ratio RatioOf(const PlacedPair& pair, const IntegerVector& n, const VertexPair& supporting);
Ratio RatioOf(const PlacedPair& pair, const IntegerVector& n);

}  // namespace touchstone::exact

#endif  // TOUCHSTONE_EXACT_SUPPORT_H_
