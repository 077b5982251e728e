// SPDX-License-Identifier: GPL-3.0-or-later
//
// Check 1: the verdict is the exact verdict.
#include <cmath>

#include "touchstone/exact/judge/checks.h"

namespace touchstone::exact {
namespace {

// A query in floating point alone may leave open what is within this part of the size.
constexpr double kUndecidedGap = 1e-12;

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
  if (gap > kUndecidedGap * context.pair.size()) {
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
