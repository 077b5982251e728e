// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_PROXIMITY_HEIGHT_BOUND_H_
#define TOUCHSTONE_CORE_PROXIMITY_HEIGHT_BOUND_H_

#include <Eigen/Core>

#include "touchstone/core/cd_dual/minkowski_difference.h"

namespace touchstone {

// A proven upper bound of the height of M along n.
struct HeightBound {
  double height;  // scaled
  bool scanned;   // every vertex was looked at
};

// max over M of n.x is at most the `height` returned, in scaled lengths. n is taken exactly, its
// coordinates at most about one; `support` is the vertex of M proposed as extreme.
//
// First locally: over a corner whose neighbours lie at most eps times their distance further along
// n, the body rises by at most eps times its diameter over the corner's margin
// (ConvexPolyhedron::corner_margin). Where that is more than the rounding of a point, every vertex
// is looked at. So the bound is within a few `coordinate_error` of the truth wherever `support` is
// extreme up to rounding. Complexity: the corners' degrees; O(m + n) where rounding hides a margin.
HeightBound BoundHeight(const MinkowskiDifference& m, const Eigen::Vector3d& n, VertexPair support);

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_PROXIMITY_HEIGHT_BOUND_H_
