// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/sum_geometry_internal.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace touchstone::internal {
namespace {

using Eigen::Vector3d;

constexpr double kUnderflow = 0x1p-1000;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

double MaxAbs(const Vector3d& v) { return v.cwiseAbs().maxCoeff(); }

// A cross product and the bound on its coordinates: u_i v_j - u_j v_i passes two roundings on each
// path, 2.01 units of at most 2 |u||v|; the data add 2 (|u| e_v + |v| e_u + e_u e_v).
struct BoundedVector {
  Vector3d value;
  double error;
};
BoundedVector CrossOf(const Vector3d& u, double u_error, const Vector3d& v, double v_error) {
  const double lu = MaxAbs(u), lv = MaxAbs(v);
  const double error =
      1.01 * (4.1 * kUnit * lu * lv + 2.0 * (lu * v_error + lv * u_error + u_error * v_error)) +
      kUnderflow;
  return {u.cross(v), error};
}

int SignOf(double value, double error) {
  return value > error ? 1 : value < -error ? -1 : 0;  // 0 for NaN, and where the error is infinite
}

}  // namespace

int SumGeometry::Add(SumPointForm form, const std::array<int, 3>& parts) {
  const int number = point_numbers_.Insert(
      NumberTable::Hash({static_cast<int>(form), parts[0], parts[1], parts[2]}), point_count(),
      [&](int i) { return points_[i].form == form && points_[i].parts == parts; });
  if (number == point_count()) points_.push_back({form, parts, Vector3d::Zero(), kInfinity});
  return number;
}

int SumGeometry::AddVertex(SumVertex vertex) {
  const int number = Add(SumPointForm::kVertex, {vertex.a, vertex.b, -1});
  SumPoint& point = points_[number];
  if (point.error == kInfinity) {
    // Coordinates of each body are at most one in size.
    point.rounded = pair_.a().points[vertex.a] - pair_.b().points[vertex.b];
    point.error = 1.01 * (pair_.a().point_error + pair_.b().point_error + 2.0 * kUnit);
  }
  return number;
}

int SumGeometry::AddOnEdge(int vertex, int other_vertex, int plane) {
  const auto [small, large] = std::minmax(vertex, other_vertex);
  const int count = point_count();
  const int number = Add(SumPointForm::kOnEdge, {small, large, Root(plane)});
  if (number == count) RoundOnEdge(&points_[number]);
  return number;
}

int SumGeometry::AddOfPlanes(int p, int q, int r) {
  std::array<int, 3> planes = {Root(p), Root(q), Root(r)};
  std::sort(planes.begin(), planes.end());
  const int count = point_count();
  const int number = Add(SumPointForm::kOfPlanes, planes);
  if (number == count) RoundOfPlanes(&points_[number]);
  return number;
}

SumVertex SumGeometry::VertexOf(int point) const {
  return {points_[point].parts[0], points_[point].parts[1]};
}

SumPointName SumGeometry::NameOf(int point) const {
  const SumPoint& x = points_[point];
  SumPointName name;
  if (x.form == SumPointForm::kVertex) {
    name.vertices[0] = VertexOf(point);
    return name;
  }
  if (x.form == SumPointForm::kOnEdge) {
    name.kind = SumPointKind::kEdgeFacet;
    name.vertices[0] = VertexOf(x.parts[0]);
    name.vertices[1] = VertexOf(x.parts[1]);
    name.facets[0] = x.parts[2];
    return name;
  }
  name.kind = SumPointKind::kThreeFacets;
  int facets = 0, vertices = 0;
  for (const int plane : x.parts) {
    const SumPlane& own = planes_[plane];
    if (own.axis < 0) {
      name.facets[facets++] = plane;
      continue;
    }
    name.kind = SumPointKind::kEdgeEdge;
    name.vertices[vertices++] = VertexOf(own.points[0]);
    name.vertices[vertices++] = VertexOf(own.points[1]);
  }
  return name;
}

