// SPDX-License-Identifier: GPL-3.0-or-later
//
// The judge of travels. A travel is t = N.w / N.s for the facet through w with normal N: moving the
// facet's points by u S moves t by u S |N| / |N.s|, so A = |N| / |N.s| (proximity_checks.h).
#include <algorithm>
#include <climits>
#include <cmath>

#include "touchstone/exact/convex_minkowski.h"
#include "touchstone/exact/judge/checks.h"
#include "touchstone/exact/judge/proximity_checks.h"

namespace touchstone::exact {
namespace {

class TravelJudge {
 public:
  TravelJudge(const ProximityContext& context, const Eigen::Vector3d& s,
              const DirectionalResult& result)
      : context_(context),
        pair_(context.pair),
        exponent_(CommonExponent(s.data(), 3, INT_MAX)),
        s_(ToInteger(s, exponent_)),
        result_(result) {}

  void Run() {
    if (result_.kind == TravelKind::kUndecided) {
      if (context_.options.certainty == Certainty::kExact) {
        context_.Add(FindingKind::kUndecided, "undecided, though exact certainty was asked for");
      }
      return;
    }
    result_.kind == TravelKind::kNever ? JudgeNever() : JudgeInterval();
    if (context_.options.all_faces) CheckShadow();
  }

 private:
  void JudgeNever() const {
    for (const VertexPair& vertices : result_.separator) {
      if (!context_.IndicesExist(vertices)) {
        return context_.Add(FindingKind::kBadCertificate, "names a vertex that does not exist");
      }
    }
    const IntegerVector w = pair_.Difference(result_.separator[0]);
    const IntegerVector n = Cross(pair_.Difference(result_.separator[1]) - w, s_);
    if (DotSign(n, w) >= 0) {
      context_.Add(FindingKind::kBadCertificate, "the line is not beyond the separator");
    } else if (Dot(n, pair_.Difference(SupportingPair(pair_, n))) > Dot(n, w)) {
      context_.Add(FindingKind::kBadCertificate, "M is on both sides of the separator");
    }
  }

  void JudgeInterval() const {
    const std::optional<mpq_class> enter = CheckEnd("enter", result_.enter, -1);
    const std::optional<mpq_class> leave = CheckEnd("leave", result_.leave, 1);
    if (!(result_.enter.travel.value <= result_.leave.travel.value)) {
      context_.Add(FindingKind::kValueOutOfBounds, "it leaves before it enters");
    }
    if (!enter.has_value() || !leave.has_value()) return;
    if (*enter > *leave) context_.Add(FindingKind::kNotAFace, "the facets do not bound the line");
    const bool meet = sgn(*enter) <= 0 && sgn(*leave) >= 0;
    if (meet != (context_.TrueVerdict() != Verdict::kSeparate)) {
      context_.Add(FindingKind::kWrongVerdict, "the interval contradicts the verdict");
    }
    if (context_.options.construct) CheckConstruction(*enter, *leave);
  }

  // t |s| over the unit of M's integers and of s_: exact.
  mpq_class Travel(const IntegerVector& n, const Integer& height) const {
    mpq_class t(height, Dot(n, s_));
    t.canonicalize();
    return t;
  }

  // The end as M's integers and s_ have it; nothing when the facet does not stand.
  std::optional<mpq_class> CheckEnd(const std::string& name, const TravelEnd& end,
                                    int sense) const {
    if (!end.facet.has_value()) {
      context_.Add(FindingKind::kMissingPart, name + " has no facet");
      return std::nullopt;
    }
    const std::optional<IntegerVector> n = context_.CheckFacet(name, *end.facet);
    if (!n.has_value()) return std::nullopt;
    const Integer along = Dot(*n, s_);
    if (sgn(along) != sense) {
      context_.Add(FindingKind::kNotAFace, name + ": the facet faces the other way");
      return std::nullopt;
    }
    std::array<IntegerVector, 3> w;
    for (int i = 0; i < 3; ++i) w[i] = pair_.Difference(end.facet->triangle[i]);
    for (int i = 0; i < 3; ++i) {
      if (sgn(Determinant(s_, w[i], w[(i + 1) % 3])) * sense < 0) {
        context_.Add(FindingKind::kNotAFace, name + ": the line misses the triangle");
        return std::nullopt;
      }
    }
    const Integer height = Dot(*n, w[0]);
    const Real exact = Scale(pair_.ToLength(Real(height) / Real(along)), -exponent_);
    const Real amplification = Scale(Sqrt(Real(Dot(*n, *n))) / Abs(Real(along)), -exponent_);
    context_.CheckValue(name, end.travel, exact, amplification.ToDouble());
    if (context_.options.certainty == Certainty::kExact) {
      const int stated = (end.travel.value > 0) - (end.travel.value < 0);
      if (stated != exact.sign() || (stated == 0 && end.travel.error != 0)) {
        context_.Add(FindingKind::kValueOutOfBounds, name + " has the wrong sign");
      }
    }
    return Travel(*n, height);
  }

