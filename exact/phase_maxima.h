// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef TOUCHSTONE_EXACT_PHASE_MAXIMA_H_
#define TOUCHSTONE_EXACT_PHASE_MAXIMA_H_

#include <optional>

#include "touchstone/exact/convert.h"
#include "touchstone/exact/integer.h"

namespace touchstone::exact {

// The largest ratio 1 + d |c| = 1/s over each of the paper's classes of faces of M, exact. As d
// grows with the ratio, these are the maxima that theorems 1, 2 and 6 speak of.
//
// F_fv: every face of P with its supporting vertex of Q-bar, whatever else is parallel to it; F_vf
// likewise; F_ee: the edge pairs whose Gaussian arcs cross properly, none when there are none.
// Found by looking at all faces and edge pairs in doubles, and exactly at those that the bound
// leaves. Require c inside M. Complexity: O(mn).
Ratio FaceVertexMaximum(const PlacedPair& pair);
Ratio VertexFaceMaximum(const PlacedPair& pair);
std::optional<Ratio> EdgeEdgeMaximum(const PlacedPair& pair);

// Section 4.3's test of the arcs of edge e_p of P and e_q of Q-bar, with exact signs.
bool ArcsCross(const PlacedPair& pair, int e_p, int e_q);

// The normal of the plane that two edges span, outward from c; zero if they are parallel.
IntegerVector EdgeEdgeNormal(const PlacedPair& pair, int e_p, int e_q);
// Outward normals, in M's frame, of the faces of M that a face of P or a face of Q spans.
IntegerVector FaceVertexNormal(const PlacedPair& pair, int f_p);
IntegerVector VertexFaceNormal(const PlacedPair& pair, int f_q);

}  // namespace touchstone::exact

#endif  // TOUCHSTONE_EXACT_PHASE_MAXIMA_H_
