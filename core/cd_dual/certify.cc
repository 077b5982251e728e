// SPDX-License-Identifier: MIT
#include "touchstone/core/cd_dual/certify.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace touchstone {
namespace {

const ConvexPolyhedron& BodyOf(const Signs& signs, Body body) {
  return body == Body::kP ? signs.difference().p() : signs.difference().q();
}

int VertexOf(VertexPair pair, Body body) { return body == Body::kP ? pair.p : pair.q; }

// max over M of n.x < 0, every vertex looked at once: max over P of n.a plus max over Q of
// n.-(R b + t), each with the plain bound.
bool AllBelow(const MinkowskiDifference& m, const Eigen::Vector3d& n) {
  double max_p = -std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& a : m.p().vertices()) max_p = std::max(max_p, n.dot(a));
  double min_q = std::numeric_limits<double>::infinity();
  const RelativePose& pose = m.pose();
  for (const Eigen::Vector3d& b : m.q().vertices()) {
    min_q = std::min(min_q, n.dot(pose.rotation() * b + pose.translation()));
  }
  // n.a: 3.01 u |n|_1 |a|_max; n.(R b + t): the image is off by at most the coordinate error, its
  // dot product adds 3.01 u |n|_1 |image|; the difference of the two one rounding more: together
  // below |n|_1 (E + 5 u size), in scaled lengths.
  const double bound =
      1.01 * n.lpNorm<1>() * (m.coordinate_error() + 5.0 * kRoundingUnit * m.size());
  return m.scale() * (max_p - min_q) < -bound;
}

// Does edge (from, to) of `body` lie in the plane because the plane's own points say so? Two of
// them that share the other body's vertex differ by exactly that edge.
bool InPlaneByIdentity(const FacetPlane& plane, Body body, int from, int to) {
  const Body other = body == Body::kP ? Body::kQ : Body::kP;
  for (const VertexPair& x : plane.points) {
    if (VertexOf(x, body) != from) continue;
    for (const VertexPair& y : plane.points) {
      if (VertexOf(y, body) == to && VertexOf(x, other) == VertexOf(y, other)) return true;
    }
  }
  return false;
}

// Does the loop run through the three vertices in this cyclic order?
bool RunsThrough(std::span<const int> loop, int v0, int v1, int v2) {
  const auto at0 = std::find(loop.begin(), loop.end(), v0);
  const auto at1 = std::find(loop.begin(), loop.end(), v1);
  const auto at2 = std::find(loop.begin(), loop.end(), v2);
  if (at0 == loop.end() || at1 == loop.end() || at2 == loop.end()) return false;
  return (at0 < at1) + (at1 < at2) + (at2 < at0) == 2;
}

// The face of `body` that is extreme along the plane's normal by construction, or -1: the plane's
// points share one vertex of the other body, and this face holds all three of this body's, turning
// counterclockwise for P; clockwise for Q, whose points enter M negated.
int FaceByIdentity(const Signs& signs, const FacetPlane& plane, Body body, int vertex) {
  const Body other = body == Body::kP ? Body::kQ : Body::kP;
  const auto& x = plane.points;
  if (VertexOf(x[0], other) != VertexOf(x[1], other) ||
      VertexOf(x[0], other) != VertexOf(x[2], other)) {
    return -1;
  }
  const int v0 = VertexOf(x[0], body);
  const int v1 = VertexOf(x[body == Body::kP ? 1 : 2], body);
  const int v2 = VertexOf(x[body == Body::kP ? 2 : 1], body);
  const ConvexPolyhedron& shape = BodyOf(signs, body);
  for (const int f : shape.vertex_faces(vertex)) {
    if (RunsThrough(shape.face(f), v0, v1, v2)) return f;
  }
  return -1;
}

}  // namespace

