// SPDX-License-Identifier: GPL-3.0-or-later
//
// The judge of depths.
#include <algorithm>
#include <cmath>
#include <map>

#include "touchstone/exact/convex_minkowski.h"
#include "touchstone/exact/judge/checks.h"
#include "touchstone/exact/judge/proximity_checks.h"
#include "touchstone/exact/nearest_facet.h"
#include "touchstone/exact/nearest_point.h"

namespace touchstone::exact {
namespace {

constexpr double kUndecidedGap = 1e-12;  // of the size; as for verdicts

class PenetrationJudge {
 public:
  PenetrationJudge(const ProximityContext& context, const PenetrationResult& result)
      : context_(context), pair_(context.pair), result_(result) {}

  void Run() {
    const Verdict truth = context_.TrueVerdict();
    if (result_.verdict == Verdict::kUndecided) return JudgeUndecided(truth);
    if (result_.verdict != truth) {
      return context_.Add(FindingKind::kWrongVerdict, "says " +
                                                          std::string(ToString(result_.verdict)) +
                                                          ", is " + std::string(ToString(truth)));
    }
    truth == Verdict::kOverlap ? JudgeOverlap() : JudgeApart();
  }

 private:
  void JudgeUndecided(Verdict truth) const {
    if (context_.options.certainty == Certainty::kExact) {
      return context_.Add(FindingKind::kUndecided,
                          "undecided, though exact certainty was asked for");
    }
    if (truth != Verdict::kOverlap || !context_.options.all_faces) return;
    const Real depth = DistanceOf(pair_, *NearestFacet(pair_));
    if (depth > Real(kUndecidedGap * pair_.size())) {
      context_.Add(FindingKind::kUndecided, "undecided at a depth of " + Number(depth.ToDouble()));
    }
  }

  void JudgeApart() const {
    if (result_.depth.value != 0 || result_.depth.error != 0 || result_.lower != 0 ||
        result_.upper != 0 || !result_.translation.isZero(0)) {
      context_.Add(FindingKind::kValueOutOfBounds,
                   "the interiors do not meet, and the depth is not 0");
    }
    context_.CheckVerdictCertificate(result_.verdict, result_.certificate, result_.interior_p,
                                     result_.interior_q);
    if (result_.verdict == Verdict::kSeparate || !result_.facet.has_value()) return;
    const std::optional<IntegerVector> n = context_.CheckFacet("facet", *result_.facet);
    if (n.has_value() && DotSign(*n, pair_.Difference(result_.facet->triangle[0])) != 0) {
      context_.Add(FindingKind::kNotAFace, "the bodies do not touch in the facet");
    }
  }

  void JudgeOverlap() const {
    const bool exact_asked = context_.options.certainty == Certainty::kExact;
    if (exact_asked && (!result_.minimal || !result_.facet.has_value())) {
      context_.Add(FindingKind::kMissingPart, "no facet proven nearest");
    }
    std::optional<SupportingPlane> named;
    if (result_.facet.has_value()) {
      if (const auto n = context_.CheckFacet("facet", *result_.facet); n.has_value()) {
        named = SupportingPlane{*n, Dot(*n, pair_.Difference(result_.facet->triangle[0]))};
        CheckFoot(*named);
      }
    }
    std::optional<SupportingPlane> nearest = named;
    if (context_.options.all_faces || !named.has_value()) {
      nearest = NearestFacet(pair_);
      if (named.has_value() && result_.minimal && CompareDistances(*named, *nearest) != 0) {
        context_.Add(FindingKind::kNotOptimal,
                     "a facet at " + Number(DistanceOf(pair_, *named).ToDouble()) +
                         ", the nearest is at " + Number(DistanceOf(pair_, *nearest).ToDouble()));
      }
    }
    if (context_.options.construct) CheckConstruction(*nearest);
    CheckValues(DistanceOf(pair_, *nearest));
    if (!result_.inner_polytope.empty()) CheckInnerPolytope();
  }

  // Translation, foot in the triangle, deepest points.
  void CheckFoot(const SupportingPlane& plane) const {
    const std::optional<ExactPoint> foot = NearestOfHull(pair_, result_.facet->triangle);
    if (!foot.has_value()) {
      return context_.Add(FindingKind::kNotAFace, "the triangle does not hold the foot");
    }
    std::array<Real, 3> translation;
    const Real squared(Dot(plane.normal, plane.normal));
    for (int k = 0; k < 3; ++k) {
      translation[k] = pair_.ToLength(Real(Integer(plane.normal[k] * plane.height)) / squared);
    }
    context_.CheckPoint("translation", result_.translation, result_.foot_error, translation);
    context_.CheckPoint("point_on_p", result_.point_on_p, result_.point_error,
                        PointOnP(pair_, *foot));
    context_.CheckPoint("point_on_q", result_.point_on_q, result_.point_error,
                        PointOnQ(pair_, *foot));
  }