// Heights h, k of the edge's ends over the plane, off by e_h, e_k, cross it at s = h / (h - k), off
// by (e_h |k| + e_k |h|) / (|h - k| (|h - k| - e_h - e_k)); the division and its operands are
// rounded thrice.
void SumGeometry::RoundOnEdge(SumPoint* point) const {
  const SumPoint &u = points_[point->parts[0]], &v = points_[point->parts[1]];
  const SumPlane& plane = planes_[point->parts[2]];
  const Estimate h = Height(u, plane), k = Height(v, plane);
  const double span = std::abs(h.value - k.value);
  const double least = span * (1.0 - 2.0 * kUnit) - h.error - k.error;
  if (!(least > 0.0)) return;
  const double s = h.value / (h.value - k.value);
  const double s_error =
      1.01 * (h.error * std::abs(k.value) + k.error * std::abs(h.value)) / (span * least) +
      4.0 * kUnit * std::abs(s);
  const Vector3d edge = v.rounded - u.rounded;
  point->rounded = u.rounded + s * edge;
  // Vertices are off by their errors, weighted by 1 - s and s; the sum is rounded.
  point->error = 1.01 * ((1.0 + 2.0 * (std::abs(s) + s_error)) * std::max(u.error, v.error) +
                         s_error * MaxAbs(edge) +
                         3.0 * kUnit * (MaxAbs(u.rounded) + std::abs(s) * MaxAbs(edge)));
}

// With o the first plane's origin and d_i the heights of the others' origins over it, seen along
// their normals: x - o = (d_2 (n_3 x n_1) + d_3 (n_1 x n_2)) / det.
void SumGeometry::RoundOfPlanes(SumPoint* point) const {
  const SumPlane &p = planes_[point->parts[0]], &q = planes_[point->parts[1]],
                 &r = planes_[point->parts[2]];
  const BoundedVector qr = CrossOf(q.normal, q.normal_error, r.normal, r.normal_error);
  const BoundedVector rp = CrossOf(r.normal, r.normal_error, p.normal, p.normal_error);
  const BoundedVector pq = CrossOf(p.normal, p.normal_error, q.normal, q.normal_error);
  const Estimate det = HeightAlong(p.normal, p.normal_error, qr.value, qr.error);
  const double least = std::abs(det.value) - det.error;
  if (!(least > 0.0)) return;
  const auto offset = [&p](const SumPlane& plane) {
    const Vector3d difference = plane.origin - p.origin;
    return HeightAlong(plane.normal, plane.normal_error, difference,
                       1.01 * (plane.origin_error + p.origin_error + kUnit * MaxAbs(difference)));
  };
  const Estimate d_q = offset(q), d_r = offset(r);
  const Vector3d numerator = d_q.value * rp.value + d_r.value * pq.value;
  const double l_qr = MaxAbs(qr.value) + qr.error, l_rp = MaxAbs(rp.value) + rp.error,
               l_pq = MaxAbs(pq.value) + pq.error;
  // The origin of p is off its plane by its error times the normal: a third term.
  const double d_p_error = 3.0 * (MaxAbs(p.normal) + p.normal_error) * p.origin_error;
  const double numerator_error =
      1.01 * (d_q.error * l_rp + std::abs(d_q.value) * rp.error + d_r.error * l_pq +
              std::abs(d_r.value) * pq.error + d_p_error * l_qr +
              2.1 * kUnit * (std::abs(d_q.value) * l_rp + std::abs(d_r.value) * l_pq));
  const Vector3d step = numerator / det.value;
  point->rounded = p.origin + step;
  point->error = 1.01 * ((numerator_error + MaxAbs(step) * det.error) / least +
                         2.0 * kUnit * (MaxAbs(step) + MaxAbs(p.origin))) +
                 kUnderflow;
}

