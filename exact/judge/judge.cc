// SPDX-License-Identifier: GPL-3.0-or-later
#include "touchstone/exact/judge.h"

#include <Eigen/Geometry>

#include "touchstone/exact/judge/checks.h"

namespace touchstone::exact {
namespace {

bool InRange(int i, int count) { return i >= 0 && i < count; }

bool PairsInRange(const std::array<VertexPair, 3>& pairs, const ExactBodyData& p,
                  const ExactBodyData& q) {
  for (const VertexPair& pair : pairs) {
    if (!p.HasVertex(pair.p) || !q.HasVertex(pair.q)) return false;
  }
  return true;
}

// sign(det [v a b]) for the sides a, b of a triangle. Doubles first: v, a and b are scaled to at
// most 1, their components off by 2u of themselves, u = 2^-53; each of six products has three
// factors and at most five roundings, sums included: 6 (6 + 5)u < 2^-46, doubled for other rounding
// modes.
std::array<int, 3> SidesOf(const IntegerVector& v, const std::array<IntegerVector, 3>& points) {
  constexpr double kError = 0x1p-45;
  const Eigen::Vector3d ray = ToDirection(v);
  std::array<Eigen::Vector3d, 3> a;
  for (int i = 0; i < 3; ++i) a[i] = ToDirection(points[i]);
  std::array<int, 3> sides;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const double value = ray.dot(a[i].cross(a[j]));
    sides[i] = value > kError    ? 1
               : value < -kError ? -1
                                 : sgn(Determinant(v, points[i], points[j]));
  }
  return sides;
}

}  // namespace

std::string_view ToString(FindingKind kind) {
  switch (kind) {
    case FindingKind::kWrongVerdict:
      return "wrong_verdict";
    case FindingKind::kUndecided:
      return "undecided";
    case FindingKind::kBadCertificate:
      return "bad_certificate";
    case FindingKind::kNotAFace:
      return "not_a_face";
    case FindingKind::kWrongClass:
      return "wrong_class";
    case FindingKind::kValueOutOfBounds:
      return "value_out_of_bounds";
    case FindingKind::kLooseBound:
      return "loose_bound";
    case FindingKind::kNotOptimal:
      return "not_optimal";
    case FindingKind::kPhaseNotMaximal:
      return "phase_not_maximal";
    case FindingKind::kBadCounters:
      return "bad_counters";
    case FindingKind::kUnentitledExit:
      return "unentitled_exit";
    case FindingKind::kMissingPart:
      return "missing_part";
  }
  return "?";
}

const NamedTriangle& JudgeContext::Triangle(const std::array<VertexPair, 3>& pairs) const {
  if (triangle_.has_value() && triangle_->pairs == pairs) return *triangle_;
  NamedTriangle& t = triangle_.emplace();
  t.pairs = pairs;
  for (int i = 0; i < 3; ++i) t.points[i] = pair.FromC(pairs[i]);
  t.normal = Cross(t.points[1] - t.points[0], t.points[2] - t.points[0]);
  t.ratio = {Dot(t.normal, pair.v()), Dot(t.normal, t.points[0])};
  t.sides = SidesOf(pair.v(), t.points);
  supporting_.reset();
  return t;
}

const SupportingFeatures& JudgeContext::SupportingTriangle() const {
  if (!supporting_.has_value()) supporting_ = Supporting(pair, triangle_->normal);
  return *supporting_;
}

const ExactDecision& JudgeContext::Decision() const {
  if (!decision_.has_value()) {
    decision_ = Decide(p_, q_, pose_, result.interior_p, result.interior_q);
  }
  return *decision_;
}

Ratio JudgeContext::ExitRatio() const {
  if (face.has_value() && face->crossed) return face->ratio;
  const mpq_class& s = Decision().exit->parameter;
  return {s.get_den(), s.get_num()};
}

bool CheckIndices(const JudgeContext& context, const ExactBody& p, const ExactBody& q) {
  const CollideResult& result = context.result;
  if (result.certificate.kind == CertificateKind::kSeparatingFacet ||
      result.certificate.kind == CertificateKind::kEnclosingTetrahedron ||
      result.certificate.kind == CertificateKind::kTouchingFacet) {
    if (!PairsInRange(result.certificate.points, p.data(), q.data())) {
      context.Add(FindingKind::kBadCertificate, "names a vertex that does not exist");
      return false;
    }
  }
  if (result.face.has_value() &&
      (!PairsInRange(result.face->triangle, p.data(), q.data()) ||
       !p.data().Has(result.face->feature_p) || !q.data().Has(result.face->feature_q))) {
    context.Add(FindingKind::kNotAFace, "names an element that does not exist");
    return false;
  }
  for (const PhaseReport& report : result.phases) {
    if (report.face_class.has_value() &&
        (!p.data().Has(report.feature_p) || !q.data().Has(report.feature_q))) {
      context.Add(FindingKind::kPhaseNotMaximal, "a phase names an element that does not exist");
      return false;
    }
  }
  return true;
}

std::vector<Finding> Judge(const ExactBody& p, const ExactBody& q, const RelativePose& pose,
                           const CollideResult& result, const JudgeOptions& options) {
  std::vector<Finding> findings;
  if (!InRange(result.interior_p, 2) || !InRange(result.interior_q, 2)) {
    findings.push_back(
        {FindingKind::kBadCertificate, "names an interior point that does not exist"});
    return findings;
  }
  JudgeContext context(p, q, pose, result, options, &findings);
  if (!context.InteriorPointsAreInterior()) {
    context.Add(FindingKind::kBadCertificate, "an interior point is not strictly interior");
    return findings;
  }
  if (!CheckIndices(context, p, q)) return findings;
  const bool proven = CheckCertificate(context);
  CheckVerdict(context, proven);
  CheckCommonPoint(context);
  if (!IsZero(context.pair.c())) {
    CheckFace(&context);
    CheckValues(context);
    if (options.check_phase_maxima) CheckPhases(context);
    if (options.construct) CheckConstruction(context);
  }
  CheckCounters(context, proven);
  return findings;
}

}  // namespace touchstone::exact
