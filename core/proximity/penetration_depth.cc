// SPDX-License-Identifier: MIT
#include "touchstone/core/proximity/penetration_depth.h"

#include <algorithm>
#include <cmath>

#include "touchstone/core/cd_dual/cd_dual.h"
#include "touchstone/core/cd_dual/certify.h"
#include "touchstone/core/cd_dual/exact_support.h"
#include "touchstone/core/cd_dual/portal.h"
#include "touchstone/core/proximity/foot.h"
#include "touchstone/core/proximity/height_bound.h"
#include "touchstone/core/proximity/signs_of_points.h"

namespace touchstone {
namespace {

constexpr double kClaimPerCondition = 1e-12;  // the largest error claimed, per size
// Rounds on a polytope from a cache, which may not be convex, before it is given up.
constexpr int kMaxWarmRounds = 64;
// Rounds in doubles alone, where rounding could go in circles.
constexpr int kMaxFloatRounds = 1 << 14;

// A facet of M that a triangle of the polytope lies in.
struct ProvenFacet {
  int triangle = -1;
  std::array<VertexPair, 3> corners;
  Feature feature_p, feature_q;
};

class PenetrationQuery {
 public:
  PenetrationQuery(const ConvexPolyhedron& p, const ConvexPolyhedron& q, const RelativePose& pose,
                   const PenetrationOptions& options, PenetrationCache* cache)
      : m_(p, q, pose),
        signs_(m_, options.certainty),
        options_(options),
        cache_(cache),
        polytope_(cache->polytope) {}

  PenetrationResult Run() {
    if (!RunWarm()) RunCold();
    if (result_.verdict == Verdict::kOverlap) {
      result_.interior_p = m_.interior_p();
      result_.interior_q = m_.interior_q();
      Conclude();
    }
    // A polytope that has grown over many poses costs more to take up than to grow again.
    if (result_.verdict != Verdict::kOverlap ||
        polytope_.triangle_count() > 2 * cache_->cold_triangles + 64) {
      cache_->Clear();
    }
    result_.exact_signs = signs_.exact_count();
    return std::move(result_);
  }

 private:
  bool RunWarm() {
    if (polytope_.empty()) return false;
    ChooseInteriorDifference(&m_);
    if (!polytope_.Refresh(&signs_) || !Grow(kMaxWarmRounds) || !HasFoot()) return false;
    result_.verdict = Verdict::kOverlap;
    result_.warm = true;
    return true;
  }

  void RunCold() {
    polytope_.Clear();
    best_ = {};
    ChooseInteriorDifference(&m_);
    const Proposal proposal = SearchPortal(m_, true, &result_.counts);
    bool started =
        proposal.kind == Proposal::Kind::kEnclosed && polytope_.Start(&signs_, proposal.triangle);
    if (!started) started = StartByVerdict();
    if (!started) return;
    result_.verdict = Verdict::kOverlap;
    Grow(options_.certainty == Certainty::kExact ? -1 : kMaxFloatRounds);
    cache_->cold_triangles = polytope_.triangle_count();
  }

  // What the verdict's own search says: its tetrahedron, or the answer that nothing is to be grown.
  bool StartByVerdict() {
    const CollideResult verdict =
        Collide(m_.p(), m_.q(), m_.pose(), {.certainty = options_.certainty});
    result_.verdict = verdict.verdict;
    result_.tier = verdict.tier;
    result_.interior_p = verdict.interior_p;
    result_.interior_q = verdict.interior_q;
    if (verdict.verdict == Verdict::kOverlap) {
      m_.ChooseInterior(verdict.interior_p, verdict.interior_q);
      if (polytope_.Start(&signs_, verdict.certificate.points)) return true;
      result_.verdict =
          Verdict::kUndecided;  // kFloat: a sign that the polytope rests on stayed open
      return false;
    }
    result_.certificate = verdict.certificate;
    if (verdict.verdict == Verdict::kTouch && verdict.face) {
      const ExitFace& face = *verdict.face;
      result_.facet = ContactFacet{face.face_class, face.feature_p, face.feature_q, face.triangle};
    }
    return false;
  }

