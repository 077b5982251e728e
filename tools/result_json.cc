// SPDX-License-Identifier: MIT
#include "touchstone/tools/result_json.h"

#include <ostream>

#include "touchstone/tools/numbers.h"

namespace touchstone {

Json ToJson(const Eigen::Vector3d& v) { return {v[0], v[1], v[2]}; }

Json ToJson(const Feature& feature) {
  return {{"kind", ToString(feature.kind)}, {"index", feature.index}};
}

Json ToJson(const BoundedValue& value) {
  return {{"value", value.value}, {"error", value.error}, {"condition", value.condition}};
}

Json ToJson(const std::array<VertexPair, 3>& pairs) {
  Json json = Json::array();
  for (const VertexPair& pair : pairs) json.push_back({pair.p, pair.q});
  return json;
}

Json ToJson(const Certificate& certificate) {
  Json json = {{"kind", ToString(certificate.kind)}};
  switch (certificate.kind) {
    case CertificateKind::kSeparatingDirection:
      json["direction"] = ToJson(certificate.direction);
      break;
    case CertificateKind::kSeparatingFacet:
    case CertificateKind::kEnclosingTetrahedron:
    case CertificateKind::kTouchingFacet:
      json["points"] = ToJson(certificate.points);
      break;
    case CertificateKind::kNone:
    case CertificateKind::kCoincidentInterior:
      break;
  }
  return json;
}

std::string Text(const Feature& feature) {
  return std::string(ToString(feature.kind)) + " " + std::to_string(feature.index);
}

std::string Text(const Eigen::Vector3d& v) {
  return "(" + ShortDouble(v[0]) + ", " + ShortDouble(v[1]) + ", " + ShortDouble(v[2]) + ")";
}

std::string Text(const std::array<VertexPair, 3>& pairs) {
  std::string text;
  for (const VertexPair& pair : pairs) {
    text += (text.empty() ? "" : " ") + std::string("(p") + std::to_string(pair.p) + " - q" +
            std::to_string(pair.q) + ")";
  }
  return text;
}

std::string Text(const BoundedValue& value) {
  return ShortDouble(value.value) + " +- " + ShortDouble(value.error);
}

void PrintCertificate(std::ostream& out, const Certificate& certificate) {
  out << "certificate      " << ToString(certificate.kind);
  if (certificate.kind == CertificateKind::kSeparatingDirection) {
    out << " " << Text(certificate.direction);
  } else if (certificate.kind != CertificateKind::kNone &&
             certificate.kind != CertificateKind::kCoincidentInterior) {
    out << " " << Text(certificate.points);
  }
  out << "\n";
}

namespace {

Json ToJson(const PhaseReport& report) {
  Json json = {{"claim", ToString(report.claim)}};
  if (report.face_class) {
    json["class"] = ToString(*report.face_class);
    json["feature_p"] = ToJson(report.feature_p);
    json["feature_q"] = ToJson(report.feature_q);
    json["signed_distance"] = report.signed_distance;
  }
  return json;
}

Json ToJson(const TraceStep& step) {
  return {{"phase", ToString(step.phase)},           {"class", ToString(step.face_class)},
          {"feature_p", ToJson(step.feature_p)},     {"feature_q", ToJson(step.feature_q)},
          {"signed_distance", step.signed_distance}, {"accepted", step.accepted}};
}

constexpr std::array kSearchPhases = {Phase::kFaceVertex, Phase::kVertexFace, Phase::kEdgeEdge};

void PrintTrace(std::ostream& out, const std::vector<TraceStep>& trace) {
  if (trace.empty()) return;
  out << "faces visited\n";
  for (const TraceStep& step : trace) {
    out << "  " << ToString(step.phase) << "  " << ToString(step.face_class) << "  "
        << Text(step.feature_p) << ", " << Text(step.feature_q)
        << "  d = " << ShortDouble(step.signed_distance) << (step.accepted ? "  *" : "") << "\n";
  }
}

}  // namespace

Json ToJson(const CollideResult& result) {
  Json json = {{"verdict", ToString(result.verdict)},
               {"tier", ToString(result.tier)},
               {"phase", ToString(result.phase)},
               {"termination", ToString(result.termination)},
               {"interior_p", result.interior_p},
               {"interior_q", result.interior_q},
               {"interior_difference", ToJson(result.interior_difference)}};
  if (result.face) {
    json["face"] = {{"class", ToString(result.face->face_class)},
                    {"feature_p", ToJson(result.face->feature_p)},
                    {"feature_q", ToJson(result.face->feature_q)},
                    {"triangle", ToJson(result.face->triangle)}};
  }
  if (result.signed_distance) json["signed_distance"] = ToJson(*result.signed_distance);
  if (result.exit_travel) json["exit_travel"] = ToJson(*result.exit_travel);
  if (result.exit_point) {
    json["exit_point"] = ToJson(*result.exit_point);
    json["exit_point_error"] = result.exit_point_error;
  }
  json["certificate"] = ToJson(result.certificate);
  if (result.common_point) {
    json["common_point"] = ToJson(result.common_point->point);
    json["common_point_error"] = result.common_point->error;
  }
  for (std::size_t i = 0; i < kSearchPhases.size(); ++i) {
    json["phases"][std::string(ToString(kSearchPhases[i]))] = ToJson(result.phases[i]);
  }
  for (int i = 0; i < kPhaseCount; ++i) {
    const PhaseCounts& counts = result.counts[i];
    json["counts"][std::string(ToString(static_cast<Phase>(i)))] = {
        {"faces_visited", counts.faces_visited},
        {"support_calls", counts.support_calls},
        {"climb_steps", counts.climb_steps},
        {"arc_tests", counts.arc_tests}};
  }
  if (!result.trace.empty()) {
    json["trace"] = Json::array();
    for (const TraceStep& step : result.trace) json["trace"].push_back(ToJson(step));
  }
  return json;
}

Json ToJson(const std::vector<NamedFinding>& findings) {
  Json json = Json::array();
  for (const NamedFinding& finding : findings)
    json.push_back({{"kind", finding.kind}, {"detail", finding.detail}});
  return json;
}

void PrintResult(std::ostream& out, const CollideResult& result) {
  out << "verdict          " << ToString(result.verdict) << "\n"
      << "decided          by " << ToString(result.tier) << ", in " << ToString(result.phase)
      << ", " << ToString(result.termination) << "\n";
  if (result.face) {
    out << "exit face        " << ToString(result.face->face_class) << ": "
        << Text(result.face->feature_p) << " of P, " << Text(result.face->feature_q)
        << " of Q, through " << Text(result.face->triangle) << "\n";
  }
  if (result.signed_distance) out << "signed distance  " << Text(*result.signed_distance) << "\n";
  if (result.exit_travel) out << "exit travel      " << Text(*result.exit_travel) << "\n";
  if (result.exit_point) {
    out << "exit point       " << Text(*result.exit_point) << " +- "
        << ShortDouble(result.exit_point_error) << "\n";
  }
  PrintCertificate(out, result.certificate);
  if (result.common_point) {
    out << "common point     " << Text(result.common_point->point) << " +- "
        << ShortDouble(result.common_point->error) << "\n";
  }
  for (std::size_t i = 0; i < kSearchPhases.size(); ++i) {
    const PhaseReport& report = result.phases[i];
    if (report.claim == PhaseClaim::kNotRun) continue;
    out << "phase            " << ToString(kSearchPhases[i]) << ": " << ToString(report.claim);
    if (report.face_class) {
      out << ", " << ToString(*report.face_class) << ", " << Text(report.feature_p) << ", "
          << Text(report.feature_q) << ", d = " << ShortDouble(report.signed_distance);
    }
    out << "\n";
  }
  PrintTrace(out, result.trace);
}

}  // namespace touchstone
