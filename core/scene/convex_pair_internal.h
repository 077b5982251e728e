// SPDX-License-Identifier: MIT
//
// Two placed convex parts: verdicts with a margin, which is how far the bodies' points may move,
// both bodies together, before the verdict could change.
//
//   P, Q, M, c, o, n    as in cd_dual/result.h, but in the world's frame and lengths: M = P - Q of
//                       the exact images under the world poses
//   margin              separate: M is at least so far from o. Overlap: M holds the ball of this
//                       radius around o. Either way it survives while no a - b moves that far: if a
//                       point of P moves by at most s and one of Q by at most t, every point of M
//                       moves by at most s + t, so its support function falls or rises no further.
#ifndef TOUCHSTONE_CORE_SCENE_CONVEX_PAIR_INTERNAL_H_
#define TOUCHSTONE_CORE_SCENE_CONVEX_PAIR_INTERNAL_H_

#include <Eigen/Core>

#include "touchstone/core/base/relative_pose.h"
#include "touchstone/core/scene/options.h"
#include "touchstone/core/scene/pair_table_internal.h"
#include "touchstone/core/scene/shape.h"

namespace touchstone::internal {

// A part where it is.
struct PlacedPart {
  const ScenePart* part;
  const WorldPose* pose;
  Eigen::Vector3d turned_middle;  // R middle, each coordinate off by 8 units of max_coordinate
};

PlacedPart Place(const ScenePart& part, const WorldPose& pose);

// A verdict that is proven, or kUndecided; and its margin, zero where none is known.
struct Margin {
  Verdict verdict = Verdict::kUndecided;
  double value = 0.0;
};

// By the balls around and in the parts; any parts. Complexity: O(1).
Margin MarginByBalls(const PlacedPart& p, const PlacedPart& q);

// By the direction that separated last. The corners are brought up to date. Complexity: a short
// climb on each body; O(n) where the direction is level with a neighbour of a corner.
Margin MarginByDirection(const PlacedPart& p, const PlacedPart& q, PairState* state);

// By the tetrahedron of c and the triangle that enclosed o last. Complexity: O(1).
Margin MarginBySimplex(const PlacedPart& p, const PlacedPart& q, const PairState& state);

// The verdict of two convex parts with a margin, by what the rules allow, the cheapest first.
// Always decided. The state's guesses are renewed. A margin below `enough` is worth some effort to
// find a better one. Requires poses that CheckWorldPose takes.
Margin DecideConvex(const PlacedPart& p, const PlacedPart& q, const SceneRules& rules,
                    double enough, PairState* state, SceneCounters* counters);

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_SCENE_CONVEX_PAIR_INTERNAL_H_
