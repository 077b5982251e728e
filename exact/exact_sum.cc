// SPDX-License-Identifier: GPL-3.0-or-later
#include "touchstone/exact/exact_sum.h"

#include <algorithm>
#include <climits>
#include <map>
#include <utility>

namespace touchstone::exact {
namespace {

RationalPoint ToRationalPoint(const IntegerVector& x) {
  return {mpq_class(x[0]), mpq_class(x[1]), mpq_class(x[2])};
}

mpq_class HeightAlong(const IntegerVector& normal, const RationalPoint& x) {
  return normal[0] * x[0] + normal[1] * x[1] + normal[2] * x[2];
}

// Where three planes meet, if in one point.
std::optional<RationalPoint> Meet(const SumPlane& p, const SumPlane& q, const SumPlane& r) {
  const Integer determinant = Determinant(p.normal, q.normal, r.normal);
  if (sgn(determinant) == 0) return std::nullopt;
  const IntegerVector u = Cross(q.normal, r.normal), v = Cross(r.normal, p.normal),
                      w = Cross(p.normal, q.normal);
  RationalPoint x;
  for (int i = 0; i < 3; ++i) {
    x[i] = mpq_class(p.offset * u[i] + q.offset * v[i] + r.offset * w[i], determinant);
    x[i].canonicalize();
  }
  return x;
}

// Where a line through two points meets a plane, if in one point.
std::optional<RationalPoint> Meet(const IntegerVector& from, const IntegerVector& to,
                                  const SumPlane& plane) {
  const IntegerVector along = to - from;
  const Integer slope = Dot(plane.normal, along);
  if (sgn(slope) == 0) return std::nullopt;
  mpq_class s(plane.offset - Dot(plane.normal, from), slope);
  s.canonicalize();
  return Along(ToRationalPoint(from), s, along);
}

// Positive where the solid at an edge is reflex, 0 where it is flat.
template <class PointOf>
int Bend(const MeshEdge& edge, const PointOf& point) {
  const IntegerVector& o = point(edge.tail);
  return sgn(
      Determinant(point(edge.head) - o, point(edge.left_apex) - o, point(edge.right_apex) - o));
}

template <class PointOf>
std::vector<char> FlatEdges(const MeshFeatures& mesh, const PointOf& point) {
  std::vector<char> is_flat;
  for (const MeshEdge& edge : mesh.edges) is_flat.push_back(Bend(edge, point) == 0);
  return is_flat;
}

// Vertices that no edges leave but flat ones and, at most, two in one line.
template <class PointOf>
std::vector<char> InnerVertices(const MeshFeatures& mesh, const std::vector<char>& is_flat,
                                const PointOf& point) {
  std::vector<std::vector<int>> ways(mesh.neighbors.size());
  for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
    if (is_flat[e]) continue;
    ways[mesh.edges[e].tail].push_back(mesh.edges[e].head);
    ways[mesh.edges[e].head].push_back(mesh.edges[e].tail);
  }
  std::vector<char> is_inner;
  for (std::size_t v = 0; v < ways.size(); ++v) {
    const IntegerVector& o = point(static_cast<int>(v));
    is_inner.push_back(
        ways[v].empty() ||
        (ways[v].size() == 2 && IsZero(Cross(point(ways[v][0]) - o, point(ways[v][1]) - o))));
  }
  return is_inner;
}

}  // namespace

RationalPoint Along(const RationalPoint& x, const mpq_class& s, const IntegerVector& direction) {
  return {x[0] + s * direction[0], x[1] + s * direction[1], x[2] + s * direction[2]};
}

int Side(const SumPlane& plane, const RationalPoint& x) {
  return cmp(HeightAlong(plane.normal, x), mpq_class(plane.offset));
}

MeshFeatures::MeshFeatures(const TriangleMesh& mesh) : neighbors(mesh.vertex_count()) {
  std::map<std::pair<int, int>, int> numbers;
  for (const auto& face : mesh.faces()) {
    for (int k = 0; k < 3; ++k) {
      const int tail = face[k], head = face[(k + 1) % 3], apex = face[(k + 2) % 3];
      neighbors[tail].push_back(head);  // each neighbour follows v in one face
      const auto [place, added] =
          numbers.try_emplace(std::minmax(tail, head), static_cast<int>(edges.size()));
      if (added) {
        edges.push_back({tail, head, apex, -1});
      } else {
        edges[place->second].right_apex = apex;
      }
    }
  }
}

