// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_CD_DUAL_EDGE_EDGE_H_
#define TOUCHSTONE_CORE_CD_DUAL_EDGE_EDGE_H_

#include <optional>

#include "touchstone/core/cd_dual/face_of_m.h"

namespace touchstone {

// The face of M that edges `e_p` and `e_q` span, if the arcs of their Gaussian images cross (the
// arc test of section 4.3, with its strict inequalities: arcs that only touch do not count).
std::optional<FaceOfM> EdgeEdgeFace(const MinkowskiDifference& m, int e_p, int e_q,
                                    PhaseCounts* counts);

// SEARCH-EE (section 3.3.3): from the best face so far, through the edge pairs that its features
// have, then the pairs that share one edge with the last improvement, on a stack. Returns the best
// face met, `start` if none is better; `*best_of_class` gets the best face of class EdgeEdge.
//
// Pairs are pushed with P's edge outermost: a face's edges in the order of its loop, a vertex's
// edges by increasing number; after an improvement <e_p, e_q> first <e_p, .> over the edges at the
// tail and then at the head of e_q, then <., e_q> likewise. Terminates: pairs are pushed only when
// the distance strictly increases, over finitely many pairs.
FaceOfM SearchEdgeEdge(const MinkowskiDifference& m, const FaceOfM& start, bool early_exit,
                       SearchLog* log, std::optional<FaceOfM>* best_of_class);

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_CD_DUAL_EDGE_EDGE_H_
