// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/cells_internal.h"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <utility>

#include "touchstone/core/minkowski/flat_table_internal.h"

namespace touchstone::internal {
namespace {

// All pieces of all segments, numbered by their ends.
class PieceTable {
 public:
  PieceTable(const Arrangement& arrangement, int point_count) {
    PairTable by_ends(point_count);
    first_.reserve(arrangement.segments.size());
    numbers_.reserve(arrangement.points_of_segments.size());
    for (const Segment& segment : arrangement.segments) {
      first_.push_back(static_cast<int>(numbers_.size()));
      for (std::size_t k = 0; k + 1 < segment.points.size(); ++k) {
        const auto [small, large] = std::minmax(segment.points[k], segment.points[k + 1]);
        const auto [number, added] = by_ends.Insert(small, large);
        if (added) pieces_.push_back({small, large});
        numbers_.push_back(number);
      }
    }
  }

  // The piece between points k and k + 1 of a segment.
  int PieceOf(int segment, int k) const { return numbers_[first_[segment] + k]; }
  std::size_t piece_count() const { return pieces_.size(); }
  std::vector<Piece> Take() { return std::move(pieces_); }

 private:
  std::vector<int> first_, numbers_;
  std::vector<Piece> pieces_;
};

// Cells as they come, their lists one after the other.
class CellLists {
 public:
  void BeginCell(int group) {
    drafts_.push_back({group, false, End(loop_ends_), End(pieces_), End(facets_), End(facets_)});
  }
  void AddFacet(int facet) { facets_.push_back(facet); }
  void BeginAgainst() { drafts_.back().first_against = End(facets_); }
  void AddToLoop(int point, int piece) {
    points_.push_back(point);
    pieces_.push_back(piece);
  }
  void EndLoop(bool is_buried) {
    loop_ends_.push_back(End(points_));
    drafts_.back().is_buried |= is_buried;
  }
  // Of the last cell, from a place on: sorts.
  void SortFacets() {
    const Draft& own = drafts_.back();
    std::sort(facets_.begin() + own.first_facet, facets_.begin() + own.first_against);
    std::sort(facets_.begin() + own.first_against, facets_.end());
  }

  void MoveTo(CellComplex* complex) {
    complex->points_of_loops = std::move(points_);
    complex->pieces_of_cells = std::move(pieces_);
    complex->facets_of_cells = std::move(facets_);
    const std::span<const int> points(complex->points_of_loops);
    complex->loops_of_cells.reserve(loop_ends_.size());
    int begin = 0;
    for (const int end : loop_ends_) {
      complex->loops_of_cells.push_back(Part(points, begin, end));
      begin = end;
    }
    const std::span<const std::span<const int>> loops(complex->loops_of_cells);
    const std::span<const int> pieces(complex->pieces_of_cells), facets(complex->facets_of_cells);
    const Draft last{-1,
                     false,
                     End(loop_ends_),
                     static_cast<int>(pieces.size()),
                     static_cast<int>(facets.size()),
                     static_cast<int>(facets.size())};
    complex->cells.reserve(drafts_.size());
    for (std::size_t c = 0; c < drafts_.size(); ++c) {
      const Draft &own = drafts_[c], &next = c + 1 < drafts_.size() ? drafts_[c + 1] : last;
      complex->cells.push_back({own.group, Part(loops, own.first_loop, next.first_loop),
                                Part(facets, own.first_facet, own.first_against),
                                Part(facets, own.first_against, next.first_facet), own.is_buried,
                                Part(pieces, own.first_piece, next.first_piece)});
    }
  }

 private:
  struct Draft {
    int group;
    bool is_buried;
    int first_loop, first_piece, first_facet, first_against;
  };

  static int End(const std::vector<int>& list) { return static_cast<int>(list.size()); }
  template <class Item>
  static std::span<const Item> Part(std::span<const Item> list, int begin, int end) {
    return list.subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(end - begin));
  }

