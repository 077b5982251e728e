// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef TOUCHSTONE_EXACT_JUDGE_PROXIMITY_H_
#define TOUCHSTONE_EXACT_JUDGE_PROXIMITY_H_

#include <vector>

#include "touchstone/core/base/relative_pose.h"
#include "touchstone/core/proximity/result.h"
#include "touchstone/exact/exact_body.h"
#include "touchstone/exact/judge.h"

namespace touchstone::exact {

// How the result was asked for, and how far to look.
struct ProximityJudgeOptions {
  Certainty certainty = Certainty::kExact;
  // Also search all faces of M: O(mn). Depth: no facet is nearer than the one named. Travels: the
  // interval is what all facets leave of the line.
  bool all_faces = true;
  // Also build M whole, by exact hull, and compare: for small bodies.
  bool construct = false;
};

// Everything that is wrong with `result` as the answer to "how far apart are P and Q?", Q placed by
// `pose`; empty when it stands. The verdict is held against Decide, optimality against the
// condition of Karush, Kuhn and Tucker for the simplex named, and where that fails, the nearest
// point is found from scratch. How tight claims must be: judge/proximity_checks.h. Complexity: O(m
// + n).
std::vector<Finding> JudgeDistance(const ExactBody& p, const ExactBody& q, const RelativePose& pose,
                                   const DistanceResult& result,
                                   const ProximityJudgeOptions& options = {});

// The same for "how deep?". The facet is checked as it stands, the ball of radius `lower` by the
// inner polytope where there is one, and that no facet is nearer by looking at all of them.
// Complexity: O(m + n), with all_faces O(mn).
std::vector<Finding> JudgePenetration(const ExactBody& p, const ExactBody& q,
                                      const RelativePose& pose, const PenetrationResult& result,
                                      const ProximityJudgeOptions& options = {});

}  // namespace touchstone::exact

#endif  // TOUCHSTONE_EXACT_JUDGE_PROXIMITY_H_
