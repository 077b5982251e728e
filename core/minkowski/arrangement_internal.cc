// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/arrangement_internal.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "touchstone/core/mesh/box_tree.h"
#include "touchstone/core/minkowski/box_lanes_internal.h"
#include "touchstone/core/minkowski/equal_points_internal.h"
#include "touchstone/core/minkowski/flat_table_internal.h"

namespace touchstone::internal {
namespace {

using Eigen::Vector3d;

// The sides of another plane that a facet's corners lie on.
using Sides = std::array<signed char, 4>;

// What a plane cuts from a convex facet.
struct Trace {
  int from, to;     // points
  bool is_on_edge;  // along an edge of the facet, rather than through its inside
};

class Arranger {
 public:
  Arranger(SumGeometry* geometry, std::span<const SumFacet> names, std::span<const char> is_active)
      : geometry_(*geometry), is_active_(is_active) {
    result_.facets.reserve(names.size());
    for (const SumFacet& name : names) {
      const SumCorners corners = CornersOf(geometry_.pair(), name);
      ArrangedFacet facet{name, {}, corners.count, -1};
      for (int k = 0; k < 4; ++k) {
        facet.corners[k] = geometry_.AddVertex(corners.vertices[std::min(k, corners.count - 1)]);
      }
      facet.plane = geometry_.AddFacetPlane(name, facet.corners);
      result_.facets.push_back(facet);
    }
  }

  Arrangement Run() {
    FindCrossingPairs();
    FormGroups();
    AddEdges();
    for (const CrossingPair& pair : crossing_) AddCrossing(pair);
    for (Group& group : result_.groups) CutWalls(group);
    result_.representative = FindEqualPoints(&geometry_, result_.segments);
    for (Segment& segment : result_.segments) SortPoints(&segment);
    return std::move(result_);
  }

 private:
  struct CrossingPair {
    int f, g;
    Sides of_f, of_g;
  };

  const ArrangedFacet& facet(int f) const { return result_.facets[f]; }
  bool IsActive(int f) const { return is_active_.empty() || is_active_[f] != 0; }
  bool IsActive(const Group& group) const {
    return std::any_of(group.facets.begin(), group.facets.end(),
                       [&](int f) { return IsActive(f); });
  }

  // Pairs of facets that are not clear of each other's planes; coplanar ones are united.
  void FindCrossingPairs() {
    std::vector<Box3> boxes;
    boxes.reserve(result_.facets.size());
    for (const ArrangedFacet& f : result_.facets) {
      Box3 box{geometry_.point(f.corners[0]).rounded, geometry_.point(f.corners[0]).rounded};
      for (const int corner : f.corners) {
        const SumPoint& point = geometry_.point(corner);
        box.low = box.low.cwiseMin(point.rounded - Vector3d::Constant(point.error));
        box.high = box.high.cwiseMax(point.rounded + Vector3d::Constant(point.error));
      }
      boxes.push_back(box);
    }
    std::vector<std::pair<int, int>> near;
    if (is_active_.empty()) {
      BoxTree(boxes).MeetingItems(&near);
    } else {
      FindNearActive(boxes, &near);
    }
    // In a fixed order, however they were found: facets come sorted.
    std::sort(near.begin(), near.end());
    result_.box_pairs = static_cast<long>(near.size());
    for (const auto& [f, g] : near) ClassifyPair(f, g);
  }

  // Pairs with an active facet, whose boxes meet: each active one against all, in lanes. Few are
  // active; a tree would find the pairs of the others, too.
  void FindNearActive(std::span<const Box3> boxes, std::vector<std::pair<int, int>>* near) const {
    const BoxLanes lanes(boxes);
    std::vector<int> hits;
    for (int f = 0; f < static_cast<int>(boxes.size()); ++f) {
      if (!IsActive(f)) continue;
      hits.clear();
      lanes.Meeting(boxes[f], &hits);
      for (const int g : hits) {
        if (g != f && (!IsActive(g) || f < g)) near->push_back(std::minmax(f, g));
      }
    }
  }

  void ClassifyPair(int f, int g) {
    if (AreNeighbors(f, g)) return;
    CrossingPair pair{f, g, {}, {}};
    if (!FindSides(g, facet(f).plane, &pair.of_g)) return;
    if (std::all_of(pair.of_g.begin(), pair.of_g.end(), [](int side) { return side == 0; })) {
      geometry_.Unite(facet(f).plane, facet(g).plane);
      return;
    }
    if (ShareAnEdge(f, g)) return;
    if (!FindSides(f, facet(g).plane, &pair.of_f)) return;
    crossing_.push_back(pair);
  }

  // Whether the facets are two faces of one body that share an edge, against one vertex of the
  // other: embedded surfaces do not fold, so they share no more.
  bool AreNeighbors(int f, int g) const {
    const SumFacet &x = facet(f).name, &y = facet(g).name;
    if (x.kind != y.kind || x.kind == SumFacetKind::kEdgeEdge) return false;
    const bool is_face_of_a = x.kind == SumFacetKind::kFaceVertex;
    if (is_face_of_a ? x.b != y.b : x.a != y.a) return false;
    return ShareAnEdge(f, g);
  }