  void CheckValues(const Real& exact) const {
    const bool proven = result_.minimal && context_.options.certainty == Certainty::kExact;
    if (proven) {
      context_.CheckValue("depth", result_.depth, exact, 1.0);
      context_.CheckNear("lower", result_.lower, exact);
      context_.CheckNear("upper", result_.upper, exact);
    } else {
      const Real off = Abs(Real(result_.depth.value) - exact);
      if (!std::isfinite(result_.depth.value) || !(result_.depth.error >= 0) ||
          off > Real(result_.depth.error) + Scale(exact, -200)) {
        context_.Add(FindingKind::kValueOutOfBounds, "depth = " + Number(result_.depth.value) +
                                                         " +- " + Number(result_.depth.error) +
                                                         ", is " + Number(exact.ToDouble()));
      }
    }
    context_.CheckBound("lower", result_.lower, exact, true);
    context_.CheckBound("upper", result_.upper, exact, false);
    const Eigen::Vector3d& direction = result_.direction;
    if (!direction.allFinite() || std::abs(direction.norm() - 1.0) > 0x1p-48) {
      return context_.Add(FindingKind::kBadCertificate, "the direction is not of unit length");
    }
    context_.CheckBound("upper, along the direction", result_.upper,
                        HeightAlong(pair_, ExactDirection(direction)), false);
  }

  // A point of the polytope: of M, or c.
  IntegerVector PointOf(const VertexPair& vertices) const {
    return vertices.p < 0 ? pair_.c() : pair_.Difference(vertices);
  }

  void CheckInnerPolytope() const {
    const auto bad = [&](const char* why) {
      context_.Add(FindingKind::kBadCertificate, std::string("inner polytope: ") + why);
    };
    // Every side once in each sense.
    std::map<std::array<int, 4>, int> sides;
    for (const auto& triangle : result_.inner_polytope) {
      for (int i = 0; i < 3; ++i) {
        const VertexPair &a = triangle[i], &b = triangle[(i + 1) % 3];
        if (!(a.p == -1 && a.q == -1) && !context_.IndicesExist(a))
          return bad("names a vertex that does not exist");
        ++sides[{a.p, a.q, b.p, b.q}];
      }
    }
    for (const auto& [side, count] : sides) {
      const auto back = sides.find({side[2], side[3], side[0], side[1]});
      if (count != 1 || back == sides.end() || back->second != 1) return bad("is not closed");
    }
    for (const auto& triangle : result_.inner_polytope) {
      const IntegerVector a = PointOf(triangle[0]), b = PointOf(triangle[1]),
                          c = PointOf(triangle[2]);
      if (sgn(Determinant(a, b, c)) <= 0) return bad("o is not on the inner side of a triangle");
      if (NearestSquared({a, b, c}) <
          Real(result_.lower) * Real(result_.lower) * (Real(1.0) - Scale(Real(1.0), -200)))
        return bad("comes nearer than `lower`");
    }
  }

  // The squared distance of o from a triangle, in true lengths.
  Real NearestSquared(const std::array<IntegerVector, 3>& w) const {
    const auto length_squared = [&](const Real& squared) {
      return pair_.ToLength(pair_.ToLength(squared));
    };
    const IntegerVector n = Cross(w[1] - w[0], w[2] - w[0]);
    bool inside = true;
    for (int i = 0; i < 3; ++i) inside = inside && DotSign(n, Cross(w[i], w[(i + 1) % 3])) >= 0;
    const Real height(Dot(n, w[0]));
    if (inside) return length_squared(height * height / Real(Dot(n, n)));
    Real least(HUGE_VAL);
    for (int i = 0; i < 3; ++i) {
      const IntegerVector &a = w[i], u = w[(i + 1) % 3] - a;
      const Integer rise = -Dot(u, a), length = Dot(u, u);
      Real squared(Dot(a, a));
      if (sgn(rise) > 0 && rise < length)
        squared = squared - Real(Integer(rise * rise)) / Real(length);
      if (squared < least) least = squared;
    }
    return length_squared(least);
  }

  void CheckConstruction(const SupportingPlane& nearest) const {
    const MinkowskiDifference m = ConvexMinkowski(pair_);
    const bool nearer = std::any_of(m.facets.begin(), m.facets.end(), [&](const MinkowskiFacet& f) {
      return CompareDistances({f.plane.normal, f.plane.offset}, nearest) < 0;
    });
    const bool found = std::any_of(m.facets.begin(), m.facets.end(), [&](const MinkowskiFacet& f) {
      return CompareDistances({f.plane.normal, f.plane.offset}, nearest) == 0;
    });
    if (nearer || !found) {
      context_.Add(FindingKind::kNotOptimal, nearer ? "construction: a facet of M is nearer"
                                                    : "construction: no facet of M is so near");
    }
  }

  const ProximityContext& context_;
  const PlacedPair& pair_;
  const PenetrationResult& result_;
};

bool InRange(int i) { return i == 0 || i == 1; }

}  // namespace

std::vector<Finding> JudgePenetration(const ExactBody& p, const ExactBody& q,
                                      const RelativePose& pose, const PenetrationResult& result,
                                      const ProximityJudgeOptions& options) {
  std::vector<Finding> findings;
  if (!InRange(result.interior_p) || !InRange(result.interior_q)) {
    findings.push_back(
        {FindingKind::kBadCertificate, "names an interior point that does not exist"});
    return findings;
  }
  const ProximityContext context(p, q, pose, result.interior_p, result.interior_q, options,
                                 &findings);
  PenetrationJudge(context, result).Run();
  return findings;
}

}  // namespace touchstone::exact