ExactSum::ExactSum(const PlacedMeshPair& pair) : pair_(pair), a_(pair.a()), b_(pair.b()) {
  unit_ = mpq_class(1, pair.scale());
  unit_.canonicalize();
  if (pair.exponent() >= 0) {
    mpq_mul_2exp(unit_.get_mpq_t(), unit_.get_mpq_t(), static_cast<mp_bitcnt_t>(pair.exponent()));
  } else {
    mpq_div_2exp(unit_.get_mpq_t(), unit_.get_mpq_t(), static_cast<mp_bitcnt_t>(-pair.exponent()));
  }
  Integer largest = 0;
  for (int v = 0; v < pair.a().vertex_count(); ++v) {
    for (const Integer& x : pair.point_a(v)) largest = std::max(largest, Integer(abs(x)));
  }
  for (int v = 0; v < pair.b().vertex_count(); ++v) {
    for (const Integer& x : pair.point_b(v)) largest = std::max(largest, Integer(abs(x)));
  }
  largest_normal_ = 8 * largest * largest;
  const auto at_a = [&](int v) -> const IntegerVector& { return pair_.point_a(v); };
  const auto at_b = [&](int v) -> const IntegerVector& { return pair_.point_b(v); };
  flat_edges_a_ = FlatEdges(a_, at_a);
  flat_edges_b_ = FlatEdges(b_, at_b);
  inner_vertices_a_ = InnerVertices(a_, flat_edges_a_, at_a);
  inner_vertices_b_ = InnerVertices(b_, flat_edges_b_, at_b);
}

bool ExactSum::IsValid(const SumVertex& vertex) const {
  return vertex.a >= 0 && vertex.a < pair_.a().vertex_count() && vertex.b >= 0 &&
         vertex.b < pair_.b().vertex_count();
}

bool ExactSum::IsValid(const SumFacet& facet) const {
  int count_a = 0, count_b = 0;
  switch (facet.kind) {
    case SumFacetKind::kFaceVertex:
      count_a = pair_.a().face_count(), count_b = pair_.b().vertex_count();
      break;
    case SumFacetKind::kVertexFace:
      count_a = pair_.a().vertex_count(), count_b = pair_.b().face_count();
      break;
    case SumFacetKind::kEdgeEdge:
      count_a = static_cast<int>(a_.edges.size()), count_b = static_cast<int>(b_.edges.size());
      break;
  }
  return facet.a >= 0 && facet.a < count_a && facet.b >= 0 && facet.b < count_b;
}

std::vector<SumVertex> ExactSum::Corners(const SumFacet& facet) const {
  if (facet.kind == SumFacetKind::kFaceVertex) {
    const auto& [u, v, w] = pair_.a().faces()[facet.a];
    return {{u, facet.b}, {v, facet.b}, {w, facet.b}};
  }
  if (facet.kind == SumFacetKind::kVertexFace) {
    const auto& [u, v, w] = pair_.b().faces()[facet.b];
    return {{facet.a, u}, {facet.a, w}, {facet.a, v}};
  }
  const MeshEdge &d = a_.edges[facet.a], &e = b_.edges[facet.b];
  // Along the first edge and then against the second turns round -d x e.
  std::vector<SumVertex> corners = {
      {d.tail, e.tail}, {d.head, e.tail}, {d.head, e.head}, {d.tail, e.head}};
  if (facet.is_along_cross) std::swap(corners[1], corners[3]);
  return corners;
}

SumPlane ExactSum::Plane(const SumFacet& facet) const {
  const std::vector<SumVertex> corners = Corners(facet);
  const IntegerVector origin = Point(corners[0]);
  SumPlane plane{Cross(Point(corners[1]) - origin, Point(corners[2]) - origin), 0};
  plane.offset = Dot(plane.normal, origin);
  return plane;
}

std::vector<RationalTriangle> ExactSum::Triangles(const SumFacet& facet) const {
  std::vector<RationalPoint> corners;
  for (const SumVertex& corner : Corners(facet)) corners.push_back(ToRationalPoint(Point(corner)));
  std::vector<RationalTriangle> triangles;
  for (std::size_t k = 2; k < corners.size(); ++k) {
    triangles.emplace_back(std::array<RationalPoint, 3>{corners[0], corners[k - 1], corners[k]});
  }
  return triangles;
}

std::optional<RationalPoint> ExactSum::Point(const SumPointName& name,
                                             std::span<const SumFacet> facets) const {
  const auto plane = [&](int i) -> std::optional<SumPlane> {
    const int f = name.facets[i];
    if (f < 0 || f >= std::ssize(facets) || !IsValid(facets[f])) return std::nullopt;
    return Plane(facets[f]);
  };
  const int vertex_count = name.kind == SumPointKind::kVertex      ? 1
                           : name.kind == SumPointKind::kEdgeFacet ? 2
                           : name.kind == SumPointKind::kEdgeEdge  ? 4
                                                                   : 0;
  std::vector<IntegerVector> at;
  for (int k = 0; k < vertex_count; ++k) {
    if (!IsValid(name.vertices[k])) return std::nullopt;
    at.push_back(Point(name.vertices[k]));
  }
  if (name.kind == SumPointKind::kVertex) return ToRationalPoint(at[0]);
  const std::optional<SumPlane> first = plane(0);
  if (!first) return std::nullopt;
  if (name.kind == SumPointKind::kEdgeFacet) return Meet(at[0], at[1], *first);
  if (name.kind == SumPointKind::kEdgeEdge) {
    // Both edges lie in the plane; the second spans another with its normal.
    for (const IntegerVector& x : at) {
      if (Dot(first->normal, x) != first->offset) return std::nullopt;
    }
    SumPlane upright{Cross(first->normal, at[3] - at[2]), 0};
    upright.offset = Dot(upright.normal, at[2]);
    return Meet(at[0], at[1], upright);
  }
  const std::optional<SumPlane> second = plane(1), third = plane(2);
  return second && third ? Meet(*first, *second, *third) : std::nullopt;
}

