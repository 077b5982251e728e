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

// The same for "when do they meet along s?". The facets at both ends and the separator are proofs
// and are checked as such; that the line meets M's shadow, grazes it or misses it, also from
// scratch over all edges (all_faces). Requires an s that DirectionalDistance takes. Complexity: O(m
// + n), with all_faces O((m + n)^2).
std::vector<Finding> JudgeDirection(const ExactBody& p, const ExactBody& q,
                                    const RelativePose& pose, const Eigen::Vector3d& s,
                                    const DirectionalResult& result,
                                    const ProximityJudgeOptions& options = {});

// What is wrong with the paper's own construction, by a judged answer to the same question. A
// travel may be off by 1e-9 of its condition, the construction being in doubles.
std::vector<Finding> JudgePublishedTravel(const PublishedTravel& published,
                                          const DirectionalResult& truth);

}  // namespace touchstone::exact

#endif  // TOUCHSTONE_EXACT_JUDGE_PROXIMITY_H_