  std::vector<Draft> drafts_;
  std::vector<int> loop_ends_, points_, pieces_, facets_;
};

// One group's graph at a time. Half-edge 2 e + 0 runs along edge e from its first point to its
// second, 2 e + 1 back.
class GroupCells {
 public:
  GroupCells(SumGeometry* geometry, const Arrangement& arrangement, const PieceTable& table,
             CellLists* cells)
      : geometry_(*geometry),
        arrangement_(arrangement),
        table_(table),
        cells_(*cells),
        place_of_point_(static_cast<std::size_t>(geometry->point_count()), -1),
        edge_of_piece_(table.piece_count(), -1) {}

  void Run(int group) {
    number_ = group;
    group_ = &arrangement_.groups[group];
    if (!group_->is_cut) {
      EmitUncut();
      return;
    }
    GatherEdges();
    SortRounds();
    TraceLoops();
    FindOuterLoops();
    PlaceParts();
    FindCovers();
    Emit();
  }

 private:
  // A wall as it runs along an edge.
  struct WallRun {
    int wall;
    bool is_forward;  // from the edge's first point to its second, along the wall's segment
    int next;         // of the same edge; -1: none
  };
  struct Edge {
    int piece;
    int tail, head;  // places in points_
    int line_plane;
    int sense;  // 1: tail to head is along (group normal) x (line plane's normal)
    int first_run = -1;
  };
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

  int Tail(int h) const { return h % 2 == 0 ? edges_[h / 2].tail : edges_[h / 2].head; }
  int Head(int h) const { return Tail(h ^ 1); }
  int Sense(int h) const { return h % 2 == 0 ? edges_[h / 2].sense : -edges_[h / 2].sense; }
  const ArrangedFacet& facet(int f) const { return arrangement_.facets[f]; }
  std::span<const int> Round(int place) const {
    return {rounds_.data() + first_of_round_[place], rounds_.data() + first_of_round_[place + 1]};
  }

  int PlaceOf(int point) {
    int& place = place_of_point_[point];
    if (place < 0) {
      place = static_cast<int>(points_.size());
      points_.push_back(point);
    }
    return place;
  }

  void GatherEdges() {
    edges_.clear();
    runs_.clear();
    points_.clear();
    for (std::size_t w = 0; w < group_->walls.size(); ++w) {
      const Wall& wall = group_->walls[w];
      const Segment& segment = arrangement_.segments[wall.segment];
      // Which way the segment runs along the line of the two planes.
      const int along = geometry_.LineAlong(group_->plane, wall.line_plane, segment.axis);
      const int rises =
          geometry_.Compare(segment.points.back(), segment.points.front(), segment.axis);
      for (std::size_t k = 0; k + 1 < segment.points.size(); ++k) {
        const int piece = table_.PieceOf(wall.segment, static_cast<int>(k));
        int& number = edge_of_piece_[piece];
        if (number < 0) {
          number = static_cast<int>(edges_.size());
          const int tail = PlaceOf(segment.points[k]), head = PlaceOf(segment.points[k + 1]);
          edges_.push_back({piece, tail, head, wall.line_plane, along * rises});
        }
        Edge& edge = edges_[number];
        const bool is_forward = points_[edge.tail] == segment.points[k];
        runs_.push_back({static_cast<int>(w), is_forward, edge.first_run});
        edge.first_run = static_cast<int>(runs_.size()) - 1;
      }
    }
    for (const int point : points_) place_of_point_[point] = -1;
    for (const Edge& edge : edges_) edge_of_piece_[edge.piece] = -1;
  }

  // The sign of the turn from half-edge h to k, both from one point: directions are s (n x n_h),
  // and n . ((n x n_h) x (n x n_k)) = |n|² det(n, n_h, n_k).
  int Turn(int h, int k) {
    const int p = edges_[h / 2].line_plane, q = edges_[k / 2].line_plane;
    return Sense(h) * Sense(k) * geometry_.NormalsDeterminant(group_->plane, p, q);
  }

  // For half-edges on one line: whether they run the same way.
  bool RunTheSameWay(int h, int k) {
    const int p = edges_[h / 2].line_plane, q = edges_[k / 2].line_plane;
    const int axis = geometry_.LineAxis(group_->plane, p);
    return Sense(h) * geometry_.LineAlong(group_->plane, p, axis) ==
           Sense(k) * geometry_.LineAlong(group_->plane, q, axis);
  }

