// SPDX-License-Identifier: GPL-3.0-or-later
#include "touchstone/exact/judge/proximity_checks.h"

#include <algorithm>
#include <climits>
#include <cmath>
#include <cstdio>

#include "touchstone/exact/judge/checks.h"
#include "touchstone/exact/judge/values.h"

namespace touchstone::exact {
namespace {

Real DistanceBetween(const Eigen::Vector3d& stated, const std::array<Real, 3>& exact) {
  Real squared;
  for (int k = 0; k < 3; ++k) {
    const Real difference = Real(stated[k]) - exact[k];
    squared = squared + difference * difference;
  }
  return Sqrt(squared);
}

bool InRange(int i, int count) { return i >= 0 && i < count; }

// The reference's own error, far below what doubles can state.
Real Slack(const PlacedPair& pair) { return Scale(Real(pair.size()), -200); }

}  // namespace

std::string Number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

IntegerVector ExactDirection(const Eigen::Vector3d& direction) {
  return ToInteger(direction, CommonExponent(direction.data(), 3, INT_MAX));
}

Real HeightAlong(const PlacedPair& pair, const IntegerVector& n) {
  const Integer height = Dot(n, pair.Difference(SupportingPair(pair, n)));
  return pair.ToLength(Real(height) / Sqrt(Real(Dot(n, n))));
}

Verdict ProximityContext::TrueVerdict() const { return Decide(p_, q_, pose_).verdict; }

void ProximityContext::CheckVerdictCertificate(Verdict verdict, const Certificate& certificate,
                                               int interior_p, int interior_q) const {
  if (!InRange(interior_p, 2) || !InRange(interior_q, 2)) {
    return Add(FindingKind::kBadCertificate, "names an interior point that does not exist");
  }
  CollideResult result;
  result.verdict = verdict;
  result.certificate = certificate;
  result.interior_p = interior_p;
  result.interior_q = interior_q;
  const JudgeOptions how;
  JudgeContext context(p_, q_, pose_, result, how, findings_);
  if (!context.InteriorPointsAreInterior()) {
    return Add(FindingKind::kBadCertificate, "an interior point is not strictly interior");
  }
  if (CheckIndices(context, p_, q_)) CheckCertificate(context);
}

void ProximityContext::CheckValue(const std::string& name, const BoundedValue& stated,
                                  const Real& exact, double amplification) const {
  const std::string is = name + " = " + Number(stated.value);
  if (!std::isfinite(stated.value)) return Add(FindingKind::kValueOutOfBounds, is);
  if (!std::isfinite(stated.error) || !std::isfinite(stated.condition) || stated.error < 0 ||
      stated.condition < 0) {
    return Add(FindingKind::kLooseBound, is + ": the error or condition is no bound");
  }
  if (Abs(Real(stated.value) - exact) > Real(stated.error) + Scale(Abs(exact), -200)) {
    Add(FindingKind::kValueOutOfBounds,
        is + " +- " + Number(stated.error) + ", is " + Number(exact.ToDouble()));
  }
  if (options.certainty == Certainty::kFloat) return;
  const double size = std::abs(stated.value), condition = amplification * pair.size();
  if (size == 0) {
    if (stated.error > kConditionFactor * kErrorFactor * condition)
      Add(FindingKind::kLooseBound, is + " +- " + Number(stated.error));
    return;
  }
  if (stated.condition > kConditionFactor * (1 + condition / size)) {
    Add(FindingKind::kLooseBound, is + ": condition " + Number(stated.condition) + ", at most " +
                                      Number(kConditionFactor * (1 + condition / size)));
  } else if (stated.error > kErrorFactor * stated.condition * size) {
    Add(FindingKind::kLooseBound,
        is + " +- " + Number(stated.error) + " at condition " + Number(stated.condition));
  }
}

void ProximityContext::CheckPoint(const std::string& name, const Eigen::Vector3d& stated,
                                  double error, const std::array<Real, 3>& exact) const {
  if (!stated.allFinite() || !std::isfinite(error)) {
    return Add(FindingKind::kValueOutOfBounds, name + " is not finite");
  }
  const Real off = DistanceBetween(stated, exact);
  if (!(error >= 0) || off > Real(error) + Slack(pair)) {
    Add(FindingKind::kValueOutOfBounds,
        name + " is off by " + Number(off.ToDouble()) + ", says " + Number(error));
  } else if (options.certainty == Certainty::kExact && error > kLengthTolerance * pair.size()) {
    Add(FindingKind::kLooseBound, name + " +- " + Number(error));
  }
}

void ProximityContext::CheckBound(const std::string& name, double stated, const Real& exact,
                                  bool from_below) const {
  const bool holds = std::isfinite(stated) && (from_below ? !(Real(stated) > exact + Slack(pair))
                                                          : !(exact > Real(stated) + Slack(pair)));
  if (!holds) {
    Add(FindingKind::kValueOutOfBounds,
        name + " = " + Number(stated) + " does not bound " + Number(exact.ToDouble()));
  }
}

void ProximityContext::CheckNear(const std::string& name, double stated, const Real& exact) const {
  if (Abs(Real(stated) - exact) > Real(kLengthTolerance * pair.size())) {
    Add(FindingKind::kLooseBound,
        name + " = " + Number(stated) + ", far from " + Number(exact.ToDouble()));
  }
}

bool ProximityContext::IndicesExist(const VertexPair& vertices) const {
  return pair.p().HasVertex(vertices.p) && pair.q().HasVertex(vertices.q);
}

bool ProximityContext::FeatureExists(const Feature& feature, bool of_p) const {
  return (of_p ? pair.p() : pair.q()).Has(feature);
}

void ProximityContext::CheckFeature(const std::string& name, const Feature& feature,
                                    const ExactBodyData& body,
                                    const std::vector<int>& supporting) const {
  if (DimensionOf(feature.kind) != Dimension(body, supporting)) {
    Add(FindingKind::kWrongClass, name + " is not of the supporting feature's dimension");
  } else if (!Includes(supporting, VerticesOf(body, feature))) {
    Add(FindingKind::kWrongClass, name + " does not support the body");
  }
}

std::optional<IntegerVector> ProximityContext::CheckFacet(const std::string& name,
                                                          const ContactFacet& facet) const {
  for (const VertexPair& vertices : facet.triangle) {
    if (!IndicesExist(vertices)) {
      Add(FindingKind::kNotAFace, name + " names a vertex that does not exist");
      return std::nullopt;
    }
  }
  if (!FeatureExists(facet.feature_p, true) || !FeatureExists(facet.feature_q, false)) {
    Add(FindingKind::kNotAFace, name + " names an element that does not exist");
    return std::nullopt;
  }
  const IntegerVector a = pair.Difference(facet.triangle[0]);
  const IntegerVector n =
      Cross(pair.Difference(facet.triangle[1]) - a, pair.Difference(facet.triangle[2]) - a);
  if (IsZero(n)) {
    Add(FindingKind::kNotAFace, name + ": the three points are collinear");
    return std::nullopt;
  }
  const SupportingFeatures supporting = Supporting(pair, n);
  for (const VertexPair& vertices : facet.triangle) {
    if (!std::binary_search(supporting.p.begin(), supporting.p.end(), vertices.p) ||
        !std::binary_search(supporting.q.begin(), supporting.q.end(), vertices.q)) {
      Add(FindingKind::kNotAFace, name + ": the plane does not support M");
      return std::nullopt;
    }
  }
  const std::optional<FaceClass> exact = ClassOf(pair, supporting);
  if (exact != facet.face_class) {
    Add(FindingKind::kWrongClass,
        name + " says " + std::string(ToString(facet.face_class)) + ", is " +
            (exact.has_value() ? std::string(ToString(*exact)) : std::string("no facet")));
  }
  CheckFeature(name + ", P's feature", facet.feature_p, pair.p(), supporting.p);
  CheckFeature(name + ", Q's feature", facet.feature_q, pair.q(), supporting.q);
  return n;
}

}  // namespace touchstone::exact
