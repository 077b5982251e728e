// SPDX-License-Identifier: MIT
#include "touchstone/core/proximity/directional_distance.h"

#include <algorithm>
#include <cmath>

#include "touchstone/core/cd_dual/certify.h"
#include "touchstone/core/proximity/estimate_internal.h"
#include "touchstone/core/proximity/line.h"
#include "touchstone/core/proximity/validate_internal.h"

namespace touchstone {
namespace {

using internal::Cross;
using internal::DifferenceOf;
using internal::Dot;
using internal::Estimate;
using internal::EstimateVector;
using internal::MakeEstimate;
using internal::PointOf;

constexpr double kClaimPerCondition = 1e-12;  // the largest relative error claimed, per condition

class DirectionalQuery {
 public:
  DirectionalQuery(const ConvexPolyhedron& p, const ConvexPolyhedron& q, const RelativePose& pose,
                   const Eigen::Vector3d& s, const DirectionalOptions& options)
      : m_(p, q, pose), signs_(m_, options.certainty), s_(s) {}

  DirectionalResult Run() {
    ChooseInteriorDifference(&m_);
    const LineProposal proposal = SearchLine(m_, s_.scaled, &result_.counts);
    if (!Settle(proposal) && signs_.exact_allowed()) {
      Settle(FindExactLine(&signs_, s_, false, &result_.counts));
    }
    if (result_.kind == TravelKind::kInterval) Measure();
    result_.tier = result_.kind == TravelKind::kUndecided ? Tier::kNone
                   : signs_.exact_count() == 0            ? Tier::kBound
                                                          : Tier::kExact;
    result_.exact_signs = signs_.exact_count();
    return result_;
  }

 private:
  // Proves what a search proposes.
  bool Settle(const LineProposal& proposal) {
    if (proposal.kind == LineProposal::Kind::kMissed) return SettleMissed(proposal.edge);
    if (proposal.kind != LineProposal::Kind::kCrossed) return false;
    inside_shadow_ = false;
    result_.leave.facet = ProveCrossed(proposal.upper, 1);
    if (!result_.leave.facet) return false;
    result_.enter.facet = ProveCrossed(proposal.lower, -1);
    if (!result_.enter.facet) return false;
    result_.kind = TravelKind::kInterval;
    // A triangle of M with the line strictly inside its shadow has points of M's inside on the
    // line.
    if (!inside_shadow_ && signs_.exact_allowed()) {
      result_.grazing =
          FindExactLine(&signs_, s_, true, &result_.counts).kind == LineProposal::Kind::kMissed;
    }
    return true;
  }

  // N = (w1 - w0) x s is outward at an edge of M's shadow, and o lies strictly beyond.
  bool SettleMissed(const std::array<VertexPair, 2>& edge) {
    const auto side = LineSide(&signs_, s_, edge[0], edge[1]);
    if (!side || *side >= 0) return false;
    FacetPlane plane;
    plane.points = {edge[0], edge[1], edge[1]};
    const EstimateVector normal =
        Cross(DifferenceOf(m_, edge[1], edge[0]), MakeEstimate(s_.scaled, 0x1p-1000));
    plane.normal = internal::Values(normal);
    plane.normal_error = std::max({normal[0].error, normal[1].error, normal[2].error});
    const auto supports = [&](Signs* signs) {
      return SupportingFeature(signs, &plane, Body::kP, edge[0].p).has_value() &&
             SupportingFeature(signs, &plane, Body::kQ, edge[0].q).has_value();
    };
    Signs in_doubles(m_, Certainty::kFloat);
    if (!supports(&in_doubles)) {
      if (!signs_.exact_allowed()) return false;
      signs_.CountExact();
      const ExactDifference& big = signs_.exact();
      plane.exact_normal = Cross(big.Point(edge[1]) - big.Point(edge[0]), s_.exact);
      if (!supports(&signs_)) return false;
    }
    result_.kind = TravelKind::kNever;
    result_.separator = edge;
    return true;
  }

  // The facet through a triangle that the line crosses, `sense` 1 upward: the triangle's shadow
  // holds o, so its plane is not parallel to the line; and the plane supports M.
  std::optional<ContactFacet> ProveCrossed(const std::array<VertexPair, 3>& triangle, int sense) {
    bool strictly = true, at_all = false;
    for (int i = 0; i < 3; ++i) {
      if (triangle[i].p < 0) return std::nullopt;
      const auto side = LineSide(&signs_, s_, triangle[i], triangle[(i + 1) % 3]);
      if (!side || *side * sense < 0) return std::nullopt;
      strictly = strictly && *side != 0;
      at_all = at_all || *side != 0;
    }
    if (!at_all) return std::nullopt;
    FacetPlane plane = signs_.Plane(triangle);
    const auto in_p = SupportingFeature(&signs_, &plane, Body::kP, triangle[0].p);
    if (!in_p) return std::nullopt;
    const auto in_q = SupportingFeature(&signs_, &plane, Body::kQ, triangle[0].q);
    if (!in_q) return std::nullopt;
    inside_shadow_ = inside_shadow_ || strictly;
    return ContactFacet{ClassOf(in_p->kind, in_q->kind), *in_p, *in_q, triangle};
  }

