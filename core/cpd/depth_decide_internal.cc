// SPDX-License-Identifier: MIT
//
// Whether the nearest point of a piece is the answer.
#include <algorithm>
#include <cmath>

#include "touchstone/core/cpd/depth_searcher_internal.h"

namespace touchstone::internal {
namespace {

constexpr double kNameDistance = 0x1p-24;  // a name further off than this is not the point's
constexpr double kSameWay = 1.0 - 0x1p-40;

// Off the contacts that a point stands for, and off the origin, where that is another way.
class WaysOut {
 public:
  explicit WaysOut(const PointEstimate& point) {
    const Eigen::Vector3d away = point.at.stableNormalized();
    if (point.out.allFinite()) ways_[count_++] = point.out;
    if (away.allFinite() && !(point.out.dot(away) > kSameWay)) ways_[count_++] = away;
  }
  const Eigen::Vector3d* begin() const { return ways_; }
  const Eigen::Vector3d* end() const { return ways_ + count_; }

 private:
  Eigen::Vector3d ways_[2];
  int count_ = 0;
};

}  // namespace

using Eigen::Vector3d;

Verdict DepthSearcher::VerdictAt(const Vector3d& x) {
  ++result_.memberships;
  last_ = Membership(pair_, Vector3d(x / pair_.scale()), {Certainty::kFloat}, &s_.membership);
  return last_.verdict;
}

void DepthSearcher::TryRemembered() {
  if (!s_.answer || !IsNameOfPair(*s_.answer)) return;
  const auto point = EstimatePoint(pair_, *s_.answer);
  if (!point) return;
  const WaysOut ways(*point);
  answer_.was_warm = std::any_of(ways.begin(), ways.end(), [&](const Vector3d& out) {
    return IsOutside(*s_.answer, point->at + kStep * out);
  });
}

bool DepthSearcher::IsOutside(const ContactName& name, const Vector3d& x) {
  const Verdict verdict = VerdictAt(x);
  if (verdict == Verdict::kOverlap) AddWitness(x, last_.face_a, last_.face_b);
  if (verdict != Verdict::kSeparate) return false;
  if (x.norm() * kRoundUp < answer_.upper) Take(x, name);
  return true;
}

bool DepthSearcher::IsNameOfPair(const ContactName& name) const {
  const TriangleMesh &a = pair_.a().mesh, &b = pair_.b().mesh;
  const auto is_vertex = [&](const SumVertex& v) {
    return v.a >= 0 && v.a < a.vertex_count() && v.b >= 0 && v.b < b.vertex_count();
  };
  const auto is_facet = [&](const SumFacet& f) {
    const bool face_a = f.kind == SumFacetKind::kFaceVertex,
               face_b = f.kind == SumFacetKind::kVertexFace;
    const int count_a = face_a ? a.face_count() : face_b ? a.vertex_count() : a.edge_count();
    const int count_b = face_b ? b.face_count() : face_a ? b.vertex_count() : b.edge_count();
    return f.a >= 0 && f.a < count_a && f.b >= 0 && f.b < count_b;
  };
  if (name.is_vertex) return is_vertex(name.vertex);
  if (!is_facet(name.facet)) return false;
  for (int k = 0; k < name.wall_count; ++k) {
    const ContactWall& wall = name.walls[k];
    if (wall.is_edge ? !is_vertex(wall.from) || !is_vertex(wall.to) : !is_facet(wall.facet)) {
      return false;
    }
  }
  return true;
}

bool DepthSearcher::LookAt(const FacetPiece& piece) {
  const FacetFrame& frame = FrameOf(piece);
  if (IsBuried(frame, piece)) return false;
  if (piece.count >= kMaxPieceCorners - 1) {
    Halve(piece);
    return false;
  }
  const Vector3d x = frame.At(piece.nearest.at);
  if (piece.cuts < kMaxCuts && CutByKnown(piece, x)) return false;
  return Decide(piece, x);
}

bool DepthSearcher::Decide(const FacetPiece& piece, const Vector3d& x) {
  const ContactName name = NameOf(piece);
  const auto point = EstimatePoint(pair_, name);
  const bool is_near = point && (point->at - x).norm() < kNameDistance;
  const bool may_cut = piece.cuts < kMaxCuts;
  if (is_near) {
    for (const Vector3d& out : WaysOut(*point)) {
      if (IsOutside(name, point->at + kStep * out)) return found_ = true;
      if (may_cut && CutByKnown(piece, x)) return false;
    }
  }
  const Verdict verdict = VerdictAt(x);
  if (verdict == Verdict::kSeparate) {
    Take(x, name);
    return found_ = true;
  }
  if (verdict == Verdict::kOverlap && may_cut) {
    AddWitness(x, last_.face_a, last_.face_b);
    if (CutByKnown(piece, x)) return false;
    AddAllWitnesses(x);
    if (CutByKnown(piece, x)) return false;
  }
  if (is_near && options_.certainty == Certainty::kExact && IsOutsideExactly(name)) {
    return found_ = true;
  }
  LeaveOpen(piece, piece.distance);
  CutCrumb(piece);
  return false;
}

ContactName DepthSearcher::NameOf(const FacetPiece& piece) const {
  const MetFacet& facet = s_.facets[piece.facet];
  ContactName name;
  if (facet.is_vertex) {
    name.is_vertex = true;
    name.vertex = facet.vertex;
    return name;
  }
  name.facet = facet.frame.name;
  const SumCorners& corners = facet.frame.corners;
  for (int k = 0; k < piece.nearest.wall_count; ++k) {
    const int wall = piece.nearest.walls[k];
    if (wall == kNoWall) continue;
    ContactWall& out = name.walls[name.wall_count++];
    if (wall >= 0) {
      out.facet = FacetOf(pair_, s_.prisms.prism(wall / kPrismPlanes).name, wall % kPrismPlanes);
      OrientWall(s_.prisms.prism(wall / kPrismPlanes).normals[wall % kPrismPlanes], &out.facet);
    } else {
      const int side = -1 - wall;
      out.is_edge = true;
      out.from = corners.vertices[side];
      out.to = corners.vertices[(side + 1) % corners.count];
    }
  }
  if (name.wall_count == 2 && name.walls[0].is_edge && name.walls[1].is_edge) {
    // Two sides of the facet meet in a corner of it.
    const ContactWall &p = name.walls[0], &q = name.walls[1];
    name.is_vertex = true;
    name.vertex = p.from == q.from || p.from == q.to ? p.from : p.to;
  }
  return name;
}

void DepthSearcher::OrientWall(const Vector3d& normal, SumFacet* facet) const {
  if (facet->kind != SumFacetKind::kEdgeEdge) return;
  facet->is_along_cross = EstimatePlane(pair_, *facet).normal.dot(normal) > 0.0;
}

bool DepthSearcher::IsOutsideExactly(const ContactName& name) {
  const auto exact = ExactPointOf(pair_, name);
  if (!exact) return false;
  const auto [x, error] = Rounded(*exact);
  ++result_.exact_memberships;
  last_ = Membership(pair_, Translation(x, error, *exact), {Certainty::kExact}, &s_.membership);
  if (last_.verdict == Verdict::kOverlap) return false;
  const Vector3d scaled = x * pair_.scale();
  if (!(scaled.norm() < answer_.upper)) return true;
  Take(scaled, name);
  answer_.at_error = 2.0 * error * pair_.scale();
  answer_.is_exact = true;
  return true;
}

}  // namespace touchstone::internal