  // The sides that a facet's corners lie on; false if all lie strictly on one side.
  bool FindSides(int f, int plane, Sides* sides) {
    int least = 1, greatest = -1;
    for (int k = 0; k < facet(f).count; ++k) {
      const int side = geometry_.Side(facet(f).corners[k], plane);
      (*sides)[k] = static_cast<signed char>(side);
      least = std::min(least, side);
      greatest = std::max(greatest, side);
    }
    return least <= 0 && greatest >= 0;
  }

  bool ShareAnEdge(int f, int g) const {
    int shared = 0;
    for (int k = 0; k < facet(f).count; ++k) {
      for (int l = 0; l < facet(g).count; ++l) {
        shared += facet(f).corners[k] == facet(g).corners[l];
      }
    }
    return shared >= 2;
  }

  void FormGroups() {
    std::unordered_map<int, int> group_of_root;
    group_of_facet_.resize(result_.facets.size());
    for (std::size_t f = 0; f < result_.facets.size(); ++f) {
      const int root = geometry_.Root(facet(static_cast<int>(f)).plane);
      const auto [place, added] =
          group_of_root.try_emplace(root, static_cast<int>(result_.groups.size()));
      if (added) result_.groups.push_back({root, {}, {}});
      result_.groups[place->second].facets.push_back(static_cast<int>(f));
      group_of_facet_[f] = place->second;
    }
  }

  void AddEdges() {
    FlatTable segment_of_edge;
    for (std::size_t f = 0; f < result_.facets.size(); ++f) {
      const ArrangedFacet& own = result_.facets[f];
      Group& group = result_.groups[group_of_facet_[f]];
      if (!IsActive(group)) continue;
      const int axis = geometry_.NormalAxis(group.plane);
      const bool agrees =
          own.plane == group.plane || geometry_.NormalsAgree(own.plane, group.plane) > 0;
      for (int k = 0; k < own.count; ++k) {
        const int u = own.corners[k], v = own.corners[(k + 1) % own.count];
        const auto [number, added] = segment_of_edge.Insert(
            {std::min(u, v), std::max(u, v), 0, 0}, static_cast<int>(result_.segments.size()));
        if (added) {
          Segment segment;
          segment.axis = EdgeAxis(u, v);
          segment.points = {std::min(u, v), std::max(u, v)};
          result_.segments.push_back(std::move(segment));
        }
        group.walls.push_back({number, geometry_.AddEdgePlane(u, v, axis), static_cast<int>(f), -1,
                               (u < v) == agrees});
      }
    }
  }

  // A coordinate in which two vertices certainly differ, by as much as any.
  int EdgeAxis(int u, int v) {
    const SumPoint &p = geometry_.point(u), &q = geometry_.point(v);
    int axis = 0;
    if ((p.rounded - q.rounded).cwiseAbs().maxCoeff(&axis) > 2.1 * (p.error + q.error)) return axis;
    for (axis = 0; axis < 2; ++axis) {
      if (geometry_.Compare(u, v, axis) != 0) return axis;
    }
    return axis;
  }

  // Nothing where the plane only touches a corner.
  std::optional<Trace> TraceOf(int f, const Sides& sides, int plane) {
    const ArrangedFacet& own = facet(f);
    int points[4], count = 0, zeros = 0;
    bool is_on_edge = false;
    for (int k = 0; k < own.count; ++k) {
      const int next = (k + 1) % own.count;
      if (sides[k] == 0) {
        points[count++] = own.corners[k];
        ++zeros;
        is_on_edge |= sides[next] == 0;
      } else if (sides[k] * sides[next] < 0) {
        points[count++] = geometry_.AddOnEdge(own.corners[k], own.corners[next], plane);
      }
    }
    if (count < 2) return std::nullopt;
    return Trace{points[0], points[1], is_on_edge};
  }

  void AddCrossing(const CrossingPair& pair) {
    const int plane_f = geometry_.Root(facet(pair.f).plane);
    const int plane_g = geometry_.Root(facet(pair.g).plane);
    std::optional<Trace> of_f = TraceOf(pair.f, pair.of_f, plane_g);
    if (!of_f) return;
    std::optional<Trace> of_g = TraceOf(pair.g, pair.of_g, plane_f);
    if (!of_g) return;
    const int axis = geometry_.LineAxis(plane_f, plane_g);
    for (Trace* trace : {&*of_f, &*of_g}) {
      if (geometry_.Compare(trace->from, trace->to, axis) > 0) std::swap(trace->from, trace->to);
    }
    const int from = geometry_.Compare(of_f->from, of_g->from, axis) >= 0 ? of_f->from : of_g->from;
    const int to = geometry_.Compare(of_f->to, of_g->to, axis) <= 0 ? of_f->to : of_g->to;
    if (geometry_.Compare(from, to, axis) >= 0) return;
    ++result_.crossings;
    const int number = static_cast<int>(result_.segments.size());
    result_.segments.push_back(
        {pair.f, pair.g, !of_f->is_on_edge, !of_g->is_on_edge, axis, {from, to}});
    Group &group_f = result_.groups[group_of_facet_[pair.f]],
          &group_g = result_.groups[group_of_facet_[pair.g]];
    if (IsActive(group_f)) group_f.walls.push_back({number, plane_g, pair.f, pair.g, false});
    if (IsActive(group_g)) group_g.walls.push_back({number, plane_f, pair.g, pair.f, false});
  }