  // Counterclockwise order of the half-edges that leave each point, seen against the normal.
  void SortRounds() {
    const int count = 2 * static_cast<int>(edges_.size());
    const int point_count = static_cast<int>(points_.size());
    first_of_round_.assign(points_.size() + 1, 0);
    for (int h = 0; h < count; ++h) ++first_of_round_[Tail(h)];
    int sum = 0;
    for (int& first : first_of_round_) first = std::exchange(sum, sum + first);
    rounds_.resize(static_cast<std::size_t>(count));
    for (int h = 0; h < count; ++h) rounds_[first_of_round_[Tail(h)]++] = h;
    for (int p = point_count; p > 0; --p) first_of_round_[p] = first_of_round_[p - 1];
    first_of_round_[0] = 0;
    for (int p = 0; p < point_count; ++p) SortRound(p);
    place_in_round_.resize(static_cast<std::size_t>(count));
    for (int p = 0; p < point_count; ++p) {
      const std::span<const int> round = Round(p);
      for (std::size_t k = 0; k < round.size(); ++k)
        place_in_round_[round[k]] = static_cast<int>(k);
    }
  }

  void SortRound(int place) {
    const std::span<int> round(rounds_.data() + first_of_round_[place],
                               rounds_.data() + first_of_round_[place + 1]);
    if (round.size() <= 2) return;
    const int first = round[0];
    // Half a turn from the first: 0 ahead of it or equal, 1 from the opposite on.
    const auto half = [&](int h) {
      if (h == first) return 0;
      const int turn = Turn(first, h);
      return turn > 0 || (turn == 0 && RunTheSameWay(first, h)) ? 0 : 1;
    };
    keyed_.clear();
    for (const int h : round) keyed_.emplace_back(half(h), h);
    std::sort(keyed_.begin(), keyed_.end(), [&](const auto& x, const auto& y) {
      if (x.first != y.first) return x.first < y.first;
      if (x.second == y.second) return false;
      if (x.second == first || y.second == first) return x.second == first;
      return Turn(x.second, y.second) > 0;
    });
    for (std::size_t k = 0; k < keyed_.size(); ++k) round[k] = keyed_[k].second;
  }

  // The next half-edge with the same face on its left: at the head, the first one clockwise from
  // the way back.
  int Next(int h) const {
    const std::span<const int> round = Round(Head(h));
    const int place = place_in_round_[h ^ 1];
    return place > 0 ? round[place - 1] : round.back();
  }

