// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/sum_geometry_internal.h"

#include <algorithm>
#include <limits>

#include "touchstone/core/minkowski/bounded_vector_internal.h"

namespace touchstone::internal {
namespace {

using Eigen::Vector3d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

BoundedVector FacetNormal(const MeshPair& pair, const SumFacet& facet) {
  if (facet.kind == SumFacetKind::kFaceVertex) {
    const FacePlane& plane = pair.a().planes[facet.a];
    return {plane.normal, plane.error};
  }
  if (facet.kind == SumFacetKind::kVertexFace) {
    const FacePlane& plane = pair.b().planes[facet.b];
    return {-plane.normal, plane.error};
  }
  const auto edge_of = [](const PlacedMesh& placed, int edge) {
    const int h = placed.mesh.half_edge_of(edge);
    const Vector3d way = placed.points[placed.mesh.head(h)] - placed.points[placed.mesh.tail(h)];
    return BoundedVector{way, 1.01 * (2.0 * placed.point_error + kUnit * MaxAbs(way))};
  };
  const BoundedVector a = edge_of(pair.a(), facet.a), b = edge_of(pair.b(), facet.b);
  BoundedVector cross = CrossOf(a.value, a.error, b.value, b.error);
  if (!facet.is_along_cross) cross.value = -cross.value;
  return cross;
}

void SumGeometry::Reset() {
  exact_pair_.reset();
  points_.clear();
  planes_.clear();
  roots_.clear();
  turns_.clear();
  for (NumberTable* table : {&point_numbers_, &edge_planes_, &turn_numbers_}) table->Clear();
  exact_points_.Clear();
  exact_planes_.Clear();
  exact_count_ = 0;
}

// Two corners and two points on crossings a facet, or so.
void SumGeometry::Reserve(std::size_t facets) {
  points_.reserve(4 * facets);
  planes_.reserve(2 * facets);
  roots_.reserve(2 * facets);
  point_numbers_.Reserve(4 * facets);
}

int SumGeometry::Add(SumPointForm form, const std::array<int, 3>& parts) {
  const int number = point_numbers_.Insert(
      NumberTable::Hash({static_cast<int>(form), parts[0], parts[1], parts[2]}), point_count(),
      [&](int i) {
        const SumPoint& x = points_[i];
        return x.form == form && x.parts[0] == parts[0] && x.parts[1] == parts[1] &&
               x.parts[2] == parts[2];
      });
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

int SumGeometry::AddFacetPlane(const SumFacet& facet, const std::array<int, 4>& corners) {
  const BoundedVector normal = FacetNormal(pair_, facet);
  SumPlane& plane = planes_.emplace_back();
  plane.normal = normal.value;
  plane.normal_error = normal.error;
  plane.points = corners;
  plane.facet = facet;
  plane.origin = points_[corners[0]].rounded;
  plane.origin_error = points_[corners[0]].error;
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

}  // namespace touchstone::internal
