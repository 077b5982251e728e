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
  using Growth = InnerPolytope::Growth;

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
    const int chosen_p = m_.interior_p(), chosen_q = m_.interior_q();
    bool started = StartFromHere(true);
    // A direction that seems to separate ends the search early; near contact it may not.
    if (!started) started = StartFromHere(false);
    // A ray that runs through an edge of M leaves signs open that another ray does not meet.
    for (int k = 1; k < 4 && !started && !is_apart_; ++k) {
      m_.ChooseInterior((chosen_p + k) % 2, (chosen_q + k / 2) % 2);
      started = m_.c_norm() > m_.coordinate_error() && StartFromHere(true);
    }
    if (!started) {
      m_.ChooseInterior(chosen_p, chosen_q);
      started = StartByVerdict();
      if (result_.verdict == Verdict::kUndecided) started = StartFromSupports();
    }
    if (!started) return;
    result_.verdict = Verdict::kOverlap;
    Grow(options_.certainty == Certainty::kExact ? -1 : kMaxFloatRounds);
    cache_->cold_triangles = polytope_.triangle_count();
  }

  // The tetrahedron that the verdict's search ends with, if o is in it.
  bool StartFromHere(bool early_exit) {
    const Proposal proposal = SearchPortal(m_, early_exit, &result_.counts);
    is_apart_ = proposal.kind == Proposal::Kind::kSeparatingDirection ||
                proposal.kind == Proposal::Kind::kApartByBounds;
    // What it could not tell, that of o, is for `Start` to tell.
    return (proposal.kind == Proposal::Kind::kEnclosed ||
            proposal.kind == Proposal::Kind::kExitFacet) &&
           polytope_.Start(&signs_, proposal.triangle);
  }

  // In doubles alone, where ties on every ray from c hide the verdict: supports all around o may
  // still hold it. Along the axes of P, and of a frame that no symmetry shares.
  bool StartFromSupports() {
    Eigen::Matrix3d aside;
    aside << 0.36, 0.48, -0.8, -0.8, 0.6, 0.0, 0.48, 0.64, 0.6;
    return polytope_.StartFromSupports(&signs_, Eigen::Matrix3d::Identity(), &result_.counts) ||
           polytope_.StartFromSupports(&signs_, aside, &result_.counts);
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
      const Eigen::Vector3d normal = polytope_.triangle(triangle).normal;
      const VertexPair support = m_.Support(normal, {}, &result_.counts);
      Growth growth = Growth::kNotBeyond;
      if (!polytope_.HasCorner(triangle, support))
        growth = polytope_.Expand(&signs_, triangle, support);
      if (growth == Growth::kNotBeyond) {
        if (auto facet = ProveFacet(triangle)) {
          best_ = *facet;
          limit = polytope_.triangle(triangle).distance + noise;
          continue;
        }
        if (signs_.exact_allowed()) growth = ExpandExactly(triangle);
      }
      // In doubles alone, as near as they can tell.
      if (growth != Growth::kGrown) return !signs_.exact_allowed();
    }
  }

  // Over what rounding has hidden.
  Growth ExpandExactly(int triangle) {
    signs_.CountExact();
    const auto corners = polytope_.Corners(triangle);
    const ExactDifference& big = signs_.exact();
    const DyadicVector origin = big.Point(corners[0]);
    const DyadicVector normal =
        Cross(big.Point(corners[1]) - origin, big.Point(corners[2]) - origin);
    return polytope_.Expand(&signs_, triangle, ExactSupport(big, m_, normal, &result_.counts));
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
      // Rounding made up what looks nearer than the nearest facet.
      polytope_.Sharpen(&signs_,
                        m_.scale() * result_.depth.value - 0.25 * kClaimPerCondition * m_.size());
      SetLower();
      return;
    }
    SetLower();
    MeasureUnproven();
  }

  void SetLower() {
    const double least = polytope_.LeastDistance() - InnerPolytope::DistanceError(m_);
    result_.lower = !polytope_.empty() && least > 0.0 ? m_.Unscale(least) : 0.0;
  }

  bool IsLoose() const {
    const double most = kClaimPerCondition * m_.Unscale(m_.size());
    return !(result_.depth.value > 0.0) || !(result_.depth.error <= most) ||
           !(result_.foot_error <= most) || !(result_.point_error <= most) ||
           !(result_.upper - result_.depth.value <= most);
  }

  double UpperAlong(const Eigen::Vector3d& unit, VertexPair support) const {
    // The length of the direction is within 4 u of one.
    return m_.Unscale(BoundHeight(m_, unit, support).height) * (1.0 + 8.0 * kRoundingUnit);
  }

  void Measure(const Foot& foot) {
    result_.translation = foot.point;
    result_.foot_error = foot.point_error;
    result_.direction = foot.outward;
    result_.point_on_p = foot.on_p;
    result_.point_on_q = foot.on_q;
    result_.point_error = foot.on_error;
    result_.upper = UpperAlong(foot.outward, best_.corners[0]);
    const double condition = std::max(1.0, m_.Unscale(m_.size()) / foot.distance);
    result_.depth = {foot.distance, foot.distance_error,
                     std::isfinite(condition) ? condition : 1.0};
  }

  // In doubles alone, without a proven facet: the bounds are all there is. The direction is that of
  // the nearest triangle, or without a polytope the best of the axes.
  void MeasureUnproven() {
    result_.upper = HUGE_VAL;
    const auto consider = [&](const Eigen::Vector3d& direction) {
      if (!direction.allFinite()) return;
      const VertexPair support = m_.Support(direction, {}, &result_.counts);
      const double upper = UpperAlong(direction, support);
      if (!(upper < result_.upper)) return;
      result_.upper = upper;
      result_.direction = direction;
      result_.point_on_p = m_.PointOfP(support.p);
    };
    int nearest = -1;
    polytope_.ForEach([&](int i) {
      if (nearest < 0 || polytope_.triangle(i).distance < polytope_.triangle(nearest).distance)
        nearest = i;
    });
    if (nearest >= 0) {
      const Eigen::Vector3d& normal = polytope_.triangle(nearest).normal;
      const Eigen::Vector3d scaled = normal / normal.cwiseAbs().maxCoeff();
      consider(scaled / scaled.norm());
    }
    for (int k = 0; k < 3; ++k) {
      consider(Eigen::Vector3d::Unit(k));
      consider(-Eigen::Vector3d::Unit(k));
    }
    result_.upper = std::max(result_.upper, result_.lower);
    const double value = result_.upper;
    const double error = (result_.upper - result_.lower) * (1.0 + kRoundingUnit);
    const double condition = std::max(1.0, m_.Unscale(m_.size()) / value);
    result_.depth = {value, error, std::isfinite(condition) ? condition : 1.0};
    // Q moved by the height of M along a direction is out of P.
    result_.translation = value * result_.direction;
    result_.foot_error = m_.Unscale(m_.size());
    result_.point_error = m_.Unscale(m_.size());
    result_.point_on_q = result_.point_on_p - result_.translation;
  }

  MinkowskiDifference m_;
  Signs signs_;
  const PenetrationOptions& options_;
  PenetrationCache* cache_;
  InnerPolytope& polytope_;
  ProvenFacet best_;
  bool is_apart_ = false;  // a search in doubles says so
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
