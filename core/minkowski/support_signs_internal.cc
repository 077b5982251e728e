// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/support_signs_internal.h"

#include <Eigen/Core>
#include <algorithm>

#include "touchstone/core/mesh/link.h"

namespace touchstone::internal {

using Eigen::Vector3d;

DyadicVector SupportSigns::ExactDifference(Side side, int to, int from) {
  if (side == Side::kA) return exact_.PointOfA(to) - exact_.PointOfA(from);
  return exact_.PointOfB(to) - exact_.PointOfB(from);
}

int SupportSigns::AlongNormal(Side side, int face, int to, int from) {
  const PlacedMesh& own = placed(side);
  const PlacedMesh& other = placed(Other(side));
  const FacePlane& plane = own.planes[face];
  const Vector3d difference = other.points[to] - other.points[from];
  // The points' errors and the difference's rounding.
  const double error = 1.01 * (2.0 * other.point_error + kUnit * difference.cwiseAbs().maxCoeff());
  const int sign = TriageSign(HeightAlong(plane.normal, plane.error, difference, error));
  if (sign != 0) return sign;
  ++exact_count_;
  const Triangle& corners = own.mesh.face(face);
  const DyadicVector normal = Cross(ExactDifference(side, corners[1], corners[0]),
                                    ExactDifference(side, corners[2], corners[0]));
  return Dot(normal, ExactDifference(Other(side), to, from)).sign();
}

bool SupportSigns::FaceVertex(Side side, int face, int vertex) {
  const Side other = Other(side);
  switch (map(other).vertex_kind(vertex)) {
    case VertexKind::kNever:
    case VertexKind::kWithin:
      return false;
    case VertexKind::kSpecial:
      return SpecialVertexSupports(side, face, vertex);
    case VertexKind::kCorner:
      break;
  }
  for (const int w : map(other).essential_neighbors(vertex)) {
    if (AlongNormal(side, face, w, vertex) < 0) return false;
  }
  return true;
}

bool SupportSigns::SpecialVertexSupports(Side side, int face, int vertex) {
  const Side other = Other(side);
  const TriangleMesh& mesh = placed(other).mesh;
  for (const int h : mesh.vertex_half_edges(vertex)) {
    if (AlongNormal(side, face, mesh.head(h), vertex) < 0) return false;
  }
  // The solid lies on the neighbours' side of the plane, or it holds the other side.
  const Triangle& corners = placed(side).mesh.face(face);
  const DyadicVector u = ExactDifference(side, corners[1], corners[0]);
  const DyadicVector v = ExactDifference(side, corners[2], corners[0]);
  const LinkDirection inward = MakeLinkDirection(Cross(v, u));
  Link link;
  for (const int h : mesh.vertex_half_edges(vertex)) {
    link.push_back(MakeLinkDirection(ExactDifference(other, mesh.head(h), vertex)));
  }
  std::reverse(link.begin(), link.end());
  return !LinkHolds(link, inward);
}

// With d the direction of the one edge and l, r the exterior normals of the faces left and right
// of the other, the arcs meet iff d of A parts B's normals and d of B parts A's, in the same sense:
// a direction s (d_A x d_B) is on A's arc iff s d_B.l_A >= 0 >= s d_B.r_A, and its antipode on B's
// iff s d_A.l_B >= 0 >= s d_A.r_B. All four vanish iff the edges are parallel; then no area is
// spanned.
std::optional<SumFacet> SupportSigns::EdgeEdge(int edge_a, int edge_b) {
  const TriangleMesh &a = pair_.a().mesh, &b = pair_.b().mesh;
  const int ha = a.half_edge_of(edge_a), hb = b.half_edge_of(edge_b);
  const int left_a = AlongNormal(Side::kA, ha / 3, b.head(hb), b.tail(hb));
  const int right_a = AlongNormal(Side::kA, a.twin(ha) / 3, b.head(hb), b.tail(hb));
  const int sense = left_a != 0 ? left_a : -right_a;
  if (sense == 0 || left_a * right_a > 0) return std::nullopt;
  const int left_b = AlongNormal(Side::kB, hb / 3, a.head(ha), a.tail(ha));
  if (sense * left_b < 0) return std::nullopt;
  const int right_b = AlongNormal(Side::kB, b.twin(hb) / 3, a.head(ha), a.tail(ha));
  if (sense * right_b > 0) return std::nullopt;
  return SumFacet{SumFacetKind::kEdgeEdge, sense > 0, edge_a, edge_b};
}

}  // namespace touchstone::internal
