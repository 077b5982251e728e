// SPDX-License-Identifier: MIT
#include "touchstone/core/cd_dual/cd_dual.h"

#include <cmath>

#include "touchstone/core/cd_dual/certify.h"
#include "touchstone/core/cd_dual/common_point.h"
#include "touchstone/core/cd_dual/enclosure.h"
#include "touchstone/core/cd_dual/exact_portal.h"
#include "touchstone/core/cd_dual/face_of_m.h"
#include "touchstone/core/cd_dual/measure.h"
#include "touchstone/core/cd_dual/phased.h"
#include "touchstone/core/cd_dual/portal.h"
#include "touchstone/core/cd_dual/published.h"

namespace touchstone {
namespace {

class Query {
 public:
  Query(const ConvexPolyhedron& p, const ConvexPolyhedron& q, const RelativePose& pose,
        const CollideOptions& options, CollideCache* cache, CollideResult* result)
      : result_(*result),
        m_(p, q, pose),
        signs_(m_, options.certainty),
        options_(options),
        cache_(options.search == Search::kPortal ? cache : nullptr),
        log_{&result_.counts, options.trace ? &result_.trace : nullptr} {}

  void Run() {
    if (cache_ != nullptr && AnswerWarm()) {
      Finish();
      return;
    }
    const bool apart = ChooseInteriorDifference(&m_);
    if (!apart && options_.early_exit && options_.search != Search::kPublished &&
        FindCoincidence()) {
      Finish();
      return;
    }
    if (options_.search == Search::kPublished) {
      RunPublished();
      Finish();
      return;
    }
    RunProven();
    // In doubles, a ray through an edge of M leaves signs open that another ray may not meet.
    const int chosen_p = m_.interior_p(), chosen_q = m_.interior_q();
    for (int k = 1; k < 4 && result_.verdict == Verdict::kUndecided; ++k) {
      m_.ChooseInterior((chosen_p + k) % 2, (chosen_q + k / 2) % 2);
      if (m_.c_norm() <= m_.coordinate_error()) continue;
      result_ = CollideResult{};
      RunProven();
    }
    Finish();
  }

 private:
  bool AnswerWarm() {
    if (options_.early_exit) return AnswerFromCache(&m_, &signs_, cache_, &result_);
    return KeepsExitFace();
  }

  // The last exit facet may still be the one, for the same c.
  bool KeepsExitFace() {
    ChooseInteriorDifference(&m_);
    if (!HoldsTriangle(m_, *cache_) || cache_->interior_p != m_.interior_p() ||
        cache_->interior_q != m_.interior_q()) {
      return false;
    }
    std::array<VertexPair, 3> triangle;
    for (int i = 0; i < 3; ++i) triangle[i] = m_.Vertices(cache_->triangle[i]);
    if (!ConcludeFacet(triangle) || result_.verdict == Verdict::kUndecided) {
      result_ = CollideResult{};
      return false;
    }
    result_.phase = Phase::kCache;
    ReportFinalClass();
    return true;
  }

  // What the next query may begin with.
  void Remember(const Proposal& proposal) {
    if (cache_ == nullptr) return;
    cache_->has_direction = !proposal.has_triangle && result_.verdict == Verdict::kSeparate;
    cache_->direction = proposal.direction;
    cache_->support = proposal.support;
    cache_->has_triangle = proposal.has_triangle;
    cache_->triangle = proposal.corners;
    cache_->interior_p = m_.interior_p();
    cache_->interior_q = m_.interior_q();
  }

  void Finish() {
    result_.interior_p = m_.interior_p();
    result_.interior_q = m_.interior_q();
    result_.interior_difference = m_.Unscale(m_.c());
    result_.exact_signs = signs_.exact_count();
    if (options_.common_point) {
      result_.common_point = FindCommonPoint(&signs_, result_.certificate);
    }
    for (TraceStep& step : result_.trace) step.signed_distance *= m_.scale();
  }

  // c = o proves overlap outright, for any choice of c.
  bool FindCoincidence() {
    const int chosen_p = m_.interior_p(), chosen_q = m_.interior_q();
    for (int i = 0; i < 2; ++i) {
      for (int j = 0; j < 2; ++j) {
        m_.ChooseInterior(i, j);
        if (m_.c().cwiseAbs().maxCoeff() > m_.coordinate_error()) continue;
        const long before = signs_.exact_count();
        bool zero = true;
        for (int axis = 0; axis < 3 && zero; ++axis) {
          zero = signs_.AlongDirection(Eigen::Vector3d::Unit(axis), kInteriorDifference) == 0;
        }
        if (zero) {
          result_.verdict = Verdict::kOverlap;
          result_.certificate.kind = CertificateKind::kCoincidentInterior;
          result_.tier = signs_.exact_count() == before ? Tier::kBound : Tier::kExact;
          result_.phase = Phase::kStart;
          result_.termination = Termination::kCoincident;
          return true;
        }
      }
    }
    m_.ChooseInterior(chosen_p, chosen_q);
    return false;
  }

