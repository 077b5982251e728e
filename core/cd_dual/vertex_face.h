// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_CD_DUAL_VERTEX_FACE_H_
#define TOUCHSTONE_CORE_CD_DUAL_VERTEX_FACE_H_

#include "touchstone/core/cd_dual/face_of_m.h"

namespace touchstone {

// The face of M that face `f` of Q spans with the vertex of P that supports P against f's normal.
// `hint` is a vertex of P to climb from, or -1.
FaceOfM VertexFaceFace(const MinkowskiDifference& m, int f, int hint, PhaseCounts* counts);

// SEARCH-VF (section 3.3.2): SEARCH-FV with the roles of P and -Q exchanged. Returns a local
// maximum (Theorem 2 fails with Theorem 1).
FaceOfM SearchVertexFace(const MinkowskiDifference& m, int start, int hint, bool early_exit,
                         SearchLog* log);

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_CD_DUAL_VERTEX_FACE_H_
