// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/arrangement_internal.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

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

// Facets' planes and corners side by side, for a first look at many pairs.
class FacetTriage {
 public:
  // With n, o and x the roundings of a plane's normal and origin and of a corner, S the sum of n's
  // coordinates and L the largest coordinate of any corner, in size: n.(x - o) is off by at most
  // 3 e_n (2 L + 2 e) + 2 e S where no normal is off by more than e_n, nor a corner by more than e;
  // and n.x - n.o is rounded along paths of three, three and one operations, by (3 + 3 + 2) S L
  // units.
  FacetTriage(const SumGeometry& geometry, std::span<const ArrangedFacet> facets) {
    double largest = 0.0, error = 0.0;
    for (const ArrangedFacet& f : facets) {
      for (const int corner : f.corners) {
        const SumPoint& point = geometry.point(corner);
        largest = std::max(largest, point.rounded.cwiseAbs().maxCoeff());
        error = std::max(error, point.error);
      }
    }
    entries_.reserve(facets.size());
    for (const ArrangedFacet& f : facets) {
      const SumPlane& plane = geometry.plane(f.plane);
      const double sum = plane.normal.cwiseAbs().sum();
      Entry& entry = entries_.emplace_back();
      entry.normal = plane.normal;
      entry.offset = plane.normal.dot(plane.origin);
      entry.bound = 1.01 * (6.0 * plane.normal_error * (largest + error) + 2.0 * error * sum +
                            8.1 * kUnit * sum * largest) +
                    0x1p-1000;
      for (int k = 0; k < 4; ++k) {
        const Vector3d& x = geometry.point(f.corners[k]).rounded;
        for (int i = 0; i < 3; ++i) entry.corners[i][k] = x[i];
      }
    }
  }

  // Whether all corners of facet g, but one that lies in f's plane by its name, lie strictly on one
  // side of that plane; false if doubles cannot tell.
  bool IsClearBut(int f, int g, int corner, std::span<const int> corners_of_g) const {
    const Entry& plane = entries_[f];
    const auto& x = entries_[g].corners;
    bool is_above = true, is_below = true;
    for (int k = 0; k < 4; ++k) {
      if (corners_of_g[k] == corner) continue;
      const double height = plane.normal[0] * x[0][k] + plane.normal[1] * x[1][k] +
                            plane.normal[2] * x[2][k] - plane.offset;
      is_above &= height > plane.bound;
      is_below &= height < -plane.bound;
    }
    return is_above || is_below;
  }

  // Whether all corners of facet g lie strictly on one side of f's plane; false if doubles cannot
  // tell.
  bool IsClear(int f, int g) const {
    const Entry& plane = entries_[f];
    const auto& x = entries_[g].corners;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (int k = 0; k < 4; ++k) {
      const double height = plane.normal[0] * x[0][k] + plane.normal[1] * x[1][k] +
                            plane.normal[2] * x[2][k] - plane.offset;
      low = std::min(low, height);
      high = std::max(high, height);
    }
    return low > plane.bound || high < -plane.bound;
  }