std::optional<Tier> ProveSeparatingDirection(Signs* signs, const Eigen::Vector3d& direction,
                                             CornerPair* start, bool scan) {
  const MinkowskiDifference& m = signs->difference();
  const Eigen::Vector3d toward_q = -m.DirectionToQ(direction);
  int steps = 0;
  const auto peak_p = m.p().support_table().Climb(start->p, direction, &steps);
  const auto peak_q = m.q().support_table().Climb(start->q, toward_q, &steps);
  const CornerPair support{peak_p.corner, peak_q.corner};
  *start = support;
  const double length = direction.lpNorm<1>();
  const Eigen::Vector3d w = m.Point(support);
  const double error =
      1.01 * length * (3.1 * kRoundingUnit * w.cwiseAbs().maxCoeff() + m.coordinate_error());
  const double height = direction.dot(w) + error;
  if (!(height < 0.0)) return std::nullopt;
  // Entries of R are at most 1 + 1e-6 in magnitude: a coordinate of Rᵀn is off by 3.01 u |n|_1, and
  // by the rotation's own error. That is a part of 2^-30 of |Rᵀn|_1 for any rotation error but a
  // world pose's of enormous coordinates.
  const double turned_error = length * (3.1 * kRoundingUnit + m.pose().rotation_error());
  const bool q_certain = peak_q.certain && turned_error <= 0x1p-32 * length;
  if (peak_p.certain && q_certain) return Tier::kBound;
  const double excess =
      (peak_p.certain ? 0.0 : m.p().support_table().Rise(support.p, direction, 0.0)) +
      (q_certain ? 0.0 : m.q().support_table().Rise(support.q, toward_q, turned_error));
  if (height + 1.01 * m.scale() * excess < 0.0) return Tier::kBound;
  if (scan && AllBelow(m, direction)) return Tier::kScan;
  return std::nullopt;
}

bool IsClearlyEnclosing(const MinkowskiDifference& m,
                        const std::array<Eigen::Vector3d, 3>& points) {
  const auto& [x, y, z] = points;
  // As in Signs::Determinant, with every length at most sqrt(3) (size + E) =: L.
  const double e = m.coordinate_error(), l = 1.7320508075688774 * (m.size() + e);
  const double error =
      1.02 * l * l * (6.0 * kRoundingUnit * l + 3.0 * 1.7320508075688774 * e) + 0x1p-1000;
  const Eigen::Vector3d xy = x.cross(y), yz = y.cross(z), zx = z.cross(x);
  const Eigen::Vector3d& c = m.c();
  return z.dot(xy) > error && c.dot(xy) < -error && c.dot(yz) < -error && c.dot(zx) < -error;
}

std::optional<Tier> ProveEnclosingTetrahedron(Signs* signs,
                                              const std::array<VertexPair, 3>& triangle) {
  const auto& [x, y, z] = triangle;
  const long exact_before = signs->exact_count();
  // With r = o - c and ai = vi - c, r = sum mu_i a_i by Cramer: mu_3 ~ det[a1 a2 r] = -det[v1 v2
  // c], and l0 = 1 - sum mu_i ~ det[v1 v2 v3]. All with the denominator det[a1 a2 a3], the sum of
  // the four, hence positive: the tetrahedron is not flat.
  const auto front = signs->Determinant(x, y, z);
  if (!front || *front <= 0) return std::nullopt;
  const VertexPair sides[3][2] = {{y, x}, {z, y}, {x, z}};
  for (const auto& [a, b] : sides) {
    const auto sign = signs->Determinant(a, b, kInteriorDifference);
    if (!sign || *sign < 0) return std::nullopt;
  }
  return signs->exact_count() == exact_before ? Tier::kBound : Tier::kExact;
}