  void TraceLoops() {
    const int count = 2 * static_cast<int>(edges_.size());
    loops_.clear();
    loop_of_.assign(static_cast<std::size_t>(count), -1);
    for (int first = 0; first < count; ++first) {
      if (loop_of_[first] >= 0) continue;
      const int number = static_cast<int>(loops_.size());
      loops_.push_back({first, false, -1});
      for (int h = first; loop_of_[h] < 0; h = Next(h)) loop_of_[h] = number;
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
    for (int r = edges_[h / 2].first_run; r >= 0; r = runs_[r].next) {
      const Wall& wall = group_->walls[runs_[r].wall];
      if (wall.other < 0) continue;
      const Segment& segment = arrangement_.segments[wall.segment];
      const bool is_inside =
          wall.other == segment.facet_f ? segment.is_inside_f : segment.is_inside_g;
      if (!is_inside) continue;
      // Sense is along the edge's own line plane; the crossing facet's normal may be another.
      const int plane = facet(wall.other).plane;
      const int sense = plane == edges_[h / 2].line_plane ? Sense(h) : SenseAlong(h, plane);
      if (sense > 0) return true;
    }
    return false;
  }

  // 1 if the half-edge runs along (group normal) x (the plane's normal).
  int SenseAlong(int h, int plane) {
    const int line_plane = edges_[h / 2].line_plane;
    const int axis = geometry_.LineAxis(group_->plane, plane);
    return Sense(h) * geometry_.LineAlong(group_->plane, line_plane, axis) *
           geometry_.LineAlong(group_->plane, plane, axis);
  }

  // Parts of the graph that hang together, and the loop that bounds each from outside: it passes
  // the sector that opens backwards at the part's first point in the order of coordinates.
  void FindOuterLoops() {
    std::vector<int>& part = part_of_point_;
    part.resize(points_.size());
    std::iota(part.begin(), part.end(), 0);
    const auto find = [&](int p) {
      while (part[p] != p) p = part[p] = part[part[p]];
      return p;
    };
    for (const Edge& edge : edges_) part[find(edge.tail)] = find(edge.head);
    normal_axis_ = geometry_.NormalAxis(group_->plane);
    parts_.clear();
    part_of_root_.assign(points_.size(), -1);
    for (int p = 0; p < static_cast<int>(points_.size()); ++p) {
      int& number = part_of_root_[find(p)];
      if (number < 0) {
        number = static_cast<int>(parts_.size());
        parts_.push_back({p, -1});
      } else if (IsBefore(p, parts_[number].first_point)) {
        parts_[number].first_point = p;
      }
    }
    for (Loop& loop : loops_) loop.part = part_of_root_[find(Tail(loop.first))];
    for (Part& each : parts_) {
      const std::span<const int> round = Round(each.first_point);
      // All half-edges lie within less than half a turn: the gap after the last one is wider.
      int last = round[0];
      for (std::size_t k = 0; k < round.size() && round.size() > 1; ++k) {
        if (Turn(round[k], round[(k + 1) % round.size()]) < 0) last = round[k];
      }
      each.outer_loop = loop_of_[last];
      loops_[each.outer_loop].is_outer = true;
    }
  }

  bool IsBefore(int p, int q) {
    const int i = (normal_axis_ + 1) % 3, j = (normal_axis_ + 2) % 3;
    const int sign = geometry_.Compare(points_[p], points_[q], i);
    return sign != 0 ? sign < 0 : geometry_.Compare(points_[p], points_[q], j) < 0;
  }

  // Whether a point off the loop's part lies inside the loop.
  bool IsInside(int p, const Loop& loop) {
    const int i = (normal_axis_ + 1) % 3;
    const auto is_beyond = [&](int q) { return geometry_.Compare(points_[q], points_[p], i) > 0; };
    bool inside = false;
    int h = loop.first;
    do {
      int tail = Tail(h), head = Head(h);
      const bool tail_beyond = is_beyond(tail), head_beyond = is_beyond(head);
      if (tail_beyond != head_beyond) {
        if (tail_beyond) std::swap(tail, head);
        inside ^= geometry_.Turn(points_[tail], points_[head], points_[p], normal_axis_) > 0;
      }
      h = Next(h);
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
          h = Next(h);
        } while (h != loops_[l].first);
      }
    }
  }

  // What covers the right of a half-edge, whose left is covered as `left` says.
  void CoverAcross(int h, const Loop& left, Loop* right) {
    const auto begin = static_cast<std::ptrdiff_t>(covers_.size());
    for (int k = 0; k < left.cover_count; ++k) covers_.push_back(covers_[left.first_cover + k]);
    for (int r = edges_[h / 2].first_run; r >= 0; r = runs_[r].next) {
      const Wall& wall = group_->walls[runs_[r].wall];
      if (wall.other >= 0) continue;
      // Whether the facet lies on the half-edge's left.
      const bool runs_along = runs_[r].is_forward == (h % 2 == 0);
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
      cells_.AddToLoop(points_[Tail(h)], edges_[h / 2].piece);
      h = Next(h);
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
  std::vector<int> place_of_point_, edge_of_piece_;  // -1 between groups

  int number_ = 0;
  const Group* group_ = nullptr;
  int normal_axis_ = 0;
  std::vector<Edge> edges_;
  std::vector<WallRun> runs_;
  std::vector<int> points_;
  std::vector<int> first_of_round_, rounds_;  // half-edges by the place of their tails
  std::vector<int> place_in_round_, loop_of_;
  std::vector<Loop> loops_;
  std::vector<Part> parts_;
  std::vector<int> part_of_point_, part_of_root_;
  std::vector<int> covers_;
  std::vector<std::pair<int, int>> keyed_;
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
