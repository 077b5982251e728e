// SPDX-License-Identifier: MIT
#include "touchstone/tools/judged_proximity.h"

#include <chrono>
#include <string>

namespace touchstone {
namespace {

using Clock = std::chrono::steady_clock;

double NanosecondsSince(Clock::time_point start) {
  return std::chrono::duration<double, std::nano>(Clock::now() - start).count();
}

std::vector<NamedFinding> Named(const std::vector<exact::Finding>& findings) {
  std::vector<NamedFinding> named;
  for (const exact::Finding& finding : findings)
    named.push_back({std::string(exact::ToString(finding.kind)), finding.detail});
  return named;
}

// Asks, judges where wanted, and times both.
template <class Result, class Query, class Judge>
Judged<Result> AskAndJudge(const ProximityDepth& depth, const Query& query, const Judge& judge) {
  Judged<Result> judged;
  Clock::time_point start = Clock::now();
  judged.result = query();
  judged.query_ns = NanosecondsSince(start);
  if (!depth) return judged;
  start = Clock::now();
  judged.findings = Named(judge(judged.result));
  judged.judge_ns = NanosecondsSince(start);
  return judged;
}

}  // namespace

exact::ProximityJudgeOptions ProximityDepthForOneQuery(const PlacedPair& pair,
                                                       Certainty certainty) {
  constexpr long kConstruct = 4000;
  const long product = static_cast<long>(pair.p.vertex_count()) * pair.q.vertex_count();
  return {.certainty = certainty, .all_faces = true, .construct = product <= kConstruct};
}

Judged<DistanceResult> AskDistance(const PlacedPair& pair, Certainty certainty,
                                   const ProximityDepth& depth, ExactBodies& bodies,
                                   DistanceCache* cache) {
  return AskAndJudge<DistanceResult>(
      depth, [&] { return Distance(pair.p, pair.q, pair.pose, {certainty}, cache); },
      [&](const DistanceResult& result) {
        return exact::JudgeDistance(bodies.Get(pair.p), bodies.Get(pair.q), pair.pose, result,
                                    *depth);
      });
}

Judged<PenetrationResult> AskPenetration(const PlacedPair& pair, const PenetrationOptions& options,
                                         const ProximityDepth& depth, ExactBodies& bodies,
                                         PenetrationCache* cache) {
  return AskAndJudge<PenetrationResult>(
      depth, [&] { return PenetrationDepth(pair.p, pair.q, pair.pose, options, cache); },
      [&](const PenetrationResult& result) {
        return exact::JudgePenetration(bodies.Get(pair.p), bodies.Get(pair.q), pair.pose, result,
                                       *depth);
      });
}

Judged<DirectionalResult> AskDirection(const PlacedPair& pair, const Eigen::Vector3d& s,
                                       Certainty certainty, const ProximityDepth& depth,
                                       ExactBodies& bodies) {
  return AskAndJudge<DirectionalResult>(
      depth, [&] { return *DirectionalDistance(pair.p, pair.q, pair.pose, s, {certainty}); },
      [&](const DirectionalResult& result) {
        return exact::JudgeDirection(bodies.Get(pair.p), bodies.Get(pair.q), pair.pose, s, result,
                                     *depth);
      });
}

Judged<PublishedTravel> AskPublishedDirection(const PlacedPair& pair, const Eigen::Vector3d& s,
                                              const DirectionalResult& truth) {
  return AskAndJudge<PublishedTravel>(
      exact::ProximityJudgeOptions{},
      [&] { return *DirectionalDistanceAsPublished(pair.p, pair.q, pair.pose, s); },
      [&](const PublishedTravel& result) { return exact::JudgePublishedTravel(result, truth); });
}

}  // namespace touchstone