int SumGeometry::AddFacetPlane(const SumFacet& facet, const std::array<int, 4>& corners) {
  SumPlane plane;
  plane.points = corners;
  plane.facet = facet;
  const auto of_face = [&](const PlacedMesh& placed, int face, double sign) {
    plane.normal = sign * placed.planes[face].normal;
    plane.normal_error = placed.planes[face].error;
  };
  if (facet.kind == SumFacetKind::kFaceVertex) {
    of_face(pair_.a(), facet.a, 1.0);
  } else if (facet.kind == SumFacetKind::kVertexFace) {
    of_face(pair_.b(), facet.b, -1.0);
  } else {
    const TriangleMesh &a = pair_.a().mesh, &b = pair_.b().mesh;
    const int ha = a.half_edge_of(facet.a), hb = b.half_edge_of(facet.b);
    const Vector3d edge_a = pair_.a().points[a.head(ha)] - pair_.a().points[a.tail(ha)];
    const Vector3d edge_b = pair_.b().points[b.head(hb)] - pair_.b().points[b.tail(hb)];
    const auto error = [](const PlacedMesh& placed, const Vector3d& edge) {
      return 1.01 * (2.0 * placed.point_error + kUnit * MaxAbs(edge));
    };
    const BoundedVector cross =
        CrossOf(edge_a, error(pair_.a(), edge_a), edge_b, error(pair_.b(), edge_b));
    plane.normal = facet.is_along_cross ? cross.value : Vector3d(-cross.value);
    plane.normal_error = cross.error;
  }
  plane.origin = points_[corners[0]].rounded;
  plane.origin_error = points_[corners[0]].error;
  planes_.push_back(plane);
  roots_.push_back(static_cast<int>(roots_.size()));
  return roots_.back();
}

int SumGeometry::AddEdgePlane(int vertex, int other_vertex, int axis) {
  const auto [small, large] = std::minmax(vertex, other_vertex);
  const std::array<int, 4> ends = {small, large, large, large};
  const int number = edge_planes_.Insert(
      NumberTable::Hash({small, large, axis, 0}), static_cast<int>(planes_.size()),
      [&](int p) { return planes_[p].axis == axis && planes_[p].points == ends; });
  if (number < static_cast<int>(planes_.size())) return number;
  const SumPoint &u = points_[small], &v = points_[large];
  const Vector3d edge = v.rounded - u.rounded;
  SumPlane plane;
  plane.points = ends;
  plane.axis = axis;
  plane.normal = edge.cross(Vector3d::Unit(axis));
  plane.normal_error = 1.01 * (u.error + v.error + kUnit * MaxAbs(edge));
  plane.origin = u.rounded;
  plane.origin_error = u.error;
  planes_.push_back(plane);
  roots_.push_back(static_cast<int>(roots_.size()));
  return number;
}

void SumGeometry::Unite(int p, int q) {
  const auto [small, large] = std::minmax({Root(p), Root(q)});
  roots_[large] = small;
}

int SumGeometry::Root(int plane) const {
  while (roots_[plane] != plane) plane = roots_[plane] = roots_[roots_[plane]];
  return plane;
}

Estimate SumGeometry::Height(const SumPoint& x, const SumPlane& plane) {
  const Vector3d difference = x.rounded - plane.origin;
  return HeightAlong(plane.normal, plane.normal_error, difference,
                     1.01 * (x.error + plane.origin_error + kUnit * MaxAbs(difference)));
}

bool SumGeometry::LiesOnByName(const SumPoint& x, int plane) const {
  const auto is_corner = [&](int vertex) {
    const auto& corners = planes_[plane].points;
    return std::find(corners.begin(), corners.end(), vertex) != corners.end();
  };
  switch (x.form) {
    case SumPointForm::kVertex:
      return is_corner(static_cast<int>(&x - points_.data())) ||
             (planes_[plane].axis < 0 && IsVertexOfFlatFacet(x, planes_[plane].facet));
    case SumPointForm::kOnEdge:
      return Root(x.parts[2]) == Root(plane) || (is_corner(x.parts[0]) && is_corner(x.parts[1]));
    case SumPointForm::kOfPlanes:
      return std::any_of(x.parts.begin(), x.parts.end(),
                         [&](int part) { return Root(part) == Root(plane); });
  }
  return false;
}

