// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/gap_filling_internal.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>

namespace touchstone::internal {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Poses may be off orthonormal by 1e-6 in each entry of RᵀR: such a matrix is within 1.6e-6 of a
// rotation in every direction, and one made of two world poses within twice that.
constexpr double kOffRotation = 3.2e-6;
// Unit vectors made of roundings, and of placed points, are off by less where they are trusted.
constexpr double kSlack = 1e-9;
// A padding that lasts for so many steps like the last one, if it stays below this part of the
// ball's radius; else one that lasts for as many as it may, or none.
constexpr double kSteps = 16.0, kLargestPart = 0.2;

}  // namespace

GapFiller::GapFiller(const TriangleMesh& b) {
  Vector3d low = b.vertex(0), high = low;
  for (const Vector3d& v : b.vertices()) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  middle_of_b_ = 0.5 * low + 0.5 * high;
  radius_of_b_ = 0.0;
  for (const Vector3d& v : b.vertices()) {
    radius_of_b_ = std::max(radius_of_b_, (v - middle_of_b_).norm());
  }
}

GapFiller::Frame GapFiller::FrameOf(const MeshPair& pair, const ScaledBall& ball) const {
  const RelativePose& pose = pair.pose();
  const Vector3d middle = pair.scale() * (pose.rotation() * middle_of_b_ + pose.translation());
  return {pose.rotation(), -middle - ball.center(), ball.radius(), pair.scale()};
}

// A point of M less the centre is a - R (b - b0) - (R b0 + t) - c, b0 the middle of B. Between two
// frames it moves by the change of R times |b - b0|, and that of the rest; the difference of two
// such points by the change of R times |b - b'| at most. The change of R, a difference of two
// rotations by an angle δ, stretches nothing by more than 2 sin(δ/2), and its Frobenius norm is √2
// times that. Matrices that are off rotations by e are off that by 2 e, and by √6 e in the norm.
Motion GapFiller::MotionBetween(const Frame& x, const Frame& y) const {
  const double change = (x.rotation - y.rotation).norm() / std::sqrt(2.0) + 4.5 * kOffRotation;
  const double radius = x.scale * radius_of_b_;
  Motion motion;
  motion.angle = change < 1.0 ? 2.0 * std::asin(0.5 * change) + kOffRotation : 4.0;
  motion.spread = 2.0 * change * radius + kSlack;
  motion.approach =
      change * radius + (x.way - y.way).norm() + std::max(0.0, y.radius - x.radius) + kSlack;
  return motion;
}

bool GapFiller::IsWithinPadding(const Motion& motion) const {
  return motion.angle <= padding_.angle && motion.spread <= padding_.spread &&
         motion.approach <= padding_.approach;
}

// By how the last step went; the first gathering has none.
void GapFiller::ChoosePadding(const Motion& step, const ScaledBall& ball) {
  padding_ = {};
  keeps_pairs_ = false;
  if (!has_last_) return;
  const double largest = kLargestPart * ball.radius();
  const double size = std::max({step.approach, 0.5 * step.spread, 1e-300});
  const double steps = std::min(kSteps, largest / size);
  if (!(steps >= 1.0)) return;
  padding_ = {steps * step.angle, steps * step.spread, steps * step.approach};
  if (padding_.angle > 0.5) padding_ = {};
  // Of longer steps more pairs come near each other than the list would repay.
  keeps_pairs_ = padding_.angle > 0.0 && steps >= kSteps && padding_.spread <= largest;
}

const std::vector<GapCandidate>& GapFiller::Candidates(const MeshPair& pair, const GaussMap& map_a,
                                                       const GaussMap& map_b,
                                                       const ScaledBall& ball,
                                                       SphereHierarchy* hierarchy) {
  const Frame now = FrameOf(pair, ball);
  const bool is_valid = has_gathered_ && now.scale == gathered_.scale &&
                        IsWithinPadding(MotionBetween(gathered_, now));
  if (!is_valid) {
    if (has_last_ && last_.scale != now.scale) has_last_ = false;
    ChoosePadding(has_last_ ? MotionBetween(last_, now) : Motion(), ball);
    gathered_ = now;
    has_gathered_ = true;
    Gather(pair, map_a, map_b, ball, hierarchy);
    // While the list lasts, the change of the rotation stays below that of the padding's spread.
    if (keeps_pairs_) {
      pairs_.Begin(pair, candidates_, padding_.spread,
                   0.5 * padding_.spread / (now.scale * radius_of_b_));
    }
  }
  if (keeps_pairs_) pairs_.Place(pair);
  last_ = now;
  has_last_ = true;
  return candidates_;
}

