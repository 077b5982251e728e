// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/arrangement_internal.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "touchstone/core/mesh/box_tree.h"
#include "touchstone/core/minkowski/equal_points_internal.h"
#include "touchstone/core/minkowski/facet_crossing_internal.h"
#include "touchstone/core/minkowski/flat_table_internal.h"

namespace touchstone::internal {
namespace {

using Eigen::Vector3d;

class Arranger {
 public:
  Arranger(SumGeometry* geometry, std::span<const SumFacet> names, std::span<const char> is_active)
      : geometry_(*geometry), is_active_(is_active) {
    geometry_.Reserve(names.size());
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

  // What may cross: the pairs given, or all.
  Arrangement Run(std::optional<std::span<const std::pair<int, int>>> near) {
    const FacetPairs crossing = FindCrossingFacets(&geometry_, result_.facets, near);
    result_.box_pairs = crossing.box_pairs;
    FormGroups();
    AddEdges();
    for (const FacetPair& pair : crossing.pairs) AddCrossing(pair);
    ListWalls();
    for (const Group& group : result_.groups) CutWalls(group);
    ListPoints();
    result_.representative = FindEqualPoints(&geometry_, result_.points_of_segments);
    for (Segment& segment : result_.segments) SortPoints(&segment);
    return std::move(result_);
  }

 private:
  struct GroupWall {
    int group;
    Wall wall;
  };
  struct Cut {
    int segment, point;
  };

  const ArrangedFacet& facet(int f) const { return result_.facets[f]; }
  int group_count() const { return static_cast<int>(result_.groups.size()); }
  bool IsActive(int f) const { return is_active_.empty() || is_active_[f] != 0; }
  bool GroupIsActive(int group) const { return group_is_active_[group] != 0; }

  void FormGroups() {
    // Facets' planes come first, so that their roots are below the number of facets.
    std::vector<int> group_of_root(result_.facets.size(), -1);
    group_of_facet_.reserve(result_.facets.size());
    for (const ArrangedFacet& f : result_.facets) {
      const int root = geometry_.Root(f.plane);
      if (group_of_root[root] < 0) {
        group_of_root[root] = group_count();
        result_.groups.push_back({root, {}, {}});
      }
      group_of_facet_.push_back(group_of_root[root]);
    }
    const auto facets = ListByOwner<int>(group_count(), [&](const auto& visit) {
      for (int f = 0; f < static_cast<int>(group_of_facet_.size()); ++f) {
        visit(group_of_facet_[f], f);
      }
    });
    result_.facets_of_groups = facets.items;
    group_is_active_.assign(result_.groups.size(), 0);
    for (int g = 0; g < group_count(); ++g) {
      Group& group = result_.groups[g];
      group.facets = std::span(result_.facets_of_groups)
                         .subspan(facets.first[g], facets.first[g + 1] - facets.first[g]);
      for (const int f : group.facets) group_is_active_[g] |= IsActive(f);
    }
  }

  void AddEdges() {
    PairTable edges(geometry_.point_count());
    for (std::size_t f = 0; f < result_.facets.size(); ++f) {
      const ArrangedFacet& own = result_.facets[f];
      const int number = group_of_facet_[f];
      if (!GroupIsActive(number)) continue;
      const Group& group = result_.groups[number];
      const bool agrees =
          own.plane == group.plane || geometry_.NormalsAgree(own.plane, group.plane) > 0;
      for (int k = 0; k < own.count; ++k) {
        const int u = own.corners[k], v = own.corners[(k + 1) % own.count];
        const auto [small, large] = std::minmax(u, v);
        const auto [segment, added] = edges.Insert(small, large);
        if (added) {
          result_.segments.push_back({-1, -1, false, false, EdgeAxis(u, v), {small, large}, {}});
        }
        walls_.push_back({number, {segment, -1, static_cast<int>(f), -1, (u < v) == agrees}});
      }
    }
  }

  // Groups of more than one facet, or with more walls than its edges, are cut; only there do edges
  // need planes along them.
  void ListWalls() {
    auto walls = ListByOwner<Wall>(group_count(), [&](const auto& visit) {
      for (const GroupWall& each : walls_) visit(each.group, each.wall);
    });
    walls_ = {};
    result_.walls_of_groups = std::move(walls.items);
    const std::span<Wall> all(result_.walls_of_groups);
    for (int g = 0; g < group_count(); ++g) {
      Group& group = result_.groups[g];
      const std::span<Wall> own = all.subspan(walls.first[g], walls.first[g + 1] - walls.first[g]);
      group.walls = own;
      group.is_cut = group.facets.size() > 1 || std::ssize(own) != facet(group.facets[0]).count;
      if (!group.is_cut || own.empty()) continue;
      const int axis = geometry_.NormalAxis(group.plane);
      for (Wall& wall : own) {
        if (wall.other >= 0) continue;
        const std::array<int, 2>& ends = result_.segments[wall.segment].ends;
        wall.line_plane = geometry_.AddEdgePlane(ends[0], ends[1], axis);
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

  void AddCrossing(const FacetPair& pair) {
    const int f = pair.f, g = pair.g;
    const std::optional<FacetCrossing> crossing = CrossingOf(&geometry_, result_.facets, pair);
    if (!crossing) return;
    ++result_.crossings;
    const int number = static_cast<int>(result_.segments.size());
    result_.segments.push_back(
        {f, g, crossing->is_inside_f, crossing->is_inside_g, crossing->axis, crossing->ends, {}});
    const auto add = [&](int own, int other) {
      const int group = group_of_facet_[own], plane = geometry_.Root(facet(other).plane);
      if (GroupIsActive(group)) walls_.push_back({group, {number, plane, own, other, false}});
    };
    add(f, g);
    add(g, f);
  }

  // Adds to each wall's segment the points in which the group's other walls meet it.
  void CutWalls(const Group& group) {
    if (!group.is_cut) return;
    std::vector<Box3>& boxes = wall_boxes_;
    boxes.clear();
    for (const Wall& wall : group.walls) {
      const std::array<int, 2> ends = Ends(wall);
      const SumPoint &a = geometry_.point(ends[0]), &b = geometry_.point(ends[1]);
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
    if (GoOnFromAnEnd(ends_s, ends_t)) return;
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
      cuts_.push_back({s.segment, point});
      cuts_.push_back({t.segment, point});
    }
  }

  // Whether two segments have one end in common and certainly lie on either side of it along some
  // axis: as the traces of two neighbouring facets do, on lines that are nearly one.
  bool GoOnFromAnEnd(const std::array<int, 2>& s, const std::array<int, 2>& t) const {
    for (int i = 0; i < 2; ++i) {
      for (int j = 0; j < 2; ++j) {
        if (s[i] != t[j]) continue;
        const SumPoint &at = geometry_.point(s[i]), &u = geometry_.point(s[1 - i]),
                       &v = geometry_.point(t[1 - j]);
        // 1.01: the difference's rounding.
        const double least_u = 1.01 * (u.error + at.error);
        const double least_v = 1.01 * (v.error + at.error);
        for (int axis = 0; axis < 3; ++axis) {
          const double to_u = u.rounded[axis] - at.rounded[axis];
          const double to_v = v.rounded[axis] - at.rounded[axis];
          if ((to_u > least_u && to_v < -least_v) || (to_u < -least_u && to_v > least_v)) {
            return true;
          }
        }
        return false;
      }
    }
    return false;
  }

  std::array<int, 2> Ends(const Wall& wall) const { return result_.segments[wall.segment].ends; }

  // A point of the segment's line: within the segment?
  void AddIfWithin(int point, int number) {
    const Segment& segment = result_.segments[number];
    const auto [from, to] = segment.ends;
    if (point == from || point == to) return;
    if (geometry_.Compare(point, from, segment.axis) * geometry_.Compare(point, to, segment.axis) <
        0) {
      cuts_.push_back({number, point});
    }
  }

  int CrossingPoint(const Group& group, const Wall& s, const Wall& t) {
    const Segment &of_s = result_.segments[s.segment], &of_t = result_.segments[t.segment];
    if (of_s.is_edge() && !of_t.is_edge()) {
      return geometry_.AddOnEdge(of_s.ends[0], of_s.ends[1], t.line_plane);
    }
    if (of_t.is_edge() && !of_s.is_edge()) {
      return geometry_.AddOnEdge(of_t.ends[0], of_t.ends[1], s.line_plane);
    }
    return geometry_.AddOfPlanes(group.plane, s.line_plane, t.line_plane);
  }

  // Each segment's ends first, then what lies between.
  void ListPoints() {
    const int count = static_cast<int>(result_.segments.size());
    auto points = ListByOwner<int>(count, [&](const auto& visit) {
      for (int s = 0; s < count; ++s) {
        for (const int end : result_.segments[s].ends) visit(s, end);
      }
      for (const Cut& cut : cuts_) visit(cut.segment, cut.point);
    });
    cuts_ = {};
    result_.points_of_segments = std::move(points.items);
    for (int s = 0; s < count; ++s) {
      result_.segments[s].points =
          std::span(result_.points_of_segments)
              .subspan(points.first[s], points.first[s + 1] - points.first[s]);
    }
  }

  void SortPoints(Segment* segment) {
    const auto begin = result_.points_of_segments.begin() +
                       (segment->points.data() - result_.points_of_segments.data());
    auto end = begin + std::ssize(segment->points);
    for (auto point = begin; point != end; ++point) *point = result_.representative[*point];
    if (end - begin == 2) return;
    const bool rises = geometry_.Compare(begin[0], begin[1], segment->axis) < 0;
    std::sort(begin, end);
    end = std::unique(begin, end);
    std::sort(begin, end, [&](int x, int y) {
      return geometry_.Compare(x, y, segment->axis) * (rises ? 1 : -1) < 0;
    });
    segment->points = segment->points.first(static_cast<std::size_t>(end - begin));
  }

  SumGeometry& geometry_;
  const std::span<const char> is_active_;  // empty: all are
  Arrangement result_;
  std::vector<int> group_of_facet_;
  std::vector<char> group_is_active_;
  std::vector<GroupWall> walls_;
  std::vector<Cut> cuts_;  // points within segments
  std::vector<Box3> wall_boxes_;
};

}  // namespace

Arrangement Arrange(SumGeometry* geometry, std::span<const SumFacet> facets) {
  return Arranger(geometry, facets, {}).Run(std::nullopt);
}

Arrangement Arrange(SumGeometry* geometry, std::span<const SumFacet> facets,
                    std::span<const char> is_active, std::span<const std::pair<int, int>> near) {
  return Arranger(geometry, facets, is_active).Run(near);
}

}  // namespace touchstone::internal