  void Measure() {
    MeasureEnd(&result_.enter, false);
    MeasureEnd(&result_.leave, false);
    // Where the line only touches M, rounding may have exchanged them.
    if (result_.enter.travel.value > result_.leave.travel.value) {
      if (signs_.exact_allowed()) {
        MeasureEnd(&result_.enter, true);
        MeasureEnd(&result_.leave, true);
      } else {
        std::swap(result_.enter.travel.value, result_.leave.travel.value);
        const double error = result_.leave.travel.value - result_.enter.travel.value;
        result_.enter.travel.error += error * (1.0 + kRoundingUnit);
        result_.leave.travel.error += error * (1.0 + kRoundingUnit);
      }
    }
  }

  // t = N.w / N.s for the facet's plane: w any of its points, the nearest to o best.
  void MeasureEnd(TravelEnd* end, bool exactly) {
    const auto& w = end->facet->triangle;
    const EstimateVector n = Cross(DifferenceOf(m_, w[1], w[0]), DifferenceOf(m_, w[2], w[0]));
    EstimateVector nearest = PointOf(m_, w[0]);
    for (int i = 1; i < 3; ++i) {
      const EstimateVector other = PointOf(m_, w[i]);
      if (internal::Values(other).squaredNorm() < internal::Values(nearest).squaredNorm())
        nearest = other;
    }
    const Estimate along = Dot(n, MakeEstimate(s_.scaled, 0x1p-1000));
    Estimate t = Dot(n, nearest) / along;
    // The facet's points move by no more than the coordinates do, and t by that over the cosine.
    const Eigen::Vector3d normal = internal::Values(n);
    const double cosine =
        std::abs(along.value) / (std::hypot(normal[0], normal[1], normal[2]) * s_.scaled.norm());
    double amplification = m_.size() / (cosine * s_.scaled.norm());
    if (signs_.exact_allowed()) {
      // Its sign is exact: that of the side of the plane that o is on.
      const auto inner = signs_.Determinant(w[0], w[1], w[2]);
      if (inner == 0) {
        end->travel = {0.0, 0.0, 1.0};
        return;
      }
      const bool tight = std::isfinite(amplification) &&
                         t.error <= kClaimPerCondition * std::max(amplification, std::abs(t.value));
      if (exactly || !tight || !(std::abs(t.value) > t.error)) {
        t = ExactTravel(w);
        amplification = ExactAmplification(w);
      }
    }
    const double condition = std::max(1.0, amplification / std::abs(t.value));
    // t is in scaled lengths over s_.scaled.
    const double unit = std::ldexp(1.0 / m_.scale(), -s_.exponent);
    end->travel = {t.value * unit, t.error * unit * (1.0 + 2.0 * kRoundingUnit),
                   std::isfinite(condition) ? condition : 1.0};
  }

  // N, N.w and N.s by big numbers, and so N.s.
  struct ExactPlane {
    DyadicVector normal;
    Dyadic height, along;
  };
  ExactPlane PlaneOf(const std::array<VertexPair, 3>& w) {
    signs_.CountExact();
    const ExactDifference& big = signs_.exact();
    const DyadicVector origin = big.Point(w[0]);
    ExactPlane plane;
    plane.normal = Cross(big.Point(w[1]) - origin, big.Point(w[2]) - origin);
    plane.height = Dot(plane.normal, origin);
    plane.along = Dot(plane.normal, s_.exact);
    return plane;
  }

  // Scaled as in MeasureEnd, rounded once: t of the caller, times the scale and 2^exponent.
  Estimate ExactTravel(const std::array<VertexPair, 3>& w) {
    const ExactPlane plane = PlaneOf(w);
    const Dyadic unit = Dyadic(std::ldexp(1.0, s_.exponent)) * Dyadic(m_.scale());
    const double value = RatioToDouble(plane.height * unit, plane.along * signs_.exact().factor());
    return {value, kRoundingUnit * std::abs(value)};
  }

  // size |N| / (N.s), s scaled.
  double ExactAmplification(const std::array<VertexPair, 3>& w) {
    const ExactPlane plane = PlaneOf(w);
    const Dyadic squared = Dot(plane.normal, plane.normal);
    int exponent_along = 0, exponent_squared = 0;
    const double along = plane.along.ToScaledDouble(&exponent_along);
    double length = squared.ToScaledDouble(&exponent_squared);
    if (exponent_squared % 2 != 0) {
      length *= 2.0;
      --exponent_squared;
    }
    const double component = std::ldexp(std::abs(along) / std::sqrt(length),
                                        exponent_along - exponent_squared / 2 - s_.exponent);
    return m_.size() / component;
  }

  MinkowskiDifference m_;
  Signs signs_;
  LineDirection s_;
  bool inside_shadow_ = false;
  DirectionalResult result_;
};

}  // namespace

namespace internal {

Status CheckDirection(const Eigen::Vector3d& s) {
  Status status;
  if (!s.allFinite()) {
    status.code = StatusCode::kNonFinite;
    status.message = "the direction is not finite";
    return status;
  }
  const double length = std::hypot(s[0], s[1], s[2]);
  if (!(length >= 1e-100 && length <= 1e100)) {
    status.code = StatusCode::kOutOfRange;
    status.message = "the direction's length is not within [1e-100, 1e100]";
  }
  return status;
}

}  // namespace internal

StatusOr<DirectionalResult> DirectionalDistance(const ConvexPolyhedron& p,
                                                const ConvexPolyhedron& q, const RelativePose& pose,
                                                const Eigen::Vector3d& s,
                                                const DirectionalOptions& options) {
  Status status = internal::CheckDirection(s);
  if (!status.ok()) return status;
  return DirectionalQuery(p, q, pose, s, options).Run();
}

}  // namespace touchstone