// First what may meet the ball; then what may meet such. Boxes that meet at a pose within the
// padding come within `spread` of each other along every axis.
void GapFiller::Gather(const MeshPair& pair, const GaussMap& map_a, const GaussMap& map_b,
                       const ScaledBall& ball, SphereHierarchy* hierarchy) {
  ++gatherings_;
  hierarchy->Place(pair, padding_.angle);
  near_.Clear();
  found_.clear();
  candidates_.clear();
  const double reach = ball.gathering_reach() + padding_.approach;
  hierarchy->NearBall(ball.center(), reach, &found_);
  for (SumFacet& candidate : found_) {
    const MaySupport may = Triage(pair, map_a, map_b, &candidate);
    if (may == MaySupport::kNever) continue;
    const FacetCorners corners = RoundedCorners(pair, candidate);
    if (DistanceToPolygon(ball.center(), corners.points.data(), corners.count) > reach) continue;
    candidates_.push_back({candidate, may == MaySupport::kAlways, true});
    Box3 box = BoxOf(pair, corners);
    box.low -= Vector3d::Constant(padding_.spread);
    box.high += Vector3d::Constant(padding_.spread);
    near_.Add(box);
  }
  if (near_.empty()) return;
  found_.clear();
  hierarchy->NearAnyOf(near_, &found_);
  for (SumFacet& candidate : found_) {
    const FacetCorners corners = RoundedCorners(pair, candidate);
    const Box3 box = BoxOf(pair, corners);
    if (!near_.MayMeetAny(box)) continue;
    const MaySupport may = Triage(pair, map_a, map_b, &candidate);
    if (may == MaySupport::kNever || !near_.MeetsAny(box)) continue;
    if (DistanceToPolygon(ball.center(), corners.points.data(), corners.count) > reach) {
      candidates_.push_back({candidate, may == MaySupport::kAlways, false});
    }
  }
}

MaySupport GapFiller::Triage(const MeshPair& pair, const GaussMap& map_a, const GaussMap& map_b,
                             SumFacet* candidate) const {
  switch (candidate->kind) {
    case SumFacetKind::kFaceVertex:
      return TriageFaceVertex(pair.a(), candidate->a, pair.b(), map_b, candidate->b);
    case SumFacetKind::kVertexFace:
      return TriageFaceVertex(pair.b(), candidate->b, pair.a(), map_a, candidate->a);
    case SumFacetKind::kEdgeEdge:
      return TriageEdgeEdge(pair.a(), candidate->a, pair.b(), candidate->b,
                            &candidate->is_along_cross);
  }
  return MaySupport::kSometimes;
}

// At any rotation within the angle, n.(w - v) changes by |n||w - v| times it at most. Where it is
// above zero for all neighbours of a corner, that supports.
MaySupport GapFiller::TriageFaceVertex(const PlacedMesh& of_face, int face,
                                       const PlacedMesh& of_vertex, const GaussMap& map,
                                       int vertex) const {
  const Vector3d& normal = of_face.planes[face].normal;
  const double length = normal.norm();
  const double most = (padding_.angle + kSlack) * length + 3.0 * of_face.planes[face].error;
  const double error = 4.0 * of_vertex.point_error * length;
  const Vector3d& v = of_vertex.points[vertex];
  bool always = map.vertex_kind(vertex) == VertexKind::kCorner;
  for (const int h : of_vertex.mesh.vertex_half_edges(vertex)) {
    const Vector3d way = of_vertex.points[of_vertex.mesh.head(h)] - v;
    const double height = normal.dot(way), bound = most * way.norm() + error;
    if (height < -bound) return MaySupport::kNever;
    always &= height > bound;
  }
  return always ? MaySupport::kAlways : MaySupport::kSometimes;
}

// As SupportSigns::EdgeEdge has it: in one sense or the other no sign may be certain to fail; where
// all are certain to hold, they support.
MaySupport GapFiller::TriageEdgeEdge(const PlacedMesh& a, int edge_a, const PlacedMesh& b,
                                     int edge_b, bool* is_along_cross) const {
  const int ha = a.mesh.half_edge_of(edge_a), hb = b.mesh.half_edge_of(edge_b);
  const Vector3d along_a = a.points[a.mesh.head(ha)] - a.points[a.mesh.tail(ha)];
  const Vector3d along_b = b.points[b.mesh.head(hb)] - b.points[b.mesh.tail(hb)];
  // The sign of a normal along an edge; 0 where the padding leaves it open.
  const auto sign = [&](const FacePlane& plane, const Vector3d& edge, const PlacedMesh& of_edge) {
    const double length = plane.normal.norm();
    const double bound = ((padding_.angle + kSlack) * length + 3.0 * plane.error) * edge.norm() +
                         4.0 * of_edge.point_error * length;
    const double value = plane.normal.dot(edge);
    return value > bound ? 1 : value < -bound ? -1 : 0;
  };
  const int signs[] = {
      sign(a.planes[ha / 3], along_b, b), -sign(a.planes[a.mesh.twin(ha) / 3], along_b, b),
      sign(b.planes[hb / 3], along_a, a), -sign(b.planes[b.mesh.twin(hb) / 3], along_a, a)};
  const auto [least, greatest] = std::minmax_element(std::begin(signs), std::end(signs));
  if (*least < 0 && *greatest > 0) return MaySupport::kNever;
  *is_along_cross = *least > 0;
  return *least > 0 || *greatest < 0 ? MaySupport::kAlways : MaySupport::kSometimes;
}

}  // namespace touchstone::internal