 private:
  struct Entry {
    Vector3d normal;
    double offset, bound;
    double corners[3][4];
  };
  std::vector<Entry> entries_;
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
    ListWalls();
    for (const Group& group : result_.groups) CutWalls(group);
    ListPoints();
    result_.representative = FindEqualPoints(&geometry_, result_.points_of_segments);
    for (Segment& segment : result_.segments) SortPoints(&segment);
    return std::move(result_);
  }

 private:
  struct CrossingPair {
    int f, g;
    Sides of_f, of_g;
  };
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
    result_.box_pairs = static_cast<long>(near.size());
    const FacetTriage triage(geometry_, result_.facets);
    std::erase_if(near, [&](const auto& pair) {
      return triage.IsClear(pair.first, pair.second) || triage.IsClear(pair.second, pair.first);
    });
    // In a fixed order, however they were found: facets come sorted.
    std::sort(near.begin(), near.end());
    for (const auto& [f, g] : near) {
      if (!MeetInACorner(triage, f, g)) ClassifyPair(f, g);
    }
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

  // Whether the facets share one corner and certainly nothing else: neither cuts the other then,
  // and a plane may have two names. Round a vertex of M many facets do.
  bool MeetInACorner(const FacetTriage& triage, int f, int g) const {
    const ArrangedFacet &x = facet(f), &y = facet(g);
    int place_x = -1, place_y = -1;
    for (int k = 0; k < x.count; ++k) {
      for (int l = 0; l < y.count; ++l) {
        if (x.corners[k] != y.corners[l]) continue;
        if (place_x >= 0) return false;
        place_x = k;
        place_y = l;
      }
    }
    if (place_x < 0) return false;
    const int corner = x.corners[place_x];
    return triage.IsClearBut(f, g, corner, y.corners) ||
           triage.IsClearBut(g, f, corner, x.corners) || PartAtCorner(x, place_x, y) ||
           PartAtCorner(y, place_y, x);
  }

  // Whether the plane through an edge of x at a corner and parallel to a coordinate axis parts what
  // else there is of x from all of y but that corner, as far as doubles can tell.
  bool PartAtCorner(const ArrangedFacet& x, int place, const ArrangedFacet& y) const {
    int axis = 0;
    geometry_.plane(x.plane).normal.cwiseAbs().maxCoeff(&axis);
    const int corner = x.corners[place];
    for (const int step : {1, x.count - 1}) {
      const int end = x.corners[(place + step) % x.count];
      // The side that all but the two lie on; 0: not one side, or doubles cannot tell.
      const auto side_of = [&](const ArrangedFacet& other) {
        int side = 0;
        for (int k = 0; k < other.count; ++k) {
          const int point = other.corners[k];
          if (point == corner || (&other == &x && point == end)) continue;
          const int turn = SumGeometry::TriageTurn(geometry_.point(corner), geometry_.point(end),
                                                   geometry_.point(point), axis);
          if (turn == 0 || turn == -side) return 0;
          side = turn;
        }
        return side;
      };
      const int side = side_of(x);
      if (side != 0 && side_of(y) == -side) return true;
    }
    return false;
  }

  void ClassifyPair(int f, int g) {
    if (AreNeighbors(f, g) || LieAcrossAnEdge(f, g)) return;
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

  // Whether the facets share an edge that they pass in opposite senses, and certainly face more or
  // less the same way: if their planes are one they lie on either side of the edge, else they share
  // no more than it. Neither cuts the other, and a plane may have two names.
  bool LieAcrossAnEdge(int f, int g) const {
    const ArrangedFacet &x = facet(f), &y = facet(g);
    for (int k = 0; k < x.count; ++k) {
      for (int l = 0; l < y.count; ++l) {
        if (x.corners[k] != y.corners[(l + 1) % y.count] ||
            x.corners[(k + 1) % x.count] != y.corners[l]) {
          continue;
        }
        const SumPlane &p = geometry_.plane(x.plane), &q = geometry_.plane(y.plane);
        return TriageSign(HeightAlong(p.normal, p.normal_error, q.normal, q.normal_error)) > 0;
      }
    }
    return false;
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
        {pair.f, pair.g, !of_f->is_on_edge, !of_g->is_on_edge, axis, {from, to}, {}});
    const int group_f = group_of_facet_[pair.f], group_g = group_of_facet_[pair.g];
    if (GroupIsActive(group_f)) {
      walls_.push_back({group_f, {number, plane_g, pair.f, pair.g, false}});
    }
    if (GroupIsActive(group_g)) {
      walls_.push_back({group_g, {number, plane_f, pair.g, pair.f, false}});
    }
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
  const std::span<const char> is_active_;
  Arrangement result_;
  std::vector<CrossingPair> crossing_;
  std::vector<int> group_of_facet_;
  std::vector<char> group_is_active_;
  std::vector<GroupWall> walls_;
  std::vector<Cut> cuts_;  // points within segments
  std::vector<Box3> wall_boxes_;
};

}  // namespace

Arrangement Arrange(SumGeometry* geometry, std::span<const SumFacet> facets,
                    std::span<const char> is_active) {
  return Arranger(geometry, facets, is_active).Run();
}

}  // namespace touchstone::internal