  // Where the shadow of o lies to that of M: 1 inside, 0 on its boundary, -1 outside. The sides of
  // M's shadow are parallel to shadows of edges of P or Q, so these are all that can bound it.
  int ShadowSign() const {
    int sign = 1;
    const auto consider = [&](const IntegerVector& edge) {
      const IntegerVector across = Cross(edge, s_);
      if (IsZero(across)) return;
      for (const IntegerVector& n : {across, -across}) {
        sign = std::min(sign, DotSign(n, pair_.Difference(SupportingPair(pair_, n))));
      }
    };
    for (const IntegerVector& edge : pair_.p().edge_vectors().exact) consider(edge);
    for (const IntegerVector& edge : pair_.q().edge_vectors().exact)
      consider(pair_.VectorFromQ(edge));
    return sign;
  }

  void CheckShadow() const {
    const int sign = ShadowSign();
    if ((sign < 0) != (result_.kind == TravelKind::kNever)) {
      return context_.Add(FindingKind::kWrongVerdict,
                          "says " + std::string(ToString(result_.kind)) + ", and the shadows " +
                              (sign < 0 ? "miss" : "meet"));
    }
    if (context_.options.certainty == Certainty::kExact && result_.grazing != (sign == 0)) {
      context_.Add(FindingKind::kWrongVerdict,
                   sign == 0 ? "the line only grazes M" : "the line does not graze M");
    }
  }

  void CheckConstruction(const mpq_class& enter, const mpq_class& leave) const {
    const MinkowskiDifference m = ConvexMinkowski(pair_);
    std::optional<mpq_class> low, high;
    for (const MinkowskiFacet& f : m.facets) {
      const int sense = DotSign(f.plane.normal, s_);
      if (sense == 0) continue;
      const mpq_class t = Travel(f.plane.normal, f.plane.offset);
      if (sense > 0 && (!high.has_value() || t < *high)) high = t;
      if (sense < 0 && (!low.has_value() || t > *low)) low = t;
    }
    if (*low != enter || *high != leave) {
      context_.Add(FindingKind::kNotOptimal, "construction: the line crosses M elsewhere");
    }
  }

  const ProximityContext& context_;
  const PlacedPair& pair_;
  const int exponent_;
  const IntegerVector s_;  // s over 2^exponent_
  const DirectionalResult& result_;
};

}  // namespace

std::vector<Finding> JudgeDirection(const ExactBody& p, const ExactBody& q,
                                    const RelativePose& pose, const Eigen::Vector3d& s,
                                    const DirectionalResult& result,
                                    const ProximityJudgeOptions& options) {
  std::vector<Finding> findings;
  const ProximityContext context(p, q, pose, 0, 0, options, &findings);
  TravelJudge(context, s, result).Run();
  return findings;
}

std::vector<Finding> JudgePublishedTravel(const PublishedTravel& published,
                                          const DirectionalResult& truth) {
  std::vector<Finding> findings;
  const auto add = [&](FindingKind kind, std::string detail) {
    findings.push_back({kind, std::move(detail)});
  };
  const bool never = truth.kind == TravelKind::kNever;
  if ((published.kind == PublishedTravelKind::kNever) != never) {
    add(FindingKind::kWrongVerdict, "says " + std::string(ToString(published.kind)) + ", is " +
                                        std::string(ToString(truth.kind)));
  } else if (published.kind == PublishedTravelKind::kOnBoundary) {
    add(FindingKind::kMissingPart, "c is on the boundary of M");
  } else if (published.kind == PublishedTravelKind::kCoincident) {
    add(FindingKind::kMissingPart, "c is o");
  } else if (published.kind == PublishedTravelKind::kTravel) {
    // The ray from c = k s through o runs down for k > 0, and leaves M where the line enters it.
    const TravelEnd& end = published.c_travel > 0 ? truth.enter : truth.leave;
    const double allowed =
        end.travel.error + 1e-9 * std::max(end.travel.condition, 1.0) * std::abs(end.travel.value);
    if (!(std::abs(published.travel - end.travel.value) <= allowed)) {
      add(FindingKind::kNotOptimal,
          "says " + Number(published.travel) + ", is " + Number(end.travel.value));
    }
  }
  return findings;
}

}  // namespace touchstone::exact