std::optional<Feature> SupportingFeature(Signs* signs, FacetPlane* plane, Body body, int vertex) {
  const ConvexPolyhedron& shape = BodyOf(*signs, body);
  const int own_face = FaceByIdentity(*signs, *plane, body, vertex);
  if (own_face >= 0)
    return Feature{FeatureKind::kFace, own_face};  // convexity was proven on building

  if (!shape.is_corner(vertex)) return std::nullopt;
  const auto neighbors = shape.vertex_neighbors(vertex);
  const auto faces = shape.vertex_faces(vertex);
  const std::size_t degree = neighbors.size();
  int tied_edge = -1;
  bool previous_tied = false, first_tied = false;
  int tied_face = -1;
  const auto face_is_tied = [&](int f) -> std::optional<bool> {
    for (const int v : shape.face_plane(f)) {
      const auto sign = signs->AlongNormal(plane, body, v, vertex);
      if (!sign) return std::nullopt;
      if (*sign != 0) return false;
    }
    return true;
  };
  for (std::size_t k = 0; k < degree; ++k) {
    const int neighbor = neighbors[k];
    int sign = 0;
    if (!InPlaneByIdentity(*plane, body, vertex, neighbor)) {
      const auto computed = signs->AlongNormal(plane, body, neighbor, vertex);
      if (!computed || *computed > 0) return std::nullopt;
      sign = *computed;
    }
    const bool tied = sign == 0;
    if (tied) tied_edge = shape.vertex_edges(vertex)[k];
    if (k == 0) first_tied = tied;
    // Face k - 1 lies between edges k - 1 and k. Both tied: the face is in the plane, unless the
    // vertex is within one of its edges, which a third vertex of the face tells.
    if (k > 0 && tied && previous_tied && tied_face < 0) {
      const auto in_plane = face_is_tied(faces[k - 1]);
      if (!in_plane) return std::nullopt;
      if (*in_plane) tied_face = faces[k - 1];
    }
    previous_tied = tied;
  }
  if (previous_tied && first_tied && tied_face < 0) {
    const auto in_plane = face_is_tied(faces[degree - 1]);
    if (!in_plane) return std::nullopt;
    if (*in_plane) tied_face = faces[degree - 1];
  }
  if (tied_face >= 0) return Feature{FeatureKind::kFace, tied_face};
  if (tied_edge >= 0) return Feature{FeatureKind::kEdge, tied_edge};
  return Feature{FeatureKind::kVertex, vertex};
}

FaceClass ClassOf(FeatureKind in_p, FeatureKind in_q) {
  switch (in_p) {
    case FeatureKind::kVertex:
      return FaceClass::kVertexFace;
    case FeatureKind::kEdge:
      return in_q == FeatureKind::kFace ? FaceClass::kEdgeFace : FaceClass::kEdgeEdge;
    case FeatureKind::kFace:
      if (in_q == FeatureKind::kVertex) return FaceClass::kFaceVertex;
      return in_q == FeatureKind::kEdge ? FaceClass::kFaceEdge : FaceClass::kFaceFace;
  }
  return FaceClass::kFaceFace;
}

std::optional<ExitFace> ProveExitFace(Signs* signs, const std::array<VertexPair, 3>& triangle) {
  for (const VertexPair& point : triangle) {
    if (point.p == kInteriorPoint || point.q == kInteriorPoint) return std::nullopt;
  }
  const auto& [x, y, z] = triangle;
  const VertexPair sides[3][2] = {{y, x}, {z, y}, {x, z}};
  // det[a1 a2 r] and its turns: none negative, and not all zero. Their sum is n.r, so the triangle
  // is not flat and faces along the ray; n.(w - c) > 0 follows once the plane is proven to support
  // M, c being strictly inside.
  bool crossed = false;
  for (const auto& [a, b] : sides) {
    const auto sign = signs->Determinant(a, b, kInteriorDifference);
    if (!sign || *sign < 0) return std::nullopt;
    crossed = crossed || *sign > 0;
  }
  if (!crossed) return std::nullopt;
  FacetPlane plane = signs->Plane(triangle);
  const auto in_p = SupportingFeature(signs, &plane, Body::kP, x.p);
  if (!in_p) return std::nullopt;
  const auto in_q = SupportingFeature(signs, &plane, Body::kQ, x.q);
  if (!in_q) return std::nullopt;
  return ExitFace{ClassOf(in_p->kind, in_q->kind), *in_p, *in_q, triangle};
}

}  // namespace touchstone
