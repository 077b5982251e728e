// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/cells_internal.h"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <utility>

#include "touchstone/core/minkowski/cell_lists_internal.h"
#include "touchstone/core/minkowski/wall_graph_internal.h"

namespace touchstone::internal {
namespace {

// One group at a time.
class GroupCells {
 public:
  GroupCells(SumGeometry* geometry, const Arrangement& arrangement, const PieceTable& table,
             CellLists* cells)
      : geometry_(*geometry),
        arrangement_(arrangement),
        table_(table),
        cells_(*cells),
        graph_(geometry, arrangement, table) {}

  void Run(int group) {
    number_ = group;
    group_ = &arrangement_.groups[group];
    if (!group_->is_cut) {
      EmitUncut();
      return;
    }
    graph_.Build(*group_);
    TraceLoops();
    FindOuterLoops();
    PlaceParts();
    FindCovers();
    Emit();
  }

 private:
  struct Loop {
    int first;              // a half-edge
    bool is_outer = false;  // bounds its part of the graph from outside
    int part;
    int container = -1;  // for an outer loop: the loop that it lies in, if any
    bool is_buried = false;
    int first_cover = 0, cover_count = 0;  // facets, in covers_
  };

  // A facet alone in its plane that nothing crosses: its walls are its edges, in order.
  void EmitUncut() {
    cells_.BeginCell(number_);
    cells_.AddFacet(group_->facets[0]);
    cells_.BeginAgainst();
    for (const Wall& wall : group_->walls) {
      const std::span<const int> points = arrangement_.segments[wall.segment].points;
      const int pieces = static_cast<int>(points.size()) - 1;
      for (int k = 0; k < pieces; ++k) {
        cells_.AddToLoop(wall.facet_is_left ? points[k] : points[pieces - k],
                         table_.PieceOf(wall.segment, wall.facet_is_left ? k : pieces - 1 - k));
      }
    }
    cells_.EndLoop(false);
  }

  const ArrangedFacet& facet(int f) const { return arrangement_.facets[f]; }

  void TraceLoops() {
    const int count = graph_.half_edge_count();
    loops_.clear();
    loop_of_.assign(static_cast<std::size_t>(count), -1);
    for (int first = 0; first < count; ++first) {
      if (loop_of_[first] >= 0) continue;
      const int number = static_cast<int>(loops_.size());
      loops_.push_back({first, false, -1});
      for (int h = first; loop_of_[h] < 0; h = graph_.Next(h)) loop_of_[h] = number;
    }
    for (int h = 0; h < count; ++h) {
      Loop& loop = loops_[loop_of_[h]];
      loop.is_buried = loop.is_buried || IsBuriedBeside(h);
    }
  }

  // Whether a facet that passes along the half-edge, with its inside, has the half-edge's left on
  // its inner side. Along d = n x m the left of the plane with normal n lies below the plane with
  // normal m: d's left is n x d, and m . (n x (n x m)) = (n . m)² - |n|² |m|² < 0.
  bool IsBuriedBeside(int h) {
    for (int r = graph_.edge_of(h).first_run; r >= 0; r = graph_.run(r).next) {
      const Wall& wall = group_->walls[graph_.run(r).wall];
      if (wall.other < 0) continue;
      const Segment& segment = arrangement_.segments[wall.segment];
      const bool is_inside =
          wall.other == segment.facet_f ? segment.is_inside_f : segment.is_inside_g;
      if (!is_inside) continue;
      // Sense is along the edge's own line plane; the crossing facet's normal may be another.
      const int plane = facet(wall.other).plane;
      const int sense =
          plane == graph_.edge_of(h).line_plane ? graph_.Sense(h) : SenseAlong(h, plane);
      if (sense > 0) return true;
    }
    return false;
  }

  // 1 if the half-edge runs along (group normal) x (the plane's normal).
  int SenseAlong(int h, int plane) {
    const int line_plane = graph_.edge_of(h).line_plane;
    const int axis = geometry_.LineAxis(group_->plane, plane);
    return graph_.Sense(h) * geometry_.LineAlong(group_->plane, line_plane, axis) *
           geometry_.LineAlong(group_->plane, plane, axis);
  }

