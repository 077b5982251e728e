// SPDX-License-Identifier: GPL-3.0-or-later
//
// Check 5, the phases: each phase's result is what it claims of its class. (That the final face is
// the maximum over F(M) is check 3's crossing: a facet that the ray crosses is optimal.)
#include <algorithm>
#include <cmath>

#include "touchstone/exact/exit_values.h"
#include "touchstone/exact/judge/checks.h"
#include "touchstone/exact/phase_maxima.h"
#include "touchstone/exact/support.h"

namespace touchstone::exact {
namespace {

constexpr const char* kPhaseNames[] = {"SEARCH-FV", "SEARCH-VF", "SEARCH-EE"};

// The outward normal of the plane that a report's features span; zero when they span none.
IntegerVector NormalOf(const PlacedPair& pair, const PhaseReport& report) {
  if (report.feature_p.kind == FeatureKind::kFace) {
    return FaceVertexNormal(pair, report.feature_p.index);
  }
  if (report.feature_q.kind == FeatureKind::kFace) {
    return VertexFaceNormal(pair, report.feature_q.index);
  }
  if (report.feature_p.kind == FeatureKind::kEdge && report.feature_q.kind == FeatureKind::kEdge) {
    return EdgeEdgeNormal(pair, report.feature_p.index, report.feature_q.index);
  }
  return {};
}

int FirstVertex(const ExactBodyData& body, const Feature& feature) {
  if (feature.kind == FeatureKind::kVertex) return feature.index;
  if (feature.kind == FeatureKind::kEdge) return body.topology().edges[feature.index].tail;
  return body.face(feature.index)[0];
}

bool HoldsAll(const ExactBodyData& body, const Feature& feature,
              const std::vector<int>& supporting) {
  const auto holds = [&](int v) {
    return std::find(supporting.begin(), supporting.end(), v) != supporting.end();
  };
  if (feature.kind == FeatureKind::kFace) {
    for (const int v : body.face(feature.index)) {
      if (!holds(v)) return false;
    }
    return true;
  }
  if (feature.kind == FeatureKind::kEdge && !holds(body.topology().edges[feature.index].head))
    return false;
  return holds(FirstVertex(body, feature));
}

// The exact ratio of the face that a report names, or nothing after adding a finding.
std::optional<Ratio> RatioOfReport(const JudgeContext& context, int phase) {
  const PhaseReport& report = context.result.phases[phase];
  const PlacedPair& pair = context.pair;
  const IntegerVector n = NormalOf(pair, report);
  const std::string name = kPhaseNames[phase];
  if (IsZero(n)) {
    context.Add(FindingKind::kPhaseNotMaximal, name + " names features that span no plane");
    return std::nullopt;
  }
  const SupportingFeatures supporting = Supporting(pair, n);
  if (!HoldsAll(pair.p(), report.feature_p, supporting.p) ||
      !HoldsAll(pair.q(), report.feature_q, supporting.q)) {
    context.Add(FindingKind::kPhaseNotMaximal, name + " names features that form no face of M");
    return std::nullopt;
  }
  const Ratio ratio = RatioOf(pair, n, {supporting.p[0], supporting.q[0]});
  // The report states no error: only a number that is not this face's is a finding.
  const ExitValues values = ValuesAt(pair, n, ratio);
  const double d = values.signed_distance.ToDouble();
  const double length = values.interior_distance.ToDouble();
  const double room = 1e-6 * (std::abs(d) + 1 / length) *
                      (1 + context.pair.size() / values.plane_distance.ToDouble());
  if (!(std::abs(report.signed_distance - d) <= room)) {
    context.Add(FindingKind::kValueOutOfBounds, name + " states another distance than its face's");
  }
  return ratio;
}

std::optional<Ratio> ClassMaximum(const JudgeContext& context, int phase) {
  switch (phase) {
    case 0:
      return FaceVertexMaximum(context.pair);
    case 1:
      return VertexFaceMaximum(context.pair);
    default:
      return EdgeEdgeMaximum(context.pair);
  }
}

// A proven search: what is claimed to be a maximum must be one; an edge pair phase that kept a face
// of another class says that this face is the maximum over all of M.
void CheckClaim(const JudgeContext& context, int phase) {
  const PhaseReport& report = context.result.phases[phase];
  if (report.claim != PhaseClaim::kMaximum) return;
  const std::optional<Ratio> ratio = RatioOfReport(context, phase);
  if (!ratio.has_value()) return;
  const bool own_class = phase != 2 || report.face_class == FaceClass::kEdgeEdge;
  const std::optional<Ratio> most =
      own_class ? ClassMaximum(context, phase) : std::optional<Ratio>(context.ExitRatio());
  if (most.has_value() && Compare(*ratio, *most) < 0) {
    context.Add(FindingKind::kPhaseNotMaximal,
                std::string(kPhaseNames[phase]) + " claims a maximum that is none");
  }
}

// The published search is held to theorems 1, 2 and 6.
void CheckPublished(const JudgeContext& context) {
  std::optional<Ratio> best;
  for (int phase = 0; phase < 3; ++phase) {
    const PhaseReport& report = context.result.phases[phase];
    std::optional<Ratio> ratio;
    if (report.face_class.has_value()) ratio = RatioOfReport(context, phase);
    if (ratio.has_value() && (!best.has_value() || Compare(*ratio, *best) > 0)) best = ratio;
    const std::optional<Ratio> reached = phase == 2 ? best : ratio;
    const Ratio most = phase == 2 ? context.ExitRatio() : *ClassMaximum(context, phase);
    if (!reached.has_value() || Compare(*reached, most) < 0) {
      context.Add(FindingKind::kPhaseNotMaximal,
                  std::string(kPhaseNames[phase]) + " ended below the maximum");
    }
  }
}

}  // namespace

void CheckPhases(const JudgeContext& context) {
  if (context.published()) {
    if (!context.options.early_exit) CheckPublished(context);
    return;
  }
  for (int phase = 0; phase < 3; ++phase) {
    if (context.result.phases[phase].claim == PhaseClaim::kMaximum &&
        !context.result.phases[phase].face_class.has_value()) {
      context.Add(FindingKind::kMissingPart,
                  std::string(kPhaseNames[phase]) + " claims a maximum and names no face");
      continue;
    }
    CheckClaim(context, phase);
  }
}

}  // namespace touchstone::exact
