// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_CD_DUAL_FACE_VERTEX_H_
#define TOUCHSTONE_CORE_CD_DUAL_FACE_VERTEX_H_

#include "touchstone/core/cd_dual/face_of_m.h"

namespace touchstone {

// SIGNEDDISTANCE-FV: the face of M that face `f` of P spans with the vertex of Q that supports Q
// against f's normal. `hint` is a vertex of Q to climb from, or -1.
FaceOfM FaceVertexFace(const MinkowskiDifference& m, int f, int hint, PhaseCounts* counts);

// SEARCH-FV (section 3.3.1): steepest ascent of the signed distance over P's face adjacency, from
// `start`. Returns a local maximum; the paper's Theorem 1 calls it the maximum of F_fv, which fails
// (README.md). With `early_exit`, returns as soon as a signed distance is positive, as printed.
// Terminates: the distance strictly increases over finitely many faces.
FaceOfM SearchFaceVertex(const MinkowskiDifference& m, int start, int hint, bool early_exit,
                         SearchLog* log);

// The face of P whose unit normal makes the least angle with the ray from c to o: the paper's first
// face (section 4.2). Ties go to the smaller index. O(F).
int HeuristicFirstFace(const MinkowskiDifference& m);

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_CD_DUAL_FACE_VERTEX_H_