  // Parts of the graph that hang together, and the loop that bounds each from outside: it passes
  // the sector that opens backwards at the part's first point in the order of coordinates.
  void FindOuterLoops() {
    std::vector<int>& part = part_of_point_;
    part.resize(static_cast<std::size_t>(graph_.point_count()));
    std::iota(part.begin(), part.end(), 0);
    const auto find = [&](int p) {
      while (part[p] != p) p = part[p] = part[part[p]];
      return p;
    };
    for (const WallEdge& edge : graph_.edges()) part[find(edge.tail)] = find(edge.head);
    normal_axis_ = geometry_.NormalAxis(group_->plane);
    parts_.clear();
    part_of_root_.assign(part.size(), -1);
    for (int p = 0; p < graph_.point_count(); ++p) {
      int& number = part_of_root_[find(p)];
      if (number < 0) {
        number = static_cast<int>(parts_.size());
        parts_.push_back({p, -1});
      } else if (IsBefore(p, parts_[number].first_point)) {
        parts_[number].first_point = p;
      }
    }
    for (Loop& loop : loops_) loop.part = part_of_root_[find(graph_.Tail(loop.first))];
    for (Part& each : parts_) {
      const std::span<const int> round = graph_.Round(each.first_point);
      // All half-edges lie within less than half a turn: the gap after the last one is wider.
      int last = round[0];
      for (std::size_t k = 0; k < round.size() && round.size() > 1; ++k) {
        if (graph_.Turn(round[k], round[(k + 1) % round.size()]) < 0) last = round[k];
      }
      each.outer_loop = loop_of_[last];
      loops_[each.outer_loop].is_outer = true;
    }
  }

  bool IsBefore(int p, int q) {
    const int i = (normal_axis_ + 1) % 3, j = (normal_axis_ + 2) % 3;
    const int sign = geometry_.Compare(graph_.point(p), graph_.point(q), i);
    return sign != 0 ? sign < 0 : geometry_.Compare(graph_.point(p), graph_.point(q), j) < 0;
  }

  // Whether a point off the loop's part lies inside the loop.
  bool IsInside(int p, const Loop& loop) {
    const int i = (normal_axis_ + 1) % 3;
    const auto is_beyond = [&](int q) {
      return geometry_.Compare(graph_.point(q), graph_.point(p), i) > 0;
    };
    bool inside = false;
    int h = loop.first;
    do {
      int tail = graph_.Tail(h), head = graph_.Head(h);
      const bool tail_beyond = is_beyond(tail), head_beyond = is_beyond(head);
      if (tail_beyond != head_beyond) {
        if (tail_beyond) std::swap(tail, head);
        inside ^= geometry_.Turn(graph_.point(tail), graph_.point(head), graph_.point(p),
                                 normal_axis_, group_->plane) > 0;
      }
      h = graph_.Next(h);
    } while (h != loop.first);
    return inside;
  }

  // Which loop each part lies in: of the loops of other parts that hold it, the one whose own part
  // lies in all others.
  void PlaceParts() {
    if (parts_.size() <= 1) return;
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      std::vector<int> holders;
      for (std::size_t l = 0; l < loops_.size(); ++l) {
        const Loop& loop = loops_[l];
        if (loop.is_outer || loop.part == static_cast<int>(k)) continue;
        if (IsInside(parts_[k].first_point, loop)) holders.push_back(static_cast<int>(l));
      }
      int& container = loops_[parts_[k].outer_loop].container;
      for (const int l : holders) {
        const int point = parts_[loops_[l].part].first_point;
        const bool is_innermost = std::all_of(holders.begin(), holders.end(), [&](int m) {
          return m == l || IsInside(point, loops_[m]);
        });
        if (is_innermost) container = l;
      }
    }
  }

  // Which facets cover each loop's face: nothing far outside; across an edge of a facet, that
  // facet more or less.
  void FindCovers() {
    covers_.clear();
    std::vector<char> is_done(loops_.size(), 0);
    std::vector<int> order;  // parts, containers first
    std::vector<char> is_ordered(parts_.size(), 0);
    while (order.size() < parts_.size()) {
      const std::size_t before = order.size();
      for (std::size_t k = 0; k < parts_.size(); ++k) {
        const int container = loops_[parts_[k].outer_loop].container;
        if (is_ordered[k] || (container >= 0 && !is_ordered[loops_[container].part])) continue;
        is_ordered[k] = 1;
        order.push_back(static_cast<int>(k));
      }
      assert(order.size() > before);
      if (order.size() == before) return;
    }
    std::vector<int> stack;
    for (const int k : order) {
      Loop& outer = loops_[parts_[k].outer_loop];
      if (outer.container >= 0) {
        outer.first_cover = loops_[outer.container].first_cover;
        outer.cover_count = loops_[outer.container].cover_count;
      }
      is_done[parts_[k].outer_loop] = 1;
      stack = {parts_[k].outer_loop};
      while (!stack.empty()) {
        const int l = stack.back();
        stack.pop_back();
        int h = loops_[l].first;
        do {
          const int other = loop_of_[h ^ 1];
          if (!is_done[other]) {
            is_done[other] = 1;
            CoverAcross(h, loops_[l], &loops_[other]);
            stack.push_back(other);
          }
          h = graph_.Next(h);
        } while (h != loops_[l].first);
      }
    }
  }

