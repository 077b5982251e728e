// SPDX-License-Identifier: GPL-3.0-or-later
//
// Check 6: counters, trace, phase, tier and termination agree, and an early exit was entitled to
// exit.
#include "touchstone/exact/judge/checks.h"

namespace touchstone::exact {
namespace {

void CheckCounts(const JudgeContext& context) {
  for (int i = 0; i < kPhaseCount; ++i) {
    const PhaseCounts& counts = context.result.counts[i];
    const std::string name(ToString(static_cast<Phase>(i)));
    if (counts.faces_visited < 0 || counts.support_calls < 0 || counts.climb_steps < 0 ||
        counts.arc_tests < 0) {
      context.Add(FindingKind::kBadCounters, "a negative count in phase " + name);
    }
  }
  if (context.options.search == Search::kPortal) return;  // its reports are not of phases run
  for (int i = 0; i < 3; ++i) {
    const PhaseCounts& counts = context.result.counts[static_cast<int>(Phase::kFaceVertex) + i];
    const PhaseReport& report = context.result.phases[i];
    if (report.claim == PhaseClaim::kNotRun &&
        (counts.faces_visited != 0 || counts.arc_tests != 0)) {
      context.Add(FindingKind::kBadCounters, "a phase that did not run has counts");
    }
    if (report.claim == PhaseClaim::kEmpty && counts.faces_visited != 0) {
      context.Add(FindingKind::kBadCounters, "a phase that met no face has visited some");
    }
  }
}

void CheckReports(const JudgeContext& context) {
  for (const PhaseReport& report : context.result.phases) {
    const bool names = report.claim == PhaseClaim::kLocal || report.claim == PhaseClaim::kMaximum;
    if (names != report.face_class.has_value()) {
      context.Add(FindingKind::kBadCounters, "a phase's claim and face do not go together");
    }
  }
}

void CheckTrace(const JudgeContext& context) {
  const CollideResult& result = context.result;
  if (result.trace.empty()) return;
  std::array<long, kPhaseCount> steps{};
  std::array<std::optional<double>, kPhaseCount> last;
  for (const TraceStep& step : result.trace) {
    const int phase = static_cast<int>(step.phase);
    if (phase < 0 || phase >= kPhaseCount) {
      return context.Add(FindingKind::kBadCounters, "a step of no phase in the trace");
    }
    ++steps[phase];
    if (!step.accepted) continue;
    if (last[phase].has_value() && !(step.signed_distance > *last[phase])) {
      context.Add(FindingKind::kBadCounters,
                  "an accepted step that does not increase the distance");
    }
    last[phase] = step.signed_distance;
  }
  for (int i = 0; i < kPhaseCount; ++i) {
    const auto phase = static_cast<Phase>(i);
    // Portal searches visit triangles, which are not faces: they leave no trace.
    const bool triangles = phase == Phase::kPortal || phase == Phase::kExact;
    if (steps[i] != (triangles ? 0 : result.counts[i].faces_visited)) {
      context.Add(FindingKind::kBadCounters, "faces visited and the trace differ in phase " +
                                                 std::string(ToString(static_cast<Phase>(i))));
    }
  }
}

void CheckPhaseAndTier(const JudgeContext& context) {
  const CollideResult& result = context.result;
  const Search search = context.options.search;
  const bool coincident = result.termination == Termination::kCoincident;
  const bool undecided = result.verdict == Verdict::kUndecided;
  const auto bad = [&](const char* detail) { context.Add(FindingKind::kBadCounters, detail); };
  const bool at_start = result.phase == Phase::kStart && !undecided;
  const bool decided_early =
      result.termination == Termination::kEarlyExit && result.tier == Tier::kBound;
  const bool by_bounds = result.verdict == Verdict::kSeparate && decided_early;
  if (result.phase == Phase::kCache &&
      (search != Search::kPortal ||
       (result.termination == Termination::kEarlyExit && !decided_early))) {
    bad("a cache answers kPortal, and early only in doubles");
  }
  if (at_start ? !(coincident || by_bounds) : coincident) {
    bad("decided before any search, but neither c = o nor do bounds separate; or not, and c = o");
  }
  if (coincident && !IsZero(context.pair.c())) bad("terminated as coincident, but c is not o");
  if (coincident && result.certificate.kind != CertificateKind::kCoincidentInterior) {
    bad("terminated as coincident without the certificate");
  }
  if (undecided != (result.termination == Termination::kUndecided)) {
    bad("verdict and termination: undecided, one without the other");
  }
  if ((result.tier == Tier::kNone) != (undecided || context.published())) {
    bad("a tier is due exactly where a verdict is proven");
  }
  if (result.phase == Phase::kOverlay && search != Search::kPhased) bad("the overlay is kPhased's");
  // kPhased turns to the portal where parallel features leave its phases nothing to move to.
  if (result.phase == Phase::kPortal && search == Search::kPublished)
    bad("kPublished has no portal");
}

void CheckTermination(const JudgeContext& context, bool proven) {
  const CollideResult& result = context.result;
  const JudgeOptions& options = context.options;
  const bool may_stop = options.early_exit || options.certainty == Certainty::kFloat;
  if (result.termination == Termination::kEarlyExit) {
    if (!may_stop) {
      context.Add(FindingKind::kUnentitledExit, "stopped early without leave");
    } else if (!proven && !(context.published() && result.verdict == Verdict::kSeparate)) {
      context.Add(FindingKind::kUnentitledExit, "stopped early without proof");
    }
  }
  const bool complete = result.face.has_value() && result.signed_distance.has_value() &&
                        result.exit_travel.has_value() && result.exit_point.has_value();
  // Under early exit the caller asked for no more than the verdict, even where the search ran to
  // the end.
  if (result.termination == Termination::kOptimal && !complete && !may_stop) {
    context.Add(FindingKind::kMissingPart,
                "the search ended, but face, d, g or exit point is absent");
  }
  if (result.termination == Termination::kCoincident && !may_stop) {
    context.Add(FindingKind::kMissingPart,
                "c = o, but the exit face was asked for: another c was due");
  }
}

}  // namespace

void CheckCounters(const JudgeContext& context, bool proven) {
  CheckCounts(context);
  CheckReports(context);
  CheckTrace(context);
  CheckPhaseAndTier(context);
  CheckTermination(context, proven);
}

}  // namespace touchstone::exact
