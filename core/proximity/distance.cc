// SPDX-License-Identifier: MIT
#include "touchstone/core/proximity/distance.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "touchstone/core/cd_dual/cd_dual.h"
#include "touchstone/core/proximity/foot.h"
#include "touchstone/core/proximity/height_bound.h"
#include "touchstone/core/proximity/nearest_proof.h"

namespace touchstone {
namespace {

constexpr double kClaimPerCondition = 1e-12;  // the largest error claimed, per size

class DistanceQuery {
 public:
  DistanceQuery(const ConvexPolyhedron& p, const ConvexPolyhedron& q, const RelativePose& pose,
                const DistanceOptions& options, DistanceCache* cache)
      : m_(p, q, pose), signs_(m_, options.certainty), options_(options), cache_(cache) {}

  DistanceResult Run() {
    const NearestProposal proposal = SearchNearest(m_, StartFromCache(), &result_.counts);
    if (proposal.kind != NearestProposal::Kind::kNearest || !Settle(proposal.simplex)) {
      SettleByVerdict(proposal.simplex);
    }
    result_.exact_signs = signs_.exact_count();
    return result_;
  }

 private:
  // The cache may come from other bodies: of its vertices only those that exist are taken.
  Simplex StartFromCache() const {
    Simplex start;
    if (cache_ == nullptr) return start;
    for (int i = 0; i < cache_->simplex.size && i < 3; ++i) {
      const VertexPair& pair = cache_->simplex.points[i];
      if (pair.p >= 0 && pair.p < m_.p().vertex_count() && pair.q >= 0 &&
          pair.q < m_.q().vertex_count()) {
        start.points[start.size++] = pair;
      }
    }
    return start;
  }

  // Concludes if the simplex is proven to hold the nearest point.
  bool Settle(const Simplex& simplex) {
    const auto proof = ProveNearest(&signs_, simplex);
    if (!proof) return false;
    result_.kind = DistanceKind::kSeparate;
    result_.tier = signs_.exact_count() == 0 ? Tier::kBound : Tier::kExact;
    result_.optimal = true;
    result_.feature_p = proof->feature_p;
    result_.feature_q = proof->feature_q;
    Conclude(proof->simplex);
    return true;
  }

  // Three points counterclockwise seen from o, as far as doubles tell.
  Simplex TurnedOutward(Simplex simplex) const {
    if (simplex.size < 3) return simplex;
    const Eigen::Vector3d a = m_.Point(simplex.points[0]);
    if (signs_.Plane(simplex.points).normal.dot(a) > 0.0)
      std::swap(simplex.points[1], simplex.points[2]);
    return simplex;
  }

  void Conclude(const Simplex& simplex) {
    result_.simplex = simplex.points;
    result_.simplex_size = simplex.size;
    Measure(simplex, MeasureFoot(m_, simplex));
    if (result_.optimal && signs_.exact_allowed() && IsLoose())
      Measure(simplex, MeasureFootExactly(&signs_, simplex));
    if (cache_ != nullptr) cache_->simplex = simplex;
  }

  // In a direction that rounding turned, the bodies may not even be apart.
  bool IsLoose() const {
    const double most = kClaimPerCondition * m_.Unscale(m_.size());
    const BoundedValue& distance = result_.distance;
    return !(distance.value > 0.0) || !(distance.error <= most) || !(result_.point_error <= most) ||
           !(distance.value - result_.lower <= most);
  }

  void Measure(const Simplex& simplex, const Foot& foot) {
    result_.point_on_p = foot.on_p;
    result_.point_on_q = foot.on_q;
    result_.point_error = foot.on_error;
    result_.direction = foot.outward;
    // The bodies are apart by minus the height of M along a unit direction; the length of this one
    // is within 4 u of one.
    const double apart = -BoundHeight(m_, result_.direction, simplex.points[0]).height;
    result_.lower = apart > 0.0 ? m_.Unscale((1.0 - 8.0 * kRoundingUnit) * apart) : 0.0;
    const double size = m_.Unscale(m_.size());
    double value = foot.distance, error = foot.distance_error;
    if (result_.optimal) {
      result_.upper = (value + error) * (1.0 + 2.0 * kRoundingUnit);
    } else {
      // Some points of the bodies and some direction: what they prove by themselves.
      result_.upper = (foot.on_p - foot.on_q).norm() * (1.0 + 8.0 * kRoundingUnit) +
                      1.01 * (2.0 * foot.on_error + 8.0 * kRoundingUnit * size);
      value = std::clamp(value, result_.lower, std::max(result_.lower, result_.upper));
      error = std::max(value - result_.lower, result_.upper - value) * (1.0 + kRoundingUnit);
    }
    const double condition = std::max(1.0, size / value);
    result_.distance = {value, error, std::isfinite(condition) ? condition : 1.0};
  }

  // In doubles alone: some simplex, with the bounds that hold for it, if they show the bodies
  // apart.
  bool SettleByDirection(const Simplex& start) {
    const DistanceResult before = result_;
    Conclude(TurnedOutward(start));
    if (result_.lower > 0.0) {
      result_.kind = DistanceKind::kSeparate;
      result_.tier = Tier::kBound;
      return true;
    }
    result_ = before;
    return false;
  }

  // What the search could not settle: the verdict first, and for separate bodies the exact search.
  void SettleByVerdict(const Simplex& start) {
    if (!signs_.exact_allowed() && SettleByDirection(start)) return;
    const CollideResult verdict =
        Collide(m_.p(), m_.q(), m_.pose(), {.certainty = options_.certainty, .early_exit = true});
    result_.tier = verdict.tier;
    switch (verdict.verdict) {
      case Verdict::kTouch:
      case Verdict::kOverlap:
        result_.kind = DistanceKind::kMeet;
        result_.certificate = verdict.certificate;
        result_.interior_p = verdict.interior_p;
        result_.interior_q = verdict.interior_q;
        return;
      case Verdict::kUndecided:
        return;
      case Verdict::kSeparate:
        break;
    }
    result_.kind = DistanceKind::kSeparate;
    if (!signs_.exact_allowed()) return Conclude(TurnedOutward(start));
    const Simplex nearest = FindExactNearest(&signs_, start, &result_.counts);
    const bool settled = Settle(nearest);
    assert(settled);
    static_cast<void>(settled);
    result_.tier = Tier::kExact;
  }

  MinkowskiDifference m_;
  Signs signs_;
  const DistanceOptions& options_;
  DistanceCache* cache_;
  DistanceResult result_;
};

}  // namespace

DistanceResult Distance(const ConvexPolyhedron& p, const ConvexPolyhedron& q,
                        const RelativePose& pose, const DistanceOptions& options,
                        DistanceCache* cache) {
  return DistanceQuery(p, q, pose, options, cache).Run();
}

}  // namespace touchstone
