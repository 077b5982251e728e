// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_JUDGED_PROXIMITY_H_
#define TOUCHSTONE_TOOLS_JUDGED_PROXIMITY_H_

#include <optional>
#include <vector>

#include "touchstone/core/proximity/directional_distance.h"
#include "touchstone/core/proximity/distance.h"
#include "touchstone/core/proximity/penetration_depth.h"
#include "touchstone/exact/judge_proximity.h"
#include "touchstone/tools/judged_query.h"
#include "touchstone/tools/suites/suite.h"

namespace touchstone {

// One proximity query, asked of the core and, where wanted, judged by the exact half.
template <class Result>
struct Judged {
  Result result;
  double query_ns = 0.0;
  double judge_ns = 0.0;
  std::vector<NamedFinding> findings;
};

// How far to look; nothing: not at all.
using ProximityDepth = std::optional<exact::ProximityJudgeOptions>;

// Everything, and M built whole where one can wait for it: a product of vertex counts up to 4000.
exact::ProximityJudgeOptions ProximityDepthForOneQuery(const PlacedPair& pair, Certainty certainty);

Judged<DistanceResult> AskDistance(const PlacedPair& pair, Certainty certainty,
                                   const ProximityDepth& depth, ExactBodies& bodies,
                                   DistanceCache* cache = nullptr);
Judged<PenetrationResult> AskPenetration(const PlacedPair& pair, const PenetrationOptions& options,
                                         const ProximityDepth& depth, ExactBodies& bodies,
                                         PenetrationCache* cache = nullptr);
// `s` must be one that DirectionalDistance takes.
Judged<DirectionalResult> AskDirection(const PlacedPair& pair, const Eigen::Vector3d& s,
                                       Certainty certainty, const ProximityDepth& depth,
                                       ExactBodies& bodies);
// Held against `truth`, a judged answer to the same question.
Judged<PublishedTravel> AskPublishedDirection(const PlacedPair& pair, const Eigen::Vector3d& s,
                                              const DirectionalResult& truth);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_JUDGED_PROXIMITY_H_
