// SPDX-License-Identifier: GPL-3.0-or-later
//
// The judge of distances.
#include <cmath>

#include "touchstone/exact/convex_minkowski.h"
#include "touchstone/exact/judge/checks.h"
#include "touchstone/exact/judge/proximity_checks.h"
#include "touchstone/exact/nearest_point.h"

namespace touchstone::exact {
namespace {

constexpr double kUndecidedGap = 1e-12;  // of the size; as for verdicts

class DistanceJudge {
 public:
  DistanceJudge(const ProximityContext& context, const DistanceResult& result)
      : context_(context), pair_(context.pair), result_(result) {}

  void Run() {
    const Verdict truth = context_.TrueVerdict();
    switch (result_.kind) {
      case DistanceKind::kMeet:
        if (truth == Verdict::kSeparate) return Wrong(truth);
        return JudgeMeet();
      case DistanceKind::kSeparate:
        if (truth != Verdict::kSeparate) return Wrong(truth);
        return JudgeSeparate();
      case DistanceKind::kUndecided:
        return JudgeUndecided(truth);
    }
  }

 private:
  void Wrong(Verdict truth) const {
    context_.Add(FindingKind::kWrongVerdict, "says " + std::string(ToString(result_.kind)) +
                                                 ", is " + std::string(ToString(truth)));
  }

  void JudgeMeet() const {
    if (result_.distance.value != 0 || result_.distance.error != 0 || result_.lower != 0 ||
        result_.upper != 0) {
      context_.Add(FindingKind::kValueOutOfBounds, "the bodies meet, and the distance is not 0");
    }
    const bool touch = result_.certificate.kind == CertificateKind::kTouchingFacet;
    context_.CheckVerdictCertificate(touch ? Verdict::kTouch : Verdict::kOverlap,
                                     result_.certificate, result_.interior_p, result_.interior_q);
  }

  void JudgeUndecided(Verdict truth) const {
    if (context_.options.certainty == Certainty::kExact) {
      return context_.Add(FindingKind::kUndecided,
                          "undecided, though exact certainty was asked for");
    }
    if (truth != Verdict::kSeparate) return;  // how deep they may overlap is the verdict's judge's
    const Real distance = LengthOf(pair_, *FindNearest(pair_));
    if (distance > Real(kUndecidedGap * pair_.size())) {
      context_.Add(FindingKind::kUndecided, "undecided at " + Number(distance.ToDouble()));
    }
  }

  void JudgeSeparate() const {
    if (result_.simplex_size < 1 || result_.simplex_size > 3) {
      return context_.Add(FindingKind::kMissingPart, "no simplex");
    }
    const std::span<const VertexPair> simplex(result_.simplex.data(), result_.simplex_size);
    for (const VertexPair& vertices : simplex) {
      if (!context_.IndicesExist(vertices)) {
        return context_.Add(FindingKind::kNotOptimal, "names a vertex that does not exist");
      }
    }
    if (!result_.optimal && context_.options.certainty == Certainty::kExact) {
      context_.Add(FindingKind::kNotOptimal, "not proven, though exact certainty was asked for");
    }
    const std::optional<ExactPoint> named = NearestOfHull(pair_, simplex);
    const bool is_nearest = named.has_value() && IsNearest(pair_, *named);
    if (result_.optimal && !is_nearest) {
      context_.Add(FindingKind::kNotOptimal, "the simplex does not hold the nearest point");
    }
    const ExactPoint nearest = is_nearest ? *named : *FindNearest(pair_);
    const Real exact = LengthOf(pair_, nearest);
    if (result_.optimal) {
      context_.CheckValue("distance", result_.distance, exact, 1.0);
      // A direction of doubles alone may be turned so far that it proves little of a small gap.
      if (context_.options.certainty == Certainty::kExact)
        context_.CheckNear("lower", result_.lower, exact);
      context_.CheckNear("upper", result_.upper, exact);
    } else {
      CheckUnprovenValue(exact);
    }
    context_.CheckBound("upper", result_.upper, exact, false);
    CheckDirection(exact);
    if (is_nearest && result_.optimal) {
      context_.CheckPoint("point_on_p", result_.point_on_p, result_.point_error,
                          PointOnP(pair_, nearest));
      context_.CheckPoint("point_on_q", result_.point_on_q, result_.point_error,
                          PointOnQ(pair_, nearest));
      CheckFeatures(nearest);
      if (context_.options.construct) CheckConstruction(exact);
    } else {
      CheckOnBodies();
    }
  }

  // Without a proof of optimality the value need not be tight, but its bounds must hold.
  void CheckUnprovenValue(const Real& exact) const {
    const BoundedValue& stated = result_.distance;
    if (!(stated.error >= 0) || !std::isfinite(stated.value) ||
        Abs(Real(stated.value) - exact) > Real(stated.error) + Scale(exact, -200)) {
      context_.Add(FindingKind::kValueOutOfBounds, "distance = " + Number(stated.value) + " +- " +
                                                       Number(stated.error) + ", is " +
                                                       Number(exact.ToDouble()));
    }
  }