bool ExactSum::CanTouch(const SumFacet& facet) const {
  const IntegerVector normal = Plane(facet).normal;
  if (IsZero(normal)) return false;
  // No part of A may rise above the contact, and no part of B lie below it.
  const auto rises_from = [&](int v, int w) {
    return DotSign(normal, pair_.point_a(w) - pair_.point_a(v)) > 0;
  };
  const auto drops_from = [&](int v, int w) {
    return DotSign(normal, pair_.point_b(w) - pair_.point_b(v)) < 0;
  };
  if (facet.kind == SumFacetKind::kFaceVertex) {
    return std::none_of(b_.neighbors[facet.b].begin(), b_.neighbors[facet.b].end(),
                        [&](int w) { return drops_from(facet.b, w); });
  }
  if (facet.kind == SumFacetKind::kVertexFace) {
    return std::none_of(a_.neighbors[facet.a].begin(), a_.neighbors[facet.a].end(),
                        [&](int w) { return rises_from(facet.a, w); });
  }
  const MeshEdge &d = a_.edges[facet.a], &e = b_.edges[facet.b];
  if (rises_from(d.tail, d.left_apex) || rises_from(d.tail, d.right_apex) ||
      drops_from(e.tail, e.left_apex) || drops_from(e.tail, e.right_apex)) {
    return false;
  }
  return Bend(d, [&](int v) -> const IntegerVector& { return pair_.point_a(v); }) <= 0 &&
         Bend(e, [&](int v) -> const IntegerVector& { return pair_.point_b(v); }) <= 0;
}

bool ExactSum::IsNeedless(const SumFacet& facet) const {
  switch (facet.kind) {
    case SumFacetKind::kFaceVertex:
      return inner_vertices_b_[facet.b] != 0;
    case SumFacetKind::kVertexFace:
      return inner_vertices_a_[facet.a] != 0;
    case SumFacetKind::kEdgeEdge:
      return flat_edges_a_[facet.a] != 0 || flat_edges_b_[facet.b] != 0;
  }
  return false;
}

std::vector<SumFacet> ExactSum::AllFacets(bool contacts_only) const {
  std::vector<SumFacet> facets;
  const auto add = [&](const SumFacet& facet) {
    const bool is_wanted =
        contacts_only ? !IsNeedless(facet) && CanTouch(facet) : !IsZero(Plane(facet).normal);
    if (is_wanted) facets.push_back(facet);
  };
  for (int f = 0; f < pair_.a().face_count(); ++f) {
    for (int v = 0; v < pair_.b().vertex_count(); ++v) {
      add({SumFacetKind::kFaceVertex, false, f, v});
    }
  }
  for (int v = 0; v < pair_.a().vertex_count(); ++v) {
    for (int f = 0; f < pair_.b().face_count(); ++f) {
      add({SumFacetKind::kVertexFace, false, v, f});
    }
  }
  for (int d = 0; d < std::ssize(a_.edges); ++d) {
    for (int e = 0; e < std::ssize(b_.edges); ++e) {
      for (const bool is_along : {false, true}) add({SumFacetKind::kEdgeEdge, is_along, d, e});
    }
  }
  return facets;
}

ExactTranslation ExactSum::ToTranslation(const RationalPoint& x) const {
  return ExactTranslation(ToTrue(x));
}

RationalPoint ExactSum::ToTrue(const RationalPoint& x) const {
  return {x[0] * unit_, x[1] * unit_, x[2] * unit_};
}

RationalPoint ExactSum::FromDoubles(const Eigen::Vector3d& x) const {
  return {mpq_class(x[0]) / unit_, mpq_class(x[1]) / unit_, mpq_class(x[2]) / unit_};
}

mpq_class ExactSum::StepBelowAnyOther(const RationalPoint& x) const {
  Integer d = 1;
  for (const mpq_class& value : x) d = lcm(d, value.get_den());
  return mpq_class(1, 4 * d * largest_normal_ * largest_normal_);
}

}  // namespace touchstone::exact