  // Grows the polytope until its nearest triangle is part of a facet of M, in best_. `rounds`
  // bounds how often; negative: not. False if the bound was reached, or the polytope fell to
  // pieces.
  bool Grow(int rounds) {
    const double noise = 4.0 * InnerPolytope::DistanceError(m_);
    double limit = HUGE_VAL;
    for (;;) {
      const int triangle = polytope_.TakeNearest(limit);
      // Everything nearer than the best, or as near up to rounding, has been looked at.
      if (triangle < 0) return true;
      if (rounds-- == 0) return false;
      ++result_.counts.faces_visited;
      if (best_.triangle >= 0) {
        // In doubles alone, the first facet is as good as another that rounding cannot tell apart.
        if (!signs_.exact_allowed()) return true;
        if (IsNoNearer(polytope_.Corners(triangle))) continue;
      }
      const InnerPolytope::Triangle& t = polytope_.triangle(triangle);
      VertexPair beyond = m_.Support(t.normal, {}, &result_.counts);
      if (!polytope_.HasCorner(triangle, beyond)) {
        const auto sign = polytope_.IsBeyond(&signs_, triangle, beyond);
        if (sign && *sign > 0) {
          if (!polytope_.Expand(&signs_, triangle, beyond)) return !signs_.exact_allowed();
          continue;
        }
      }
      if (auto facet = ProveFacet(triangle)) {
        best_ = *facet;
        limit = t.distance + noise;
        continue;
      }
      if (!signs_.exact_allowed()) return true;  // as near as doubles can tell
      // Rounding has hidden what lies beyond.
      signs_.CountExact();
      const auto corners = polytope_.Corners(triangle);
      const ExactDifference& big = signs_.exact();
      const DyadicVector origin = big.Point(corners[0]);
      beyond = ExactSupport(big, m_,
                            Cross(big.Point(corners[1]) - origin, big.Point(corners[2]) - origin),
                            &result_.counts);
      const auto sign = polytope_.IsBeyond(&signs_, triangle, beyond);
      if (!sign || *sign <= 0 || !polytope_.Expand(&signs_, triangle, beyond)) return false;
    }
  }

  // Than best_: the other half of a parallelogram is in the same plane, without computing.
  bool IsNoNearer(const std::array<VertexPair, 3>& corners) {
    const auto in_plane = [&](VertexPair corner) {
      const auto& best = best_.corners;
      return CoplanarByIdentity(m_, {best[0], best[1], best[2], corner});
    };
    return std::all_of(corners.begin(), corners.end(), in_plane) ||
           CompareDistances(&signs_, corners, best_.corners) >= 0;
  }

  std::optional<ProvenFacet> ProveFacet(int triangle) {
    const auto corners = polytope_.Corners(triangle);
    for (const VertexPair& pair : corners) {
      if (pair.p < 0) return std::nullopt;
    }
    FacetPlane plane = signs_.Plane(corners);
    const auto in_p = SupportingFeature(&signs_, &plane, Body::kP, corners[0].p);
    if (!in_p) return std::nullopt;
    const auto in_q = SupportingFeature(&signs_, &plane, Body::kQ, corners[0].q);
    if (!in_q) return std::nullopt;
    return ProvenFacet{triangle, corners, *in_p, *in_q};
  }

  // Takes for best_ the triangle of its facet that holds the foot of o. The foot is in the facet,
  // as no facet is nearer; and in the polytope, or one of its triangles would be.
  bool HasFoot() {
    if (best_.triangle < 0) return false;
    const FacetPlane plane = signs_.Plane(best_.corners);
    if (HoldsFoot(plane, best_.corners)) return true;
    const double limit =
        polytope_.triangle(best_.triangle).distance + 4.0 * InnerPolytope::DistanceError(m_);
    int holder = -1;
    polytope_.ForEach([&](int i) {
      if (holder >= 0 || i == best_.triangle || polytope_.triangle(i).distance > limit) return;
      const auto corners = polytope_.Corners(i);
      for (const VertexPair& corner : corners) {
        if (Beyond(&signs_, best_.corners, corner) != 0) return;
      }
      if (HoldsFoot(plane, corners)) holder = i;
    });
    if (holder < 0) return false;
    best_.triangle = holder;
    best_.corners = polytope_.Corners(holder);
    return true;
  }