// A vertex of a face coplanar with the one that names the facet, against the same other vertex.
bool SumGeometry::IsVertexOfFlatFacet(const SumPoint& x, const SumFacet& facet) const {
  const auto is_on = [](const TriangleMesh& mesh, int vertex, int face) {
    const auto ring = mesh.vertex_half_edges(vertex);
    return std::any_of(ring.begin(), ring.end(), [&](int h) {
      return mesh.facet_of_face(TriangleMesh::face_of(h)) == mesh.facet_of_face(face);
    });
  };
  if (facet.kind == SumFacetKind::kFaceVertex) {
    return x.parts[1] == facet.b && is_on(pair_.a().mesh, x.parts[0], facet.a);
  }
  return facet.kind == SumFacetKind::kVertexFace && x.parts[0] == facet.a &&
         is_on(pair_.b().mesh, x.parts[1], facet.b);
}

// The apex of a face beside the one that names the facet, against the same other vertex: the edge's
// kind says on which side it lies, whatever the pose. Where flat polygons were cut and rounded,
// that is what doubles cannot tell.
std::optional<int> SumGeometry::SideOfNeighbor(const SumPoint& x, int plane) const {
  const SumPlane& own = planes_[plane];
  if (x.form != SumPointForm::kVertex || own.axis >= 0 ||
      own.facet.kind == SumFacetKind::kEdgeEdge) {
    return std::nullopt;
  }
  const bool is_of_a = own.facet.kind == SumFacetKind::kFaceVertex;
  if (is_of_a ? x.parts[1] != own.facet.b : x.parts[0] != own.facet.a) return std::nullopt;
  const TriangleMesh& mesh = is_of_a ? pair_.a().mesh : pair_.b().mesh;
  const int face = is_of_a ? own.facet.a : own.facet.b;
  const int vertex = x.parts[is_of_a ? 0 : 1];
  for (int h = 3 * face; h < 3 * face + 3; ++h) {
    if (mesh.apex(mesh.twin(h)) != vertex) continue;
    switch (mesh.edge_kind(mesh.edge_of(h))) {
      case EdgeKind::kConvex:
        return -1;
      case EdgeKind::kFlat:
        return 0;
      case EdgeKind::kReflex:
        return 1;
    }
  }
  return std::nullopt;
}

int SumGeometry::Side(int point, int plane) {
  const SumPoint& x = points_[point];
  const int sign = TriageSign(Height(x, planes_[plane]));
  if (sign != 0 || LiesOnByName(x, plane)) return sign;
  if (const auto side = SideOfNeighbor(x, plane)) return *side;
  ++exact_count_;
  const ExactPoint& at = Exact(point);
  const ExactPlane& exact = ExactPlaneOf(plane);
  return (Dot(exact.normal, at.coordinates) - exact.offset * at.denominator).sign();
}

int SumGeometry::Compare(int x, int y, int axis) {
  if (x == y) return 0;
  const SumPoint &p = points_[x], &q = points_[y];
  const double difference = p.rounded[axis] - q.rounded[axis];
  const int sign = SignOf(difference, 1.01 * (p.error + q.error + kUnit * std::abs(difference)));
  if (sign != 0) return sign;
  if (p.form == SumPointForm::kVertex && q.form == SumPointForm::kVertex &&
      p.parts[1] == q.parts[1]) {
    // A's coordinates are the doubles given.
    const TriangleMesh& a = pair_.a().mesh;
    const double u = a.vertex(p.parts[0])[axis], v = a.vertex(q.parts[0])[axis];
    return u > v ? 1 : u < v ? -1 : 0;
  }
  ++exact_count_;
  const ExactPoint &a = Exact(x), &b = Exact(y);
  return (a.coordinates[axis] * b.denominator - b.coordinates[axis] * a.denominator).sign();
}

bool SumGeometry::AreEqual(int x, int y) {
  return Compare(x, y, 0) == 0 && Compare(x, y, 1) == 0 && Compare(x, y, 2) == 0;
}

int SumGeometry::TriageTurn(const SumPoint& x, const SumPoint& y, const SumPoint& z, int axis) {
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  const double u0 = y.rounded[i] - x.rounded[i], u1 = y.rounded[j] - x.rounded[j];
  const double v0 = z.rounded[i] - x.rounded[i], v1 = z.rounded[j] - x.rounded[j];
  const double left = u0 * v1, right = u1 * v0;
  const double u_error = x.error + y.error, v_error = x.error + z.error;
  // Two roundings on each path after those of the differences, and the data.
  const double error = 1.01 * (4.1 * kUnit * (std::abs(left) + std::abs(right)) +
                               u_error * (std::abs(v0) + std::abs(v1)) +
                               v_error * (std::abs(u0) + std::abs(u1)) + 2.0 * u_error * v_error) +
                       kUnderflow;
  return SignOf(left - right, error);
}