  void RunProven() { options_.search == Search::kPhased ? RunPhased() : RunPortal(); }

  void RunPortal() {
    result_.phase = Phase::kPortal;
    const bool is_warm = cache_ != nullptr && HoldsTriangle(m_, *cache_);
    Proposal proposal = SearchPortal(m_, options_.early_exit, &log_.of(Phase::kPortal),
                                     is_warm ? &cache_->triangle : nullptr);
    Settle(&proposal);
    Remember(proposal);
    ReportFinalClass();
  }

  void RunPhased() {
    PhasedOutcome outcome = SearchPhased(m_, options_.early_exit, &log_);
    result_.phase = outcome.phase;
    for (int i = 0; i < 3; ++i) Report(i, outcome.ran[i], outcome.best[i]);
    Settle(&outcome.proposal);
    ReportFinalClass();
  }

  void RunPublished() {
    const PublishedOutcome outcome = SearchPublished(m_, options_.early_exit, &log_);
    result_.phase = outcome.phase;
    result_.termination = outcome.stopped_early ? Termination::kEarlyExit : Termination::kOptimal;
    result_.verdict = outcome.face.signed_distance > 0.0 ? Verdict::kSeparate : Verdict::kOverlap;
    for (int i = 0; i < 3; ++i) Report(i, outcome.ran[i], outcome.best[i]);
    const auto polygon = Polygon(m_, outcome.face);
    const auto crossed = CrossedTriangle(m_, polygon, nullptr);
    const auto triangle =
        crossed.value_or(std::array<VertexPair, 3>{polygon[0], polygon[1], polygon[2]});
    result_.face =
        ExitFace{outcome.face.face_class, outcome.face.feature_p, outcome.face.feature_q, triangle};
    if (!outcome.stopped_early) MeasureExit(&signs_, triangle, &result_);
  }

  void Report(int phase, bool ran, const std::optional<FaceOfM>& best) {
    PhaseReport& report = result_.phases[phase];
    if (!ran) return;
    report.claim = best ? PhaseClaim::kLocal : PhaseClaim::kEmpty;
    if (best) {
      report.face_class = best->face_class;
      report.feature_p = best->feature_p;
      report.feature_q = best->feature_q;
      report.signed_distance = best->signed_distance * m_.scale();
    }
  }

  // The exit face maximises d over all of M, hence over its class.
  void ReportFinalClass() {
    if (!result_.face || !result_.signed_distance) return;
    const ExitFace& face = *result_.face;
    const int phase = static_cast<int>(face.face_class);
    if (phase > static_cast<int>(FaceClass::kEdgeEdge)) return;
    result_.phases[phase] = {PhaseClaim::kMaximum, face.face_class, face.feature_p, face.feature_q,
                             result_.signed_distance->value};
  }

  // Proves what a search proposes, or finds what is true instead.
  void Settle(Proposal* proposed) {
    const Proposal& proposal = *proposed;
    using Kind = Proposal::Kind;
    if (proposal.kind == Kind::kApartByBounds) {
      result_.phase = Phase::kStart;
      return ConcludeApart(proposal.direction, Tier::kBound);
    }
    if (proposal.kind == Kind::kSeparatingDirection) {
      if (ConcludeSeparate(proposal.direction, &proposed->support)) return;
    } else if (proposal.kind == Kind::kEnclosed) {
      if (IsClearlyEnclosing(m_, proposal.points)) {
        return ConcludeOverlap(proposal.triangle, Tier::kBound);
      }
      if (ConcludeEnclosed(proposal.triangle)) return;
    } else if (proposal.kind == Kind::kExitFacet) {
      if (ConcludeFacet(proposal.triangle)) return;
    }
    const bool was_final = proposal.kind == Kind::kExitFacet;
    SettleWithoutHint(was_final && options_.search == Search::kPortal
                          ? proposal
                          : SearchPortal(m_, false, &log_.of(Phase::kPortal)),
                      was_final && options_.search == Search::kPortal);
  }

