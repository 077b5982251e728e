// SPDX-License-Identifier: MIT
#include "touchstone/core/cpd/contact_name_internal.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace touchstone::internal {
namespace {

using Eigen::Vector3d;

double MaxAbs(const Vector3d& v) { return v.cwiseAbs().maxCoeff(); }

std::array<int, 2> EndsOf(const TriangleMesh& mesh, int edge) {
  const int h = mesh.half_edge_of(edge);
  return {mesh.tail(h), mesh.head(h)};
}

// normal . x = offset, exactly, for points times the factor of the pose.
struct ExactPlane {
  DyadicVector normal;
  Dyadic offset;
};

ExactPlane ExactPlaneOf(const MeshPair& pair, ExactMeshPair* exact, const SumFacet& facet) {
  const TriangleMesh &a = pair.a().mesh, &b = pair.b().mesh;
  DyadicVector normal, at;
  if (facet.kind == SumFacetKind::kFaceVertex) {
    const Triangle& face = a.face(facet.a);
    const DyadicVector& origin = exact->PointOfA(face[0]);
    normal = Cross(exact->PointOfA(face[1]) - origin, exact->PointOfA(face[2]) - origin);
    at = origin - exact->PointOfB(facet.b);
  } else if (facet.kind == SumFacetKind::kVertexFace) {
    const Triangle& face = b.face(facet.b);
    const DyadicVector& origin = exact->PointOfB(face[0]);
    normal = Cross(exact->PointOfB(face[2]) - origin, exact->PointOfB(face[1]) - origin);
    at = exact->PointOfA(facet.a) - origin;
  } else {
    const auto of_a = EndsOf(a, facet.a), of_b = EndsOf(b, facet.b);
    const DyadicVector u = exact->PointOfA(of_a[1]) - exact->PointOfA(of_a[0]);
    const DyadicVector v = exact->PointOfB(of_b[1]) - exact->PointOfB(of_b[0]);
    normal = facet.is_along_cross ? Cross(u, v) : Cross(v, u);
    at = exact->PointOfA(of_a[0]) - exact->PointOfB(of_b[0]);
  }
  return {normal, Dot(normal, at)};
}

DyadicVector ExactVertex(ExactMeshPair* exact, const SumVertex& v) {
  return exact->PointOfA(v.a) - exact->PointOfB(v.b);
}

DyadicVector Combined(const Dyadic& a, const DyadicVector& u, const Dyadic& b,
                      const DyadicVector& v) {
  return a * u + b * v;
}

}  // namespace

PlaneEstimate EstimatePlane(const MeshPair& pair, const SumFacet& facet) {
  const PlacedMesh &a = pair.a(), &b = pair.b();
  Vector3d normal, at;
  double error = 0.0;
  if (facet.kind == SumFacetKind::kFaceVertex) {
    const FacePlane& plane = a.planes[facet.a];
    normal = plane.normal;
    error = plane.error;
    at = a.points[plane.vertex] - b.points[facet.b];
  } else if (facet.kind == SumFacetKind::kVertexFace) {
    const FacePlane& plane = b.planes[facet.b];
    normal = -plane.normal;
    error = plane.error;
    at = a.points[facet.a] - b.points[plane.vertex];
  } else {
    const auto of_a = EndsOf(a.mesh, facet.a), of_b = EndsOf(b.mesh, facet.b);
    const Vector3d u = a.points[of_a[1]] - a.points[of_a[0]];
    const Vector3d v = b.points[of_b[1]] - b.points[of_b[0]];
    normal = facet.is_along_cross ? u.cross(v) : v.cross(u);
    const double lu = MaxAbs(u), lv = MaxAbs(v);
    const double u_error = 1.01 * (2.0 * a.point_error + kUnit * lu),
                 v_error = 1.01 * (2.0 * b.point_error + kUnit * lv);
    // As SumGeometry's: two roundings on each path, and the data.
    error =
        1.01 * (4.1 * kUnit * lu * lv + 2.0 * (lu * v_error + lv * u_error + u_error * v_error));
    at = a.points[of_a[0]] - b.points[of_b[0]];
  }
  const double length = normal.norm();
  if (!(length > 0.0)) return {Vector3d::UnitZ(), at.z(), 2.0};
  normal /= length;
  // A vector off by e in each coordinate and then divided by its length is off by at most
  // 2 sqrt(3) e / length, and by four roundings.
  return {normal, normal.dot(at), 3.5 * error / length + 4.0 * kUnit};
}

