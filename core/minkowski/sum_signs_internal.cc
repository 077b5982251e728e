// SPDX-License-Identifier: MIT
//
// Signs of the points and planes of M: by roundings, by names, by big numbers, in that order.
#include <algorithm>
#include <cmath>
#include <utility>

#include "touchstone/core/minkowski/bounded_vector_internal.h"
#include "touchstone/core/minkowski/sum_geometry_internal.h"

namespace touchstone::internal {

using Eigen::Vector3d;

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

// A vertex of the body whose face names the facet, against the same other vertex: the body's own
// vertices say on which side it lies, whatever the pose, which keeps orientations; of the apex of a
// face beside it, its edge's kind. Where flat polygons were cut and rounded, that is what doubles
// cannot tell.
std::optional<int> SumGeometry::SideOfFace(const SumPoint& x, int plane) {
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
  ++exact_count_;
  const DyadicVector at = ToDyadic(mesh.vertex(vertex));
  const auto way_to = [&](int corner) { return ToDyadic(mesh.vertex(corner)) - at; };
  // From the vertex the corners turn clockwise where it lies beyond.
  const auto& [u, v, w] = mesh.face(face);
  return -Determinant(way_to(u), way_to(v), way_to(w)).sign();
}

// A point on an edge of M lies strictly between its ends: on their side, where they have one.
std::optional<int> SumGeometry::SideByEnds(const SumPoint& x, int plane) {
  if (x.form != SumPointForm::kOnEdge) return std::nullopt;
  int sides[2];
  for (int k = 0; k < 2; ++k) {
    const SumPoint& end = points_[x.parts[k]];
    const int sign = TriageSign(Height(end, planes_[plane]));
    if (sign == 0 && !LiesOnByName(end, plane)) {
      const auto side = SideOfFace(end, plane);
      if (!side) return std::nullopt;
      sides[k] = *side;
    } else {
      sides[k] = sign;
    }
  }
  if (sides[0] * sides[1] < 0) return std::nullopt;
  return sides[0] != 0 ? sides[0] : sides[1];
}

// A point in the plane of a face beside it, against the same other vertex: on the side of that
// face's apex, or on the other one, as it lies before or beyond the edge between them.
std::optional<int> SumGeometry::SideAcrossAnEdge(const SumPoint& x, int plane) {
  const SumPlane& own = planes_[plane];
  if (x.form == SumPointForm::kVertex || own.axis >= 0) return std::nullopt;
  for (int k = x.form == SumPointForm::kOnEdge ? 2 : 0; k < 3; ++k) {
    const SumPlane& beside = planes_[x.parts[k]];
    if (beside.axis >= 0 || !AreOfOneVertex(own.facet, beside.facet)) continue;
    const auto& corners = beside.points;
    const auto is_shared = [&](int corner) {
      return std::find(own.points.begin(), own.points.end(), corner) != own.points.end();
    };
    if (is_shared(corners[0]) + is_shared(corners[1]) + is_shared(corners[2]) != 2) continue;
    const int apex = !is_shared(corners[0]) ? 0 : !is_shared(corners[1]) ? 1 : 2;
    const SumPoint &u = points_[corners[(apex + 1) % 3]], &v = points_[corners[(apex + 2) % 3]];
    int axis = 0;
    beside.normal.cwiseAbs().maxCoeff(&axis);
    const int turns = TriageTurn(u, v, x, axis) * TriageTurn(u, v, points_[corners[apex]], axis);
    if (turns == 0) continue;
    if (const auto side = SideOfFace(points_[corners[apex]], plane)) return *side * turns;
  }
  return std::nullopt;
}

// Where doubles cannot tell.
std::optional<int> SumGeometry::SideByNames(const SumPoint& x, int plane) {
  if (LiesOnByName(x, plane)) return 0;
  if (const auto side = SideOfFace(x, plane)) return side;
  if (const auto side = SideByEnds(x, plane)) return side;
  return SideAcrossAnEdge(x, plane);
}

int SumGeometry::Side(int point, int plane) {
  const SumPoint& x = points_[point];
  const int sign = TriageSign(Height(x, planes_[plane]));
  if (sign != 0) return sign;
  if (const auto side = SideByNames(x, plane)) return *side;
  ++exact_count_;
  const ExactPoint& at = Exact(point);
  const ExactPlane& exact = ExactPlaneOf(plane);
  return (Dot(exact.normal, at.coordinates) - exact.offset * at.denominator).sign();
}

// A vertex of M that has the same coordinate as the point, by its name: itself, or an end of an
// edge that runs across the axis, as edges of A do that its own coordinates place so.
std::optional<SumVertex> SumGeometry::VertexAbreast(const SumPoint& x, int axis) const {
  if (x.form == SumPointForm::kVertex) return SumVertex{x.parts[0], x.parts[1]};
  if (x.form != SumPointForm::kOnEdge) return std::nullopt;
  const SumVertex u = VertexOf(x.parts[0]), v = VertexOf(x.parts[1]);
  const TriangleMesh& a = pair_.a().mesh;
  if (u.b != v.b || a.vertex(u.a)[axis] != a.vertex(v.a)[axis]) return std::nullopt;
  return u;
}

// Of points in which a plane crosses two edges that leave one vertex, however near to it. With h, k
// and l the heights over the plane of the vertex v and of the edges' other ends a and b, the points
// are v + h (a - v) / (h - k) and v + h (b - v) / (h - l), where h has one sign and k and l the
// other: their difference is h ((a - v) (h - l) - (b - v) (h - k)) times what is positive.
int SumGeometry::CompareBesideVertex(const SumPoint& x, const SumPoint& y, int axis) const {
  if (x.form != SumPointForm::kOnEdge || y.form != SumPointForm::kOnEdge) return 0;
  if (Root(x.parts[2]) != Root(y.parts[2])) return 0;
  const int at_x = x.parts[0] == y.parts[0] || x.parts[0] == y.parts[1] ? 0 : 1;
  if (x.parts[at_x] != y.parts[0] && x.parts[at_x] != y.parts[1]) return 0;
  const int at_y = x.parts[at_x] == y.parts[0] ? 0 : 1;
  const SumPoint &v = points_[x.parts[at_x]], &a = points_[x.parts[1 - at_x]],
                 &b = points_[y.parts[1 - at_y]];
  const SumPlane& plane = planes_[x.parts[2]];
  const auto height_from = [&](const SumPoint& end) {
    const Vector3d way = v.rounded - end.rounded;
    return HeightAlong(plane.normal, plane.normal_error, way,
                       1.01 * (v.error + end.error + kUnit * MaxAbs(way)));
  };
  const Estimate from_a = height_from(a), from_b = height_from(b);
  const double to_a = a.rounded[axis] - v.rounded[axis], to_b = b.rounded[axis] - v.rounded[axis];
  const double to_a_error = 1.01 * (a.error + v.error + kUnit * std::abs(to_a));
  const double to_b_error = 1.01 * (b.error + v.error + kUnit * std::abs(to_b));
  const double left = to_a * from_b.value, right = to_b * from_a.value;
  const double error =
      1.01 * ((std::abs(to_a) + to_a_error) * from_b.error + to_a_error * std::abs(from_b.value) +
              (std::abs(to_b) + to_b_error) * from_a.error + to_b_error * std::abs(from_a.value) +
              2.1 * kUnit * (std::abs(left) + std::abs(right))) +
      kUnderflow;
  // h - k has the sign of h.
  return SignOf(left - right, error) * TriageSign(from_a);
}

int SumGeometry::Compare(int x, int y, int axis) {
  if (x == y) return 0;
  const SumPoint &p = points_[x], &q = points_[y];
  const double difference = p.rounded[axis] - q.rounded[axis];
  const int sign = SignOf(difference, 1.01 * (p.error + q.error + kUnit * std::abs(difference)));
  if (sign != 0) return sign;
  const std::optional<SumVertex> u = VertexAbreast(p, axis), v = VertexAbreast(q, axis);
  if (u && v && u->b == v->b) {
    // A's coordinates are the doubles given.
    const TriangleMesh& a = pair_.a().mesh;
    const double at_u = a.vertex(u->a)[axis], at_v = a.vertex(v->a)[axis];
    return at_u > at_v ? 1 : at_u < at_v ? -1 : 0;
  }
  if (const int beside = CompareBesideVertex(p, q, axis)) return beside;
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

// With n the plane's normal and m another's, x and y on the line of both, y - x = t (n x m): as
// z - x is normal to n, ((y - x) x (z - x)) . n = t (z - x) . (n x (n x m)) = -t |n|² (z - x) . m.
std::optional<int> SumGeometry::TurnAgainst(const std::array<int, 3>& points, int axis, int plane,
                                            int other) {
  const SumPlane &p = planes_[plane], &q = planes_[other];
  const BoundedVector line = CrossOf(p.normal, p.normal_error, q.normal, q.normal_error);
  int along = 0;
  if (!(line.value.cwiseAbs().maxCoeff(&along) > line.error)) return std::nullopt;
  int off = -1, count = 0;  // the line
  for (int k = 0; k < 3; ++k) {
    if (LiesOnByName(points_[points[k]], other)) continue;
    off = k;
    ++count;
  }
  if (count == 0) return 0;
  if (count > 1) return std::nullopt;
  const SumPoint &x = points_[points[(off + 1) % 3]], &y = points_[points[(off + 2) % 3]];
  const double way = y.rounded[along] - x.rounded[along];
  const int t = SignOf(way, 1.01 * (x.error + y.error + kUnit * std::abs(way))) *
                (line.value[along] > 0.0 ? 1 : -1);
  const int up = SignOf(p.normal[axis], p.normal_error);
  if (t == 0 || up == 0) return std::nullopt;
  const SumPoint& z = points_[points[off]];
  const int sign = TriageSign(Height(z, q));
  if (sign != 0) return -t * up * sign;
  const auto side = SideByNames(z, other);
  if (!side) return std::nullopt;
  return -t * up * *side;
}

// By the planes of facets that two of the points lie in by their names.
std::optional<int> SumGeometry::TurnByNames(const std::array<int, 3>& points, int axis, int plane) {
  for (const int point : points) {
    const SumPoint& x = points_[point];
    if (x.form == SumPointForm::kVertex) continue;
    for (int k = x.form == SumPointForm::kOnEdge ? 2 : 0; k < 3; ++k) {
      const int other = x.parts[k];
      if (planes_[other].axis >= 0 || Root(other) == Root(plane)) continue;
      if (const auto sign = TurnAgainst(points, axis, plane, other)) return sign;
    }
  }
  return std::nullopt;
}

int SumGeometry::Turn(int x, int y, int z, int axis, int plane) {
  if (x == y || y == z || z == x) return 0;
  const int sign = TriageTurn(points_[x], points_[y], points_[z], axis);
  if (sign != 0 || LieOnOneEdge({x, y, z})) return sign;
  if (const auto by_names = TurnByNames({x, y, z}, axis, plane)) return *by_names;
  return ExactTurn({x, y, z}, axis);
}

// Of the points in the order of their numbers, kept: triangulating asks for the same turn in every
// order.
int SumGeometry::ExactTurn(std::array<int, 3> points, int axis) {
  int sense = 1;
  for (const int k : {0, 1, 0}) {
    if (points[k] < points[k + 1]) continue;
    std::swap(points[k], points[k + 1]);
    sense = -sense;
  }
  const int count = static_cast<int>(turns_.size());
  const int number = turn_numbers_.Insert(
      NumberTable::Hash({points[0], points[1], points[2], axis}), count,
      [&](int i) { return turns_[i].axis == axis && turns_[i].points == points; });
  if (number < count) return sense * turns_[number].sign;
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  ++exact_count_;
  const auto row = [&](int point) {
    const ExactPoint& at = Exact(point);
    return DyadicVector{at.coordinates[i], at.coordinates[j], at.denominator};
  };
  const int sign = Determinant(row(points[0]), row(points[1]), row(points[2])).sign();
  turns_.push_back({points, axis, sign});
  return sense * sign;
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

}  // namespace touchstone::internal