  // `full` ran to the end in doubles. When it cannot be proven, exact signs finish it.
  void SettleWithoutHint(const Proposal& full, bool already_tried) {
    const bool has_triangle = full.kind == Proposal::Kind::kExitFacet;
    if (has_triangle && !already_tried && ConcludeFacet(full.triangle)) {
      result_.phase = Phase::kPortal;
      return;
    }
    if (!signs_.exact_allowed()) {
      if (has_triangle) ConcludeVerdictAlone(full.triangle);
      return;
    }
    result_.phase = Phase::kExact;
    const auto start = has_triangle ? full.triangle : std::array<VertexPair, 3>{};
    const ExactExit exit = FindExactExit(&signs_, start, &log_.of(Phase::kExact));
    result_.face = ProveExitFace(&signs_, exit.triangle);
    Conclude(exit.triangle, exit.side_of_origin);
    result_.tier = Tier::kExact;
  }

  bool ConcludeSeparate(const Eigen::Vector3d& direction, CornerPair* support) {
    const auto tier = ProveSeparatingDirection(&signs_, direction, support);
    if (!tier) return false;
    ConcludeApart(direction, *tier);
    return true;
  }

  void ConcludeApart(const Eigen::Vector3d& direction, Tier tier) {
    result_.verdict = Verdict::kSeparate;
    result_.tier = tier;
    result_.termination = Termination::kEarlyExit;
    result_.certificate = {CertificateKind::kSeparatingDirection, direction, {}};
  }

  bool ConcludeEnclosed(const std::array<VertexPair, 3>& triangle) {
    const auto tier = ProveEnclosingTetrahedron(&signs_, triangle);
    if (!tier) return false;
    ConcludeOverlap(triangle, *tier);
    return true;
  }

  void ConcludeOverlap(const std::array<VertexPair, 3>& triangle, Tier tier) {
    result_.verdict = Verdict::kOverlap;
    result_.tier = tier;
    result_.termination = Termination::kEarlyExit;
    result_.certificate = {CertificateKind::kEnclosingTetrahedron, Eigen::Vector3d::Zero(),
                           triangle};
  }

  // A triangle proven to be part of the exit facet decides by the side of its plane that o is on.
  bool ConcludeFacet(const std::array<VertexPair, 3>& triangle) {
    auto face = ProveExitFace(&signs_, triangle);
    if (!face) return false;
    result_.face = std::move(face);
    const auto side = signs_.Determinant(triangle[0], triangle[1], triangle[2]);
    if (side) {
      Conclude(triangle, *side);
    } else if (!options_.early_exit) {
      MeasureExit(&signs_, triangle, &result_);
    }
    return true;
  }

  void Conclude(const std::array<VertexPair, 3>& triangle, int side_of_origin) {
    result_.termination = Termination::kOptimal;
    result_.tier = signs_.exact_count() == 0 ? Tier::kBound : Tier::kExact;
    result_.certificate.points = triangle;
    if (side_of_origin > 0) {
      result_.verdict = Verdict::kOverlap;
      result_.certificate.kind = CertificateKind::kEnclosingTetrahedron;
    } else if (side_of_origin < 0) {
      result_.verdict = Verdict::kSeparate;
      result_.certificate.kind = CertificateKind::kSeparatingFacet;
    } else {
      result_.verdict = Verdict::kTouch;
      result_.certificate.kind = CertificateKind::kTouchingFacet;
    }
    if (!options_.early_exit) MeasureExit(&signs_, triangle, &result_);
  }

  // kFloat, when a tie hides the facet: the verdict may still be certain.
  void ConcludeVerdictAlone(const std::array<VertexPair, 3>& triangle) {
    if (ConcludeEnclosed(triangle)) return;
    const auto other = FindClearEnclosure(&signs_, triangle, &log_.of(Phase::kPortal));
    if (other && ConcludeEnclosed(*other)) return;
    const Eigen::Vector3d normal = signs_.Plane(triangle).normal;
    CornerPair support = m_.Corners(m_.Support(normal, triangle[0], &log_.of(Phase::kPortal)));
    ConcludeSeparate(normal, &support);
  }

  CollideResult& result_;
  MinkowskiDifference m_;
  Signs signs_;
  const CollideOptions& options_;
  CollideCache* const cache_;
  SearchLog log_;
};

}  // namespace

CollideResult Collide(const ConvexPolyhedron& p, const ConvexPolyhedron& q,
                      const RelativePose& pose, const CollideOptions& options,
                      CollideCache* cache) {
  p.Prefetch();
  q.Prefetch();
  CollideResult result;
  Query(p, q, pose, options, cache, &result).Run();
  return result;
}

}  // namespace touchstone