Vector3d ContactPointOnA(const MeshPair& pair, const SumFacet& facet, const Vector3d& q) {
  const PlacedMesh &a = pair.a(), &b = pair.b();
  if (facet.kind == SumFacetKind::kFaceVertex) return b.points[facet.b] + q;
  if (facet.kind == SumFacetKind::kVertexFace) return a.points[facet.a];
  const auto of_a = EndsOf(a.mesh, facet.a), of_b = EndsOf(b.mesh, facet.b);
  const Vector3d& from = a.points[of_a[0]];
  const Vector3d u = a.points[of_a[1]] - from, v = b.points[of_b[1]] - b.points[of_b[0]];
  // from + s u lies on B's edge moved by q.
  const Vector3d normal = u.cross(v);
  const double squared = normal.squaredNorm();
  const Vector3d gap = b.points[of_b[0]] + q - from;
  const double s = squared > 0.0 ? gap.cross(v).dot(normal) / squared : 0.5;
  return from + std::clamp(s, 0.0, 1.0) * u;
}

std::optional<PointEstimate> EstimatePoint(const MeshPair& pair, const ContactName& name) {
  if (name.is_vertex) {
    const Vector3d at = EstimateVertex(pair, name.vertex);
    return PointEstimate{at, at.stableNormalized()};
  }
  PlaneEstimate planes[3] = {EstimatePlane(pair, name.facet)};
  for (int k = 0; k < name.wall_count; ++k) {
    const ContactWall& wall = name.walls[k];
    if (wall.is_edge) {
      const Vector3d from = EstimateVertex(pair, wall.from), to = EstimateVertex(pair, wall.to);
      const Vector3d normal = (to - from).cross(planes[0].normal).stableNormalized();
      planes[k + 1] = {normal, normal.dot(from), 0.0};
    } else {
      planes[k + 1] = EstimatePlane(pair, wall.facet);
    }
  }
  const Vector3d &p = planes[0].normal, &q = planes[1].normal, &r = planes[2].normal;
  const auto solve = [&](double x, double y, double z) -> std::optional<Vector3d> {
    if (name.wall_count == 0) return Vector3d(x * p);
    if (name.wall_count == 1) {
      const double cosine = p.dot(q), rest = 1.0 - cosine * cosine;
      if (!(rest > 1e-16)) return std::nullopt;
      return Vector3d(((x - y * cosine) * p + (y - x * cosine) * q) / rest);
    }
    const double determinant = p.dot(q.cross(r));
    if (!(std::abs(determinant) > 1e-12)) return std::nullopt;
    return Vector3d((x * q.cross(r) + y * r.cross(p) + z * p.cross(q)) / determinant);
  };
  const auto at = solve(planes[0].offset, planes[1].offset, planes[2].offset);
  // A wall that is an edge of the facet is no contact: the step runs along it.
  const auto rate = [&](int k) { return name.wall_count > k && name.walls[k].is_edge ? 0.0 : 1.0; };
  const auto out = solve(1.0, rate(0), rate(1));
  if (!at || !out) return std::nullopt;
  return PointEstimate{*at, *out};
}

std::optional<ExactPoint> ExactPointOf(const MeshPair& pair, const ContactName& name) {
  ExactMeshPair exact(pair);
  const Dyadic& factor = exact.pose().factor();
  if (name.is_vertex) return ExactPoint{ExactVertex(&exact, name.vertex), factor};
  ExactPlane planes[3] = {ExactPlaneOf(pair, &exact, name.facet)};
  for (int k = 0; k < name.wall_count; ++k) {
    const ContactWall& wall = name.walls[k];
    if (wall.is_edge) {
      const DyadicVector from = ExactVertex(&exact, wall.from);
      const DyadicVector normal = Cross(ExactVertex(&exact, wall.to) - from, planes[0].normal);
      planes[k + 1] = {normal, Dot(normal, from)};
    } else {
      planes[k + 1] = ExactPlaneOf(pair, &exact, wall.facet);
    }
  }
  const DyadicVector &p = planes[0].normal, &q = planes[1].normal, &r = planes[2].normal;
  DyadicVector at;
  Dyadic denominator;
  if (name.wall_count == 0) {
    at = planes[0].offset * p;
    denominator = Dot(p, p);
  } else if (name.wall_count == 1) {
    // x = λ p + μ q with p.x and q.x the offsets.
    const Dyadic pp = Dot(p, p), pq = Dot(p, q), qq = Dot(q, q);
    at = Combined(planes[0].offset * qq - planes[1].offset * pq, p,
                  planes[1].offset * pp - planes[0].offset * pq, q);
    denominator = pp * qq - pq * pq;
  } else {
    at = Combined(planes[0].offset, Cross(q, r), planes[1].offset, Cross(r, p)) +
         planes[2].offset * Cross(p, q);
    denominator = Determinant(p, q, r);
  }
  if (denominator.sign() == 0) return std::nullopt;
  if (denominator.sign() < 0) {
    denominator = -denominator;
    for (Dyadic& coordinate : at) coordinate = -coordinate;
  }
  return ExactPoint{at, denominator * factor};
}

RoundedPoint Rounded(const ExactPoint& point) {
  Vector3d x;
  for (int k = 0; k < 3; ++k) x[k] = RatioToDouble(point.coordinates[k], point.denominator);
  return {x, 0x1p-52 * x.cwiseAbs().maxCoeff() + 0x1p-1074};
}

}  // namespace touchstone::internal
