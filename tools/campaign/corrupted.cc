// SPDX-License-Identifier: MIT
//
// A judge that finds nothing may be blind. Here one thing is broken in a result of ours that the
// judge let stand; a finding is that the judge did not see it.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "touchstone/tools/campaign/contestant.h"

namespace touchstone {
namespace {

// Each breaks a result for certain, or says that it cannot (false).
using Break = bool (*)(CollideResult&, const PlacedPair&);

bool OtherVerdict(CollideResult& result, const PlacedPair&) {
  result.verdict = result.verdict == Verdict::kSeparate ? Verdict::kOverlap : Verdict::kSeparate;
  return true;
}

bool SaysUndecided(CollideResult& result, const PlacedPair&) {
  result.verdict = Verdict::kUndecided;
  return true;
}

bool NoCertificate(CollideResult& result, const PlacedPair&) {
  result.certificate.kind = CertificateKind::kNone;
  return true;
}

bool DirectionReversed(CollideResult& result, const PlacedPair&) {
  if (result.certificate.kind != CertificateKind::kSeparatingDirection) return false;
  result.certificate.direction = -result.certificate.direction;
  return true;
}

bool DirectionNotANumber(CollideResult& result, const PlacedPair&) {
  if (result.certificate.kind != CertificateKind::kSeparatingDirection) return false;
  result.certificate.direction[1] = std::nan("");
  return true;
}

bool ProofCollapsed(CollideResult& result, const PlacedPair&) {
  switch (result.certificate.kind) {
    case CertificateKind::kEnclosingTetrahedron:
    case CertificateKind::kSeparatingFacet:
    case CertificateKind::kTouchingFacet:
      result.certificate.points[1] = result.certificate.points[0];
      return true;
    default:
      return false;
  }
}

bool FacetReversed(CollideResult& result, const PlacedPair&) {
  switch (result.certificate.kind) {
    case CertificateKind::kSeparatingFacet:
    case CertificateKind::kTouchingFacet:
      std::swap(result.certificate.points[0], result.certificate.points[1]);
      return true;
    default:
      return false;
  }
}

// Whether the plane through a vertex of P across n has vertices of P on both sides, clearly.
bool Cuts(const ConvexPolyhedron& p, int vertex, const Eigen::Vector3d& n) {
  const double clear = 1e-6 * n.norm() * p.max_coordinate();
  bool above = false, below = false;
  for (int v = 0; v < p.vertex_count(); ++v) {
    const double height = n.dot(p.vertex(v) - p.vertex(vertex));
    above |= height > clear;
    below |= height < -clear;
  }
  return above && below;
}

// Where bodies touch in two vertices, o is a corner of any triangle with that point of M: here of
// one whose plane cuts M.
bool PlaneThroughM(CollideResult& result, const PlacedPair& pair) {
  if (result.certificate.kind != CertificateKind::kTouchingFacet) return false;
  const auto place = [&](int q) -> Eigen::Vector3d {
    return pair.pose.rotation() * pair.q.vertex(q) + pair.pose.translation();
  };
  for (const VertexPair point : result.certificate.points) {
    if (point.p < 0 || point.q < 0 || pair.p.vertex(point.p) != place(point.q)) continue;
    const int next_p = pair.p.vertex_neighbors(point.p)[0];
    for (const int next_q : pair.q.vertex_neighbors(point.q)) {
      const Eigen::Vector3d n =
          (pair.p.vertex(next_p) - pair.p.vertex(point.p)).cross(place(point.q) - place(next_q));
      if (!Cuts(pair.p, point.p, n)) continue;
      result.certificate.points = {point, {next_p, point.q}, {point.p, next_q}};
      return true;
    }
  }
  return false;
}

bool ProofOutOfRange(CollideResult& result, const PlacedPair& pair) {
  if (result.certificate.kind != CertificateKind::kEnclosingTetrahedron) return false;
  result.certificate.points[2].q = pair.q.vertex_count();
  return true;
}

bool ExitFaceCollapsed(CollideResult& result, const PlacedPair&) {
  if (!result.face) return false;
  result.face->triangle[2] = result.face->triangle[1];
  return true;
}

// A class of other dimensions than those of the features named.
bool OtherClass(CollideResult& result, const PlacedPair&) {
  if (!result.face) return false;
  result.face->face_class = result.face->face_class == FaceClass::kVertexFace
                                ? FaceClass::kFaceVertex
                                : FaceClass::kVertexFace;
  return true;
}

void MoveBeyondError(BoundedValue& value) {
  value.value += 4.0 * value.error + 1e-3 * std::fabs(value.value) + 1e-120;
}

bool DistanceMoved(CollideResult& result, const PlacedPair&) {
  if (!result.signed_distance) return false;
  MoveBeyondError(*result.signed_distance);
  return true;
}

bool TravelMoved(CollideResult& result, const PlacedPair&) {
  if (!result.exit_travel) return false;
  MoveBeyondError(*result.exit_travel);
  return true;
}

bool BoundLoosened(CollideResult& result, const PlacedPair&) {
  if (!result.exit_travel || result.exit_travel->value == 0.0) return false;
  result.exit_travel->error += result.exit_travel->condition * std::fabs(result.exit_travel->value);
  return std::isfinite(result.exit_travel->error);
}

bool ExitPointMoved(CollideResult& result, const PlacedPair& pair) {
  if (!result.exit_point) return false;
  (*result.exit_point)[0] += 4.0 * result.exit_point_error +
                             1e-3 * std::max(pair.p.max_coordinate(), pair.q.max_coordinate());
  return true;
}

bool InteriorMoved(CollideResult& result, const PlacedPair& pair) {
  result.interior_difference[2] += std::max(pair.p.max_coordinate(), pair.q.max_coordinate());
  return true;
}

bool ExitWithoutLeave(CollideResult& result, const PlacedPair&) {
  if (result.termination != Termination::kOptimal) return false;
  result.termination = Termination::kEarlyExit;
  return true;
}

bool NegativeCount(CollideResult& result, const PlacedPair&) {
  result.counts[static_cast<std::size_t>(Phase::kPortal)].support_calls = -1;
  return true;
}

struct NamedBreak {
  const char* name;
  Break apply;
  bool early_exit = false;  // of a result that is asked for so: it holds a separating direction
};
constexpr std::array<NamedBreak, 18> kBreaks = {{
    {"other_verdict", OtherVerdict},
    {"says_undecided", SaysUndecided},
    {"no_certificate", NoCertificate},
    {"direction_reversed", DirectionReversed, true},
    {"direction_not_a_number", DirectionNotANumber, true},
    {"proof_collapsed", ProofCollapsed},
    {"facet_reversed", FacetReversed},
    {"plane_through_m", PlaneThroughM},
    {"proof_out_of_range", ProofOutOfRange},
    {"exit_face_collapsed", ExitFaceCollapsed},
    {"other_class", OtherClass},
    {"distance_moved", DistanceMoved},
    {"travel_moved", TravelMoved},
    {"bound_loosened", BoundLoosened},
    {"exit_point_moved", ExitPointMoved},
    {"interior_moved", InteriorMoved},
    {"exit_without_leave", ExitWithoutLeave},
    {"negative_count", NegativeCount},
}};

class Corrupted : public Contestant {
 public:
  Corrupted() : Contestant("corrupted", true) {}

  std::vector<NamedFinding> Ask(const CampaignQuery& query, EngineTally& tally) override {
    const PlacedPair& pair = query.pair();
    // Mixed, so that no error keeps to one of the placements, which come in turn.
    const std::uint64_t draw = query.index() * 0x9e3779b97f4a7c15u >> 32;
    const NamedBreak& planted = kBreaks[draw % kBreaks.size()];
    CollideResult result = Collide(pair.p, pair.q, pair.pose, {.early_exit = planted.early_exit});
    if (!planted.apply(result, pair)) {
      tally.Count("not planted");
      return {};
    }
    tally.Count(std::string("planted ") + planted.name);
    const bool seen =
        !exact::Judge(query.bodies().Get(pair.p), query.bodies().Get(pair.q), pair.pose, result,
                      {.early_exit = planted.early_exit, .check_phase_maxima = false})
             .empty();
    if (seen) return {};
    return {{"missed_error", std::string("the judge lets stand: ") + planted.name}};
  }
};

}  // namespace

std::unique_ptr<Contestant> MakeCorrupted() { return std::make_unique<Corrupted>(); }

}  // namespace touchstone
