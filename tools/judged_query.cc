// SPDX-License-Identifier: MIT
#include "touchstone/tools/judged_query.h"

#include <algorithm>
#include <chrono>
#include <span>
#include <utility>

#include "touchstone/exact/published_twin.h"

namespace touchstone {
namespace {

using Clock = std::chrono::steady_clock;

double NanosecondsSince(Clock::time_point start) {
  return std::chrono::duration<double, std::nano>(Clock::now() - start).count();
}

std::vector<NamedFinding> Named(std::span<const exact::Finding> findings) {
  std::vector<NamedFinding> named;
  for (const exact::Finding& finding : findings) {
    named.push_back({std::string(exact::ToString(finding.kind)), finding.detail});
  }
  return named;
}

bool SharesKind(const std::vector<NamedFinding>& findings, const std::string& kind) {
  return std::any_of(findings.begin(), findings.end(),
                     [&](const auto& finding) { return finding.kind == kind; });
}

// The pose moved by a thousandth of the bodies' size: the frame before.
RelativePose FrameBefore(const PlacedPair& pair) {
  const double size = std::max(pair.p.max_coordinate(), pair.q.max_coordinate());
  const Eigen::Vector3d move = 1e-3 * size * Eigen::Vector3d(1.0, -0.5, 0.25);
  const auto& world = pair.pose.world();
  const auto moved =
      world ? RelativePose::FromWorld(world->first,
                                      {world->second.rotation, world->second.translation + move})
            : RelativePose::Make(pair.pose.rotation(), pair.pose.translation() + move);
  return moved.ok() ? *moved : pair.pose;
}

// With a cache of the frame before, and all that a query may be asked for.
CollideResult AskWarm(const PlacedPair& pair, CollideOptions options) {
  options.common_point = true;
  CollideCache cache;
  Collide(pair.p, pair.q, FrameBefore(pair), options, &cache);
  return Collide(pair.p, pair.q, pair.pose, options, &cache);
}

// The paper's pseudocode from the same c, in exact arithmetic. c = o is outside it.
void JudgePaper(const PlacedPair& pair, const exact::ExactBody& p, const exact::ExactBody& q,
                const CollideOptions& options, bool always, JudgedQuery& query) {
  query.rounding_findings = std::exchange(query.findings, {});
  if (query.result.termination == Termination::kCoincident) return;
  if (!always && query.rounding_findings.empty()) return;
  const exact::TwinOptions twin_options{.early_exit = options.early_exit};
  const exact::TwinResult twin = exact::RunPublishedTwin(p, q, pair.pose, query.result.interior_p,
                                                         query.result.interior_q, twin_options);
  query.findings = Named(exact::JudgeTwin(p, q, pair.pose, twin, twin_options));
  query.twin_ran = true;
  std::erase_if(query.rounding_findings, [&](const NamedFinding& finding) {
    return SharesKind(query.findings, finding.kind);
  });
}

}  // namespace

exact::ExactBody ExactBodies::Get(const ConvexPolyhedron& body) {
  for (const std::optional<exact::ExactBody>& known : recent_) {
    // Copies of a body share its vertices, and the one kept here holds them alive.
    if (known && known->body().vertices().data() == body.vertices().data()) return *known;
  }
  std::optional<exact::ExactBody>& slot = recent_[next_++ % recent_.size()];
  slot.emplace(body);
  return *slot;
}

JudgeDepth DepthForOneQuery(const PlacedPair& pair) {
  constexpr long kConstruct = 4000;
  const long product = static_cast<long>(pair.p.vertex_count()) * pair.q.vertex_count();
  return {.phase_maxima = true, .construct = product <= kConstruct, .twin = true, .warm = true};
}

JudgedQuery Ask(const PlacedPair& pair, const CollideOptions& options) {
  JudgedQuery query;
  const Clock::time_point start = Clock::now();
  query.result = Collide(pair.p, pair.q, pair.pose, options);
  query.search_ns = NanosecondsSince(start);
  return query;
}

JudgedQuery AskAndJudge(const PlacedPair& pair, const CollideOptions& options,
                        const JudgeDepth& depth, ExactBodies& bodies) {
  JudgedQuery query = Ask(pair, options);
  const Clock::time_point start = Clock::now();
  const exact::ExactBody p = bodies.Get(pair.p);
  const exact::ExactBody q = bodies.Get(pair.q);
  exact::JudgeOptions how{.search = options.search,
                          .certainty = options.certainty,
                          .early_exit = options.early_exit,
                          .check_phase_maxima = depth.phase_maxima,
                          .construct = depth.construct};
  query.findings = Named(exact::Judge(p, q, pair.pose, query.result, how));
  if (depth.warm && options.search == Search::kPortal) {
    const CollideResult warm = AskWarm(pair, options);
    how.construct = false;
    for (NamedFinding& finding : Named(exact::Judge(p, q, pair.pose, warm, how))) {
      query.findings.push_back({finding.kind, "warm: " + finding.detail});
    }
  }
  if (options.search == Search::kPublished) {
    JudgePaper(pair, p, q, options, depth.twin, query);
  } else if (pair.expected && query.result.verdict != Verdict::kUndecided &&
             query.result.verdict != *pair.expected) {
    query.findings.push_back(
        {"unexpected_verdict", "the suite is certain of " + std::string(ToString(*pair.expected)) +
                                   ", not " + std::string(ToString(query.result.verdict))});
  }
  query.judge_ns = NanosecondsSince(start);
  return query;
}

}  // namespace touchstone