// By their names: the ends of an edge of M, and points on it.
bool SumGeometry::LieOnOneEdge(const std::array<int, 3>& points) const {
  const auto on_edge = std::find_if(points.begin(), points.end(), [&](int x) {
    return points_[x].form == SumPointForm::kOnEdge;
  });
  if (on_edge == points.end()) return false;
  const auto& [u, v, plane] = points_[*on_edge].parts;
  return std::all_of(points.begin(), points.end(), [&, u = u, v = v](int x) {
    const SumPoint& own = points_[x];
    return x == u || x == v ||
           (own.form == SumPointForm::kOnEdge && own.parts[0] == u && own.parts[1] == v);
  });
}

int SumGeometry::Turn(int x, int y, int z, int axis) {
  if (x == y || y == z || z == x) return 0;
  const int sign = TriageTurn(points_[x], points_[y], points_[z], axis);
  if (sign != 0 || LieOnOneEdge({x, y, z})) return sign;
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  ++exact_count_;
  const ExactPoint &a = Exact(x), &b = Exact(y), &c = Exact(z);
  const auto row = [&](const ExactPoint& at) {
    return DyadicVector{at.coordinates[i], at.coordinates[j], at.denominator};
  };
  return Determinant(row(a), row(b), row(c)).sign();
}

int SumGeometry::NormalsDeterminant(int p, int q, int r) {
  const SumPlane &a = planes_[p], &b = planes_[q], &c = planes_[r];
  const BoundedVector bc = CrossOf(b.normal, b.normal_error, c.normal, c.normal_error);
  const int sign = TriageSign(HeightAlong(a.normal, a.normal_error, bc.value, bc.error));
  if (sign != 0) return sign;
  const int roots[] = {Root(p), Root(q), Root(r)};
  if (roots[0] == roots[1] || roots[1] == roots[2] || roots[2] == roots[0]) return 0;
  ++exact_count_;
  return Determinant(ExactPlaneOf(p).normal, ExactPlaneOf(q).normal, ExactPlaneOf(r).normal).sign();
}

int SumGeometry::NormalsAgree(int p, int q) {
  const SumPlane &a = planes_[p], &b = planes_[q];
  const int sign = TriageSign(HeightAlong(a.normal, a.normal_error, b.normal, b.normal_error));
  if (sign != 0) return sign;
  ++exact_count_;
  return Dot(ExactPlaneOf(p).normal, ExactPlaneOf(q).normal).sign();
}

int SumGeometry::LineAlong(int p, int q, int axis) {
  const SumPlane &a = planes_[p], &b = planes_[q];
  const BoundedVector cross = CrossOf(a.normal, a.normal_error, b.normal, b.normal_error);
  const int sign = SignOf(cross.value[axis], cross.error);
  if (sign != 0) return sign;
  ++exact_count_;
  return Cross(ExactPlaneOf(p).normal, ExactPlaneOf(q).normal)[axis].sign();
}

int SumGeometry::LineAxis(int p, int q) {
  const SumPlane &a = planes_[p], &b = planes_[q];
  const BoundedVector cross = CrossOf(a.normal, a.normal_error, b.normal, b.normal_error);
  int axis = 0;
  if (cross.value.cwiseAbs().maxCoeff(&axis) > cross.error) return axis;
  for (axis = 0; axis < 3; ++axis) {
    if (LineAlong(p, q, axis) != 0) return axis;
  }
  return -1;
}

int SumGeometry::NormalAxis(int plane) {
  int axis = 0;
  if (planes_[plane].normal.cwiseAbs().maxCoeff(&axis) > planes_[plane].normal_error) return axis;
  for (axis = 0; axis < 2; ++axis) {
    if (NormalAlong(plane, axis) != 0) return axis;
  }
  return axis;
}