  bool HoldsFoot(const FacetPlane& plane, const std::array<VertexPair, 3>& corners) {
    for (int i = 0; i < 3; ++i) {
      const auto side = FootSide(&signs_, plane, corners[i], corners[(i + 1) % 3]);
      if (!side || *side < 0) return false;
    }
    return true;
  }

  void Conclude() {
    result_.tier = signs_.exact_count() == 0 ? Tier::kBound : Tier::kExact;
    const double least = polytope_.LeastDistance() - InnerPolytope::DistanceError(m_);
    result_.lower = least > 0.0 ? m_.Unscale(least) : 0.0;
    if (options_.certificate) {
      polytope_.ForEach([&](int i) { result_.inner_polytope.push_back(polytope_.Corners(i)); });
    }
    const bool has_foot = result_.warm || HasFoot();
    if (has_foot) {
      result_.facet = ContactFacet{ClassOf(best_.feature_p.kind, best_.feature_q.kind),
                                   best_.feature_p, best_.feature_q, best_.corners};
      result_.minimal = signs_.exact_allowed();
      const Simplex simplex{best_.corners, 3};
      Measure(MeasureFoot(m_, simplex));
      if (signs_.exact_allowed() && IsLoose()) Measure(MeasureFootExactly(&signs_, simplex));
      return;
    }
    MeasureUnproven();
  }

  bool IsLoose() const {
    const double most = kClaimPerCondition * m_.Unscale(m_.size());
    return !(result_.depth.value > 0.0) || !(result_.depth.error <= most) ||
           !(result_.translation_error <= most) || !(result_.point_error <= most) ||
           !(result_.upper - result_.depth.value <= most);
  }

  double UpperAlong(const Eigen::Vector3d& unit, VertexPair support) const {
    // The length of the direction is within 4 u of one.
    return m_.Unscale(BoundHeight(m_, unit, support).height) * (1.0 + 8.0 * kRoundingUnit);
  }

  void Measure(const Foot& foot) {
    result_.translation = foot.point;
    result_.translation_error = foot.point_error;
    result_.direction = foot.outward;
    result_.point_on_p = foot.on_p;
    result_.point_on_q = foot.on_q;
    result_.point_error = foot.on_error;
    result_.upper = UpperAlong(foot.outward, best_.corners[0]);
    const double condition = std::max(1.0, m_.Unscale(m_.size()) / foot.distance);
    result_.depth = {foot.distance, foot.distance_error,
                     std::isfinite(condition) ? condition : 1.0};
  }

  // In doubles alone, without a proven facet: the bounds are all there is.
  void MeasureUnproven() {
    int nearest = -1;
    polytope_.ForEach([&](int i) {
      if (nearest < 0 || polytope_.triangle(i).distance < polytope_.triangle(nearest).distance)
        nearest = i;
    });
    const InnerPolytope::Triangle& t = polytope_.triangle(nearest);
    const Eigen::Vector3d normal = t.normal / t.length;
    result_.direction = normal / normal.norm();
    const VertexPair support = m_.Support(result_.direction, {}, &result_.counts);
    result_.upper = std::max(UpperAlong(result_.direction, support), result_.lower);
    const double value = result_.upper;
    const double error = (result_.upper - result_.lower) * (1.0 + kRoundingUnit);
    const double condition = std::max(1.0, m_.Unscale(m_.size()) / value);
    result_.depth = {value, error, std::isfinite(condition) ? condition : 1.0};
    // Q moved by the height of M along a direction is out of P, and just so if the facet is the
    // nearest.
    result_.translation = value * result_.direction;
    result_.translation_error = m_.Unscale(m_.size());
    result_.point_error = m_.Unscale(m_.size());
    result_.point_on_p = m_.PointOfP(support.p);
    result_.point_on_q = result_.point_on_p - result_.translation;
  }

  MinkowskiDifference m_;
  Signs signs_;
  const PenetrationOptions& options_;
  PenetrationCache* cache_;
  InnerPolytope& polytope_;
  ProvenFacet best_;
  PenetrationResult result_;
};

}  // namespace

PenetrationResult PenetrationDepth(const ConvexPolyhedron& p, const ConvexPolyhedron& q,
                                   const RelativePose& pose, const PenetrationOptions& options,
                                   PenetrationCache* cache) {
  PenetrationCache own;
  return PenetrationQuery(p, q, pose, options, cache != nullptr ? cache : &own).Run();
}

}  // namespace touchstone