  // What covers the right of a half-edge, whose left is covered as `left` says.
  void CoverAcross(int h, const Loop& left, Loop* right) {
    const auto begin = static_cast<std::ptrdiff_t>(covers_.size());
    for (int k = 0; k < left.cover_count; ++k) covers_.push_back(covers_[left.first_cover + k]);
    for (int r = graph_.edge_of(h).first_run; r >= 0; r = graph_.run(r).next) {
      const Wall& wall = group_->walls[graph_.run(r).wall];
      if (wall.other >= 0) continue;
      // Whether the facet lies on the half-edge's left.
      const bool runs_along = graph_.run(r).is_forward == (h % 2 == 0);
      if (wall.facet_is_left == runs_along) {
        covers_.erase(std::remove(covers_.begin() + begin, covers_.end(), wall.facet),
                      covers_.end());
      } else {
        covers_.push_back(wall.facet);
      }
    }
    right->first_cover = static_cast<int>(begin);
    right->cover_count = static_cast<int>(covers_.size()) - right->first_cover;
  }

  void Emit() {
    for (int l = 0; l < static_cast<int>(loops_.size()); ++l) {
      const Loop& loop = loops_[l];
      if (loop.is_outer || loop.cover_count == 0) continue;
      cells_.BeginCell(number_);
      const std::span<const int> cover =
          std::span(covers_).subspan(loop.first_cover, loop.cover_count);
      for (const int f : cover) {
        if (Agrees(f)) cells_.AddFacet(f);
      }
      cells_.BeginAgainst();
      for (const int f : cover) {
        if (!Agrees(f)) cells_.AddFacet(f);
      }
      cells_.SortFacets();
      AddLoop(loop);
      for (std::size_t k = 0; k < parts_.size() && parts_.size() > 1; ++k) {
        const Loop& hole = loops_[parts_[k].outer_loop];
        if (hole.container == l) AddLoop(hole);
      }
    }
  }

  // Whether a facet faces as the group's normal does.
  bool Agrees(int f) {
    const int plane = facet(f).plane;
    return plane == group_->plane || geometry_.NormalsAgree(plane, group_->plane) > 0;
  }

  void AddLoop(const Loop& loop) {
    int h = loop.first;
    do {
      cells_.AddToLoop(graph_.point(graph_.Tail(h)), graph_.edge_of(h).piece);
      h = graph_.Next(h);
    } while (h != loop.first);
    cells_.EndLoop(loop.is_buried);
  }

  struct Part {
    int first_point;
    int outer_loop;
  };

  SumGeometry& geometry_;
  const Arrangement& arrangement_;
  const PieceTable& table_;
  CellLists& cells_;
  WallGraph graph_;

  int number_ = 0;
  const Group* group_ = nullptr;
  int normal_axis_ = 0;
  std::vector<int> loop_of_;  // by half-edge
  std::vector<Loop> loops_;
  std::vector<Part> parts_;
  std::vector<int> part_of_point_, part_of_root_;
  std::vector<int> covers_;
};

}  // namespace

CellComplex FindCells(SumGeometry* geometry, const Arrangement& arrangement) {
  CellComplex complex;
  PieceTable table(arrangement, geometry->point_count());
  CellLists cells;
  GroupCells groups(geometry, arrangement, table, &cells);
  for (int g = 0; g < static_cast<int>(arrangement.groups.size()); ++g) {
    if (!arrangement.groups[g].walls.empty()) groups.Run(g);
  }
  cells.MoveTo(&complex);
  complex.pieces = table.Take();
  return complex;
}

}  // namespace touchstone::internal