  // Adds to each wall's segment the points in which the group's other walls meet it.
  void CutWalls(const Group& group) {
    std::vector<Box3> boxes;
    for (const Wall& wall : group.walls) {
      const Segment& segment = result_.segments[wall.segment];
      const SumPoint &a = geometry_.point(segment.points[0]),
                     &b = geometry_.point(segment.points[1]);
      const double error = std::max(a.error, b.error);
      boxes.push_back({a.rounded.cwiseMin(b.rounded) - Vector3d::Constant(error),
                       a.rounded.cwiseMax(b.rounded) + Vector3d::Constant(error)});
    }
    const auto meet = [&](std::size_t i, std::size_t j) {
      // False for NaN, too: a point that doubles do not know has a box that meets all.
      return !((boxes[i].low.array() > boxes[j].high.array()).any() ||
               (boxes[j].low.array() > boxes[i].high.array()).any());
    };
    for (std::size_t i = 0; i < group.walls.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (group.walls[i].segment != group.walls[j].segment && meet(i, j)) {
          MeetWalls(group, group.walls[i], group.walls[j]);
        }
      }
    }
  }

  void MeetWalls(const Group& group, const Wall& s, const Wall& t) {
    const std::array<int, 2> ends_s = Ends(s), ends_t = Ends(t);
    const auto sides = [&](const std::array<int, 2>& points, const Wall& wall,
                           const std::array<int, 2>& ends) {
      std::array<int, 2> result;
      for (int k = 0; k < 2; ++k) {
        const bool is_end = points[k] == ends[0] || points[k] == ends[1];
        result[k] = is_end ? 0 : geometry_.Side(points[k], wall.line_plane);
      }
      return result;
    };
    const auto of_t = sides(ends_t, s, ends_s);
    if (of_t[0] * of_t[1] > 0) return;
    const auto of_s = sides(ends_s, t, ends_t);
    if (of_s[0] * of_s[1] > 0) return;
    for (int k = 0; k < 2; ++k) {
      if (of_t[k] == 0) AddIfWithin(ends_t[k], s.segment);
      if (of_s[k] == 0) AddIfWithin(ends_s[k], t.segment);
    }
    if (of_t[0] * of_t[1] < 0 && of_s[0] * of_s[1] < 0) {
      const int point = CrossingPoint(group, s, t);
      result_.segments[s.segment].points.push_back(point);
      result_.segments[t.segment].points.push_back(point);
    }
  }

  std::array<int, 2> Ends(const Wall& wall) const {
    const std::vector<int>& points = result_.segments[wall.segment].points;
    return {points[0], points[1]};
  }

  // A point of the segment's line: within the segment?
  void AddIfWithin(int point, int number) {
    Segment& segment = result_.segments[number];
    const int from = segment.points[0], to = segment.points[1];
    if (point == from || point == to) return;
    if (geometry_.Compare(point, from, segment.axis) * geometry_.Compare(point, to, segment.axis) <
        0) {
      segment.points.push_back(point);
    }
  }

  int CrossingPoint(const Group& group, const Wall& s, const Wall& t) {
    const Segment &of_s = result_.segments[s.segment], &of_t = result_.segments[t.segment];
    if (of_s.is_edge() && !of_t.is_edge()) {
      return geometry_.AddOnEdge(of_s.points[0], of_s.points[1], t.line_plane);
    }
    if (of_t.is_edge() && !of_s.is_edge()) {
      return geometry_.AddOnEdge(of_t.points[0], of_t.points[1], s.line_plane);
    }
    return geometry_.AddOfPlanes(group.plane, s.line_plane, t.line_plane);
  }

  void SortPoints(Segment* segment) {
    std::vector<int>& points = segment->points;
    for (int& point : points) point = result_.representative[point];
    const bool rises = geometry_.Compare(points[0], points[1], segment->axis) < 0;
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    std::sort(points.begin(), points.end(), [&](int x, int y) {
      return geometry_.Compare(x, y, segment->axis) * (rises ? 1 : -1) < 0;
    });
  }

  SumGeometry& geometry_;
  const std::span<const char> is_active_;
  Arrangement result_;
  std::vector<CrossingPair> crossing_;
  std::vector<int> group_of_facet_;
};

}  // namespace

Arrangement Arrange(SumGeometry* geometry, std::span<const SumFacet> facets,
                    std::span<const char> is_active) {
  return Arranger(geometry, facets, is_active).Run();
}

}  // namespace touchstone::internal
