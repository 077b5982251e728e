// SPDX-License-Identifier: GPL-3.0-or-later
//
// Check 1: the verdict is the exact verdict.
#include <cmath>

#include "touchstone/exact/judge/checks.h"
#include "touchstone/exact/support.h"

namespace touchstone::exact {
namespace {

// A query in floating point alone may leave open what is within this part of the size from contact,
// and overlaps where all rays pass an edge of M as near as that (core/cd_dual/README.md).
constexpr double kUndecidedGap = 1e-12;

// Whether the ray meets the boundary of the exit facet, an edge of M, to within that part of the
// size, or a corner of the triangle named. Nothing that doubles know of the facet's points then
// tells on which side the ray leaves.
bool LeavesByAnEdge(const PlacedPair& pair, const ExactExit& exit) {
  std::array<IntegerVector, 3> a;
  for (int i = 0; i < 3; ++i) a[i] = pair.FromC(exit.triangle[i]);
  const IntegerVector n = Cross(a[1] - a[0], a[2] - a[0]);
  const SupportingFeatures supporting = Supporting(pair, n);
  int near = 0;
  bool border = false;
  for (int i = 0; i < 3; ++i) {
    // The plane through c and the side: 0 or more on the triangle's side.
    const IntegerVector m = Cross(a[i], a[(i + 1) % 3]);
    const Real at_exit = Real(Dot(m, pair.v())) * Real(exit.parameter.get_d());
    const Real distance = pair.ToLength(at_exit / Sqrt(Real(Dot(m, m))));
    if (distance > Real(kUndecidedGap * pair.size())) continue;
    ++near;
    bool all_inside = true;
    for (const int p : supporting.p) {
      for (const int q : supporting.q) all_inside &= DotSign(m, pair.FromC({p, q})) >= 0;
    }
    border |= all_inside;
  }
  return border || near >= 2;
}

// Each c of the four, so that no other would have served.
bool EveryRayMeetsAnEdge(const JudgeContext& context) {
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) {
      const ExactDecision decision = context.DecisionFrom(i, j);
      if (decision.interior_distance <= kUndecidedGap * context.pair.size()) continue;
      if (!LeavesByAnEdge(context.PairFrom(i, j), *decision.exit)) return false;
    }
  }
  return true;
}

std::string Name(Verdict verdict) { return std::string(ToString(verdict)); }

void CheckUndecided(const JudgeContext& context) {
  if (context.options.certainty == Certainty::kExact) {
    context.Add(FindingKind::kUndecided, "undecided, though exact certainty was asked for");
    return;
  }
  if (!context.Decision().exit.has_value()) {
    context.Add(FindingKind::kUndecided, "undecided, though c = o");
    return;
  }
  // The distance from o to the plane of the exit face: where P and Q are separate, their distance
  // is at least that; where they overlap, it bounds the depth from above.
  const ExactExit& exit = *context.Decision().exit;
  const double gap = std::abs(exit.exit_travel) * exit.normal_cosine;
  if (gap <= kUndecidedGap * context.pair.size()) return;
  const bool overlap = context.Decision().verdict == Verdict::kOverlap;
  if (!overlap || !EveryRayMeetsAnEdge(context)) {
    context.Add(
        FindingKind::kUndecided,
        "undecided at " + std::to_string(gap / context.pair.size()) + " of the size from contact");
  }
}

}  // namespace

void CheckVerdict(const JudgeContext& context, bool proven) {
  const Verdict verdict = context.result.verdict;
  if (verdict == Verdict::kUndecided) return CheckUndecided(context);
  if (proven) return;
  const Verdict truth = context.Decision().verdict;
  if (verdict == truth) return;
  // The paper's "overlap": they share a point.
  if (context.published() && verdict == Verdict::kOverlap && truth == Verdict::kTouch) return;
  context.Add(FindingKind::kWrongVerdict, "says " + Name(verdict) + ", is " + Name(truth));
}

}  // namespace touchstone::exact
