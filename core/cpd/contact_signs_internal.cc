// SPDX-License-Identifier: MIT
#include "touchstone/core/cpd/contact_signs_internal.h"

#include <Eigen/Core>

#include "touchstone/core/base/dyadic.h"
#include "touchstone/core/minkowski/convolution.h"

namespace touchstone::internal {
namespace {

using Eigen::Vector3d;

constexpr double kRoundUp = 1.0 + 0x1p-50;

// The sign of a face's exterior normal along a difference of points of the other body; 0: doubles
// cannot tell, or it can change within a turn by the angle, which changes n . d by |n||d| times
// that at most.
int AlongNormal(const PlacedMesh& own, int face, const PlacedMesh& other, int to, int from,
                double angle) {
  const FacePlane& plane = own.planes[face];
  const Vector3d difference = other.points[to] - other.points[from];
  const double error = 1.01 * (2.0 * other.point_error + kUnit * difference.cwiseAbs().maxCoeff());
  Estimate height = HeightAlong(plane.normal, plane.error, difference, error);
  if (angle > 0.0) height.error += 1.01 * angle * plane.normal.norm() * difference.norm();
  return TriageSign(height);
}

bool AreParallel(const MeshPair& pair, const ContactBody::Edge& p, const ContactBody::Edge& q) {
  ExactMeshPair exact(pair);
  const DyadicVector cross = Cross(exact.PointOfA(p.head) - exact.PointOfA(p.tail),
                                   exact.PointOfB(q.head) - exact.PointOfB(q.tail));
  return cross[0].sign() == 0 && cross[1].sign() == 0 && cross[2].sign() == 0;
}

}  // namespace

bool MayRest(const PlacedMesh& own, int face, const PlacedMesh& other, const GaussMap& map,
             int vertex, double angle) {
  if (map.vertex_kind(vertex) == VertexKind::kCorner) {
    for (const int w : map.essential_neighbors(vertex)) {
      if (AlongNormal(own, face, other, w, vertex, angle) < 0) return false;
    }
    return true;
  }
  for (const int h : other.mesh.vertex_half_edges(vertex)) {
    if (AlongNormal(own, face, other, other.mesh.head(h), vertex, angle) < 0) return false;
  }
  return true;
}

// As SupportSigns::EdgeEdge of core/minkowski, where signs that doubles leave open count as met;
// both senses if none is certain.
//
// Exactly parallel edges span no area: what they have of ∂M is on other facets.
EdgeSenses MayCross(const MeshPair& pair, const ContactBody& a, int edge_a, const ContactBody& b,
                    int edge_b, double angle) {
  const ContactBody::Edge &p = a.edge(edge_a), &q = b.edge(edge_b);
  const int left_a = AlongNormal(pair.a(), p.left, pair.b(), q.head, q.tail, angle);
  const int right_a = AlongNormal(pair.a(), p.right, pair.b(), q.head, q.tail, angle);
  if (left_a * right_a > 0) return {};
  const int left_b = AlongNormal(pair.b(), q.left, pair.a(), p.head, p.tail, angle);
  const int right_b = AlongNormal(pair.b(), q.right, pair.a(), p.head, p.tail, angle);
  if (left_b * right_b > 0) return {};
  const bool is_open = left_a * right_a == 0 && left_b * right_b == 0;
  if (is_open && angle == 0.0 && AreParallel(pair, p, q)) return {};
  const auto may = [&](int sense) {
    return sense * left_a >= 0 && sense * right_a <= 0 && sense * left_b >= 0 &&
           sense * right_b <= 0;
  };
  return {may(1), may(-1)};
}

bool MaySupport(const MeshPair& pair, const ContactBody& a, const ContactBody& b,
                const SumFacet& facet, double angle) {
  switch (facet.kind) {
    case SumFacetKind::kFaceVertex:
      return MayRest(pair.a(), facet.a, pair.b(), b.gauss_map(), facet.b, angle);
    case SumFacetKind::kVertexFace:
      return MayRest(pair.b(), facet.b, pair.a(), a.gauss_map(), facet.a, angle);
    case SumFacetKind::kEdgeEdge:
      break;
  }
  const EdgeSenses senses = MayCross(pair, a, facet.a, b, facet.b, angle);
  return facet.is_along_cross ? senses.along : senses.against;
}

bool MaySupportEitherWay(const MeshPair& pair, const ContactBody& a, const ContactBody& b,
                         const SumFacet& facet, double angle) {
  if (facet.kind != SumFacetKind::kEdgeEdge) return MaySupport(pair, a, b, facet, angle);
  const EdgeSenses senses = MayCross(pair, a, facet.a, b, facet.b, angle);
  return senses.along || senses.against;
}

// A matrix's Frobenius norm bounds what it does to a unit vector, and is sqrt 2 times a small turn.
MotionBound MotionOfB(const MeshPair& pair, const RelativePose& from, const RelativePose& to) {
  const double turn = (to.rotation() - from.rotation()).norm();
  const double shift = (to.translation() - from.translation()).norm();
  const double size = pair.b().mesh.max_coordinate();
  return {pair.scale() * (1.7321 * turn * size + shift) * kRoundUp, turn};
}

}  // namespace touchstone::internal
