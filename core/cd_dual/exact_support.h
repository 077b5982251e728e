// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_CD_DUAL_EXACT_SUPPORT_H_
#define TOUCHSTONE_CORE_CD_DUAL_EXACT_SUPPORT_H_

#include <Eigen/Core>

#include "touchstone/core/cd_dual/signs.h"

namespace touchstone {

// n over a power of two, each coordinate rounded once to nearest: the largest in [1/2, 1), or zero
// for zero.
Eigen::Vector3d ToDirection(const DyadicVector& n);

// A vertex of M that is extreme along n (P's frame; any length but zero), by exact signs: a climb
// in doubles, finished over the corners' edges with a filter that exact signs back, so that no
// vertex of M lies further along n. Both vertices are corners. `big` must be of `m`. Complexity: as
// SupportVertex, and a corner's degree of signs.
VertexPair ExactSupport(const ExactDifference& big, const MinkowskiDifference& m,
                        const DyadicVector& n, PhaseCounts* counts);

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_CD_DUAL_EXACT_SUPPORT_H_