int SumGeometry::NormalAlong(int plane, int axis) {
  const int sign = SignOf(planes_[plane].normal[axis], planes_[plane].normal_error);
  if (sign != 0) return sign;
  ++exact_count_;
  return ExactPlaneOf(plane).normal[axis].sign();
}

// An error of 2^-20 of the length moves the direction by as much, times √3.
Vector3d SumGeometry::UnitNormal(int plane) {
  const SumPlane& own = planes_[plane];
  const double size = MaxAbs(own.normal);
  if (size > 0x1p20 * own.normal_error) return (own.normal / size).normalized();
  Vector3d normal;
  std::array<int, 3> exponents;
  for (int i = 0; i < 3; ++i) {
    normal[i] = ExactPlaneOf(plane).normal[i].ToScaledDouble(&exponents[i]);
  }
  int largest = std::numeric_limits<int>::min();
  for (int i = 0; i < 3; ++i) {
    if (normal[i] != 0.0) largest = std::max(largest, exponents[i]);
  }
  for (int i = 0; i < 3; ++i) {
    normal[i] = normal[i] != 0.0 ? std::ldexp(normal[i], exponents[i] - largest) : 0.0;
  }
  return normal.normalized();
}

const SumGeometry::ExactPlane& SumGeometry::ExactPlaneOf(int plane) {
  if (const ExactPlane* known = exact_planes_.Find(plane)) return *known;
  const auto& corners = planes_[plane].points;
  const DyadicVector origin = Exact(corners[0]).coordinates;
  const DyadicVector u = Exact(corners[1]).coordinates - origin;
  DyadicVector v{Dyadic(0), Dyadic(0), Dyadic(0)};
  if (planes_[plane].axis < 0) {
    v = Exact(corners[2]).coordinates - origin;
  } else {
    v[planes_[plane].axis] = Dyadic(1);
  }
  const DyadicVector normal = Cross(u, v);
  return exact_planes_.Add(plane, {normal, Dot(normal, origin)});
}

ExactPoint SumGeometry::MakeExact(const SumPoint& point) {
  ExactPoint exact;
  if (point.form == SumPointForm::kVertex) {
    exact.coordinates = exact_pair_.PointOfA(point.parts[0]) - exact_pair_.PointOfB(point.parts[1]);
    return exact;
  }
  if (point.form == SumPointForm::kOnEdge) {
    const DyadicVector u = Exact(point.parts[0]).coordinates;
    const DyadicVector v = Exact(point.parts[1]).coordinates;
    const ExactPlane& plane = ExactPlaneOf(point.parts[2]);
    const Dyadic h = Dot(plane.normal, u) - plane.offset, k = Dot(plane.normal, v) - plane.offset;
    exact.denominator = h - k;
    exact.coordinates = h * v - k * u;
  } else {
    const ExactPlane &p = ExactPlaneOf(point.parts[0]), &q = ExactPlaneOf(point.parts[1]),
                     &r = ExactPlaneOf(point.parts[2]);
    const DyadicVector qr = Cross(q.normal, r.normal);
    exact.denominator = Dot(p.normal, qr);
    exact.coordinates =
        p.offset * qr + q.offset * Cross(r.normal, p.normal) + r.offset * Cross(p.normal, q.normal);
  }
  if (exact.denominator.sign() < 0) {
    exact.denominator = -exact.denominator;
    for (Dyadic& x : exact.coordinates) x = -x;
  }
  return exact;
}

const ExactPoint& SumGeometry::Exact(int point) {
  if (const ExactPoint* known = exact_points_.Find(point)) return *known;
  return exact_points_.Add(point, MakeExact(points_[point]));
}

void SumGeometry::Sharpen(int point) {
  const ExactPoint& exact = Exact(point);
  const Dyadic denominator = exact.denominator * factor();
  SumPoint& x = points_[point];
  // Scaled by a power of two: one rounding, and that of the quotient.
  for (int i = 0; i < 3; ++i) {
    x.rounded[i] = pair_.scale() * RatioToDouble(exact.coordinates[i], denominator);
  }
  x.error = kUnit * MaxAbs(x.rounded) + kUnderflow;
}

}  // namespace touchstone::internal
