// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_CD_DUAL_MEASURE_H_
#define TOUCHSTONE_CORE_CD_DUAL_MEASURE_H_

#include "touchstone/core/cd_dual/result.h"
#include "touchstone/core/cd_dual/signs.h"

namespace touchstone {

// Fills d, g and the exit point of `result` for the plane through `triangle`, with error bounds.
//
// With K = det[v1 v2 v3], D = det[a1 a2 a3] (ai = vi - c) and E = D - K = n.(o - c):
//   exit point = -(K / E) c,   g = -(K / E) |c|,   d = -(K / D) / |c|.
// Evaluated in doubles where the forward bound keeps to 1e-12 of the condition number; by big
// numbers otherwise, and then good to a few units in the last place. Zero is exact.
void MeasureExit(Signs* signs, const std::array<VertexPair, 3>& triangle, CollideResult* result);

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_CD_DUAL_MEASURE_H_