  // The bodies are apart along the direction, taken exactly, by at least `lower`.
  void CheckDirection(const Real& exact) const {
    const Eigen::Vector3d& direction = result_.direction;
    if (!direction.allFinite() || std::abs(direction.norm() - 1.0) > 0x1p-48) {
      return context_.Add(FindingKind::kBadCertificate, "the direction is not of unit length");
    }
    const Real apart = Real() - HeightAlong(pair_, ExactDirection(direction));
    if (result_.lower > 0)
      context_.CheckBound("lower, along the direction", result_.lower, apart, true);
    context_.CheckBound("lower", result_.lower, exact, true);
  }

  void CheckFeatures(const ExactPoint& nearest) const {
    if (!result_.feature_p.has_value() || !result_.feature_q.has_value()) {
      return context_.Add(FindingKind::kMissingPart, "no features");
    }
    if (!context_.FeatureExists(*result_.feature_p, true) ||
        !context_.FeatureExists(*result_.feature_q, false)) {
      return context_.Add(FindingKind::kWrongClass, "names an element that does not exist");
    }
    const SupportingFeatures supporting = Supporting(pair_, -nearest.numerator);
    context_.CheckFeature("P's feature", *result_.feature_p, pair_.p(), supporting.p);
    context_.CheckFeature("Q's feature", *result_.feature_q, pair_.q(), supporting.q);
  }

  // Points of their bodies up to the error: not further beyond any face.
  void CheckOnBodies() const {
    const auto beyond = [&](const Real& height, const IntegerVector& n) {
      return height / Sqrt(Real(Dot(n, n))) >
             Real(result_.point_error) + Scale(Real(pair_.size()), -200);
    };
    if (!result_.point_on_p.allFinite() || !result_.point_on_q.allFinite()) {
      return context_.Add(FindingKind::kValueOutOfBounds, "a point is not finite");
    }
    const ExactBodyData &p = pair_.p(), &q = pair_.q();
    for (int f = 0; f < p.face_count; ++f) {
      const IntegerVector& n = p.normals().exact[f];
      Real height = Real() - Scale(Real(Dot(n, p.vertices[p.normals().plane[f][0]])), p.exponent);
      for (int k = 0; k < 3; ++k) height = height + Real(n[k]) * Real(result_.point_on_p[k]);
      if (beyond(height, n)) {
        context_.Add(FindingKind::kValueOutOfBounds, "point_on_p is not on P");
        break;
      }
    }
    for (int f = 0; f < q.face_count; ++f) {
      const IntegerVector n = pair_.NormalFromQ(q.normals().exact[f]);
      const int v = q.normals().plane[f][0];
      const Integer at_face = pair_.ValueQ(pair_.ToQ(n), n, v);
      Real height = Real() - pair_.ToLength(Real(at_face));
      for (int k = 0; k < 3; ++k) height = height + Real(n[k]) * Real(result_.point_on_q[k]);
      if (beyond(height, n)) {
        context_.Add(FindingKind::kValueOutOfBounds, "point_on_q is not on Q");
        break;
      }
    }
  }

  // M whole: no vertex of M is below the plane, and the nearest facet, edge or vertex is at
  // `exact`.
  void CheckConstruction(const Real& exact) const {
    const MinkowskiDifference m = ConvexMinkowski(pair_);
    // The distance of a point from a convex body is the largest over its facets' planes or more,
    // and is the nearest vertex's or less.
    Real least_vertex(HUGE_VAL), most_plane;
    for (const IntegerVector& v : m.vertices) {
      const Real length = pair_.ToLength(Sqrt(Real(Dot(v, v))));
      if (length < least_vertex) least_vertex = length;
    }
    for (const MinkowskiFacet& f : m.facets) {
      const Real height = pair_.ToLength(Real(Integer(-f.plane.offset)) /
                                         Sqrt(Real(Dot(f.plane.normal, f.plane.normal))));
      if (height > most_plane) most_plane = height;
    }
    const Real slack = Scale(exact, -200);
    if (exact > least_vertex + slack || most_plane > exact + slack) {
      context_.Add(FindingKind::kNotOptimal, "construction: M is elsewhere");
    }
  }

  const ProximityContext& context_;
  const PlacedPair& pair_;
  const DistanceResult& result_;
};

}  // namespace

std::vector<Finding> JudgeDistance(const ExactBody& p, const ExactBody& q, const RelativePose& pose,
                                   const DistanceResult& result,
                                   const ProximityJudgeOptions& options) {
  std::vector<Finding> findings;
  const ProximityContext context(p, q, pose, 0, 0, options, &findings);
  DistanceJudge(context, result).Run();
  return findings;
}

}  // namespace touchstone::exact
