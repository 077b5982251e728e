// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/cells_internal.h"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "touchstone/core/minkowski/flat_table_internal.h"

namespace touchstone::internal {
namespace {

// All pieces of all segments, numbered by their ends.
class PieceTable {
 public:
  explicit PieceTable(std::span<const Segment> segments) {
    first_.reserve(segments.size() + 1);
    for (const Segment& segment : segments) {
      first_.push_back(static_cast<int>(numbers_.size()));
      for (std::size_t k = 0; k + 1 < segment.points.size(); ++k) {
        numbers_.push_back(Number(segment.points[k], segment.points[k + 1]));
      }
    }
  }

  // The piece between points k and k + 1 of a segment.
  int PieceOf(int segment, int k) const { return numbers_[first_[segment] + k]; }
  std::vector<Piece> Take() { return std::move(pieces_); }
  const Piece& piece(int i) const { return pieces_[i]; }

 private:
  int Number(int u, int v) {
    const auto [small, large] = std::minmax(u, v);
    const auto [number, added] =
        by_ends_.Insert({small, large, 0, 0}, static_cast<int>(pieces_.size()));
    if (added) pieces_.push_back({small, large});
    return number;
  }

  std::vector<int> first_, numbers_;
  std::vector<Piece> pieces_;
  FlatTable by_ends_;
};

// One group's graph. Half-edge 2 e + 0 runs along edge e from its first point to its second, 2 e +
// 1 back.
class GroupCells {
 public:
  GroupCells(SumGeometry* geometry, const Arrangement& arrangement, const PieceTable& table,
             int group)
      : geometry_(*geometry),
        arrangement_(arrangement),
        table_(table),
        number_(group),
        group_(arrangement.groups[group]) {}

  void Run(std::vector<Cell>* cells) {
    if (IsUncut()) {
      EmitUncut(cells);
      return;
    }
    GatherEdges();
    SortRounds();
    TraceLoops();
    FindOuterLoops();
    PlaceParts();
    FindCovers();
    Emit(cells);
  }

 private:
  // A wall as it runs along an edge.
  struct WallRun {
    int wall;
    bool is_forward;  // from the edge's first point to its second, along the wall's segment
  };
  struct Edge {
    int piece;
    int tail, head;  // places in points_
    int line_plane;
    int sense;  // 1: tail to head is along (group normal) x (line plane's normal)
    std::vector<WallRun> runs;
  };
  struct Loop {
    int first;              // a half-edge
    bool is_outer = false;  // bounds its part of the graph from outside
    int part;
    int container = -1;  // for an outer loop: the loop that it lies in, if any
    bool is_buried = false;
    std::vector<int> cover;  // facets
  };

  // A facet alone in its plane that nothing crosses: its walls are its edges, in order.
  bool IsUncut() const {
    return group_.facets.size() == 1 &&
           static_cast<int>(group_.walls.size()) == facet(group_.facets[0]).count;
  }

  void EmitUncut(std::vector<Cell>* cells) const {
    Cell& cell = cells->emplace_back();
    cell.group = number_;
    cell.along = {group_.facets[0]};
    std::vector<int>& loop = cell.loops.emplace_back();
    for (const Wall& wall : group_.walls) {
      const std::vector<int>& points = arrangement_.segments[wall.segment].points;
      const int pieces = static_cast<int>(points.size()) - 1;
      for (int k = 0; k < pieces; ++k) {
        loop.push_back(wall.facet_is_left ? points[k] : points[pieces - k]);
        cell.pieces.push_back(
            table_.PieceOf(wall.segment, wall.facet_is_left ? k : pieces - 1 - k));
      }
    }
  }

  int Tail(int h) const { return h % 2 == 0 ? edges_[h / 2].tail : edges_[h / 2].head; }
  int Head(int h) const { return Tail(h ^ 1); }
  int Sense(int h) const { return h % 2 == 0 ? edges_[h / 2].sense : -edges_[h / 2].sense; }
  const ArrangedFacet& facet(int f) const { return arrangement_.facets[f]; }

  int PlaceOf(int point) {
    const auto [place, added] = places_.Insert({point, 0, 0, 0}, static_cast<int>(points_.size()));
    if (added) points_.push_back(point);
    return place;
  }

  void GatherEdges() {
    FlatTable edge_of_piece;
    for (std::size_t w = 0; w < group_.walls.size(); ++w) {
      const Wall& wall = group_.walls[w];
      const Segment& segment = arrangement_.segments[wall.segment];
      // Which way the segment runs along the line of the two planes.
      const int along = geometry_.LineAlong(group_.plane, wall.line_plane, segment.axis);
      const int rises =
          geometry_.Compare(segment.points.back(), segment.points.front(), segment.axis);
      for (std::size_t k = 0; k + 1 < segment.points.size(); ++k) {
        const int piece = table_.PieceOf(wall.segment, static_cast<int>(k));
        const auto [number, added] =
            edge_of_piece.Insert({piece, 0, 0, 0}, static_cast<int>(edges_.size()));
        if (added) {
          edges_.push_back({piece,
                            PlaceOf(segment.points[k]),
                            PlaceOf(segment.points[k + 1]),
                            wall.line_plane,
                            along * rises,
                            {}});
        }
        Edge& edge = edges_[number];
        const bool is_forward = points_[edge.tail] == segment.points[k];
        edge.runs.push_back({static_cast<int>(w), is_forward});
      }
    }
  }

  // The sign of the turn from half-edge h to k, both from one point: directions are s (n x n_h),
  // and n . ((n x n_h) x (n x n_k)) = |n|² det(n, n_h, n_k).
  int Turn(int h, int k) {
    const int p = edges_[h / 2].line_plane, q = edges_[k / 2].line_plane;
    return Sense(h) * Sense(k) * geometry_.NormalsDeterminant(group_.plane, p, q);
  }

  // For half-edges on one line: whether they run the same way.
  bool RunTheSameWay(int h, int k) {
    const int p = edges_[h / 2].line_plane, q = edges_[k / 2].line_plane;
    const int axis = geometry_.LineAxis(group_.plane, p);
    return Sense(h) * geometry_.LineAlong(group_.plane, p, axis) ==
           Sense(k) * geometry_.LineAlong(group_.plane, q, axis);
  }

  // Counterclockwise order of the half-edges that leave each point, seen against the normal.
  void SortRounds() {
    rounds_.resize(points_.size());
    for (int h = 0; h < 2 * static_cast<int>(edges_.size()); ++h) rounds_[Tail(h)].push_back(h);
    for (std::vector<int>& round : rounds_) {
      if (round.size() <= 2) continue;
      const int first = round[0];
      // Half a turn from the first: 0 ahead of it or equal, 1 from the opposite on.
      const auto half = [&](int h) {
        if (h == first) return 0;
        const int turn = Turn(first, h);
        return turn > 0 || (turn == 0 && RunTheSameWay(first, h)) ? 0 : 1;
      };
      std::vector<std::pair<int, int>> keyed;
      for (const int h : round) keyed.emplace_back(half(h), h);
      std::sort(keyed.begin(), keyed.end(), [&](const auto& x, const auto& y) {
        if (x.first != y.first) return x.first < y.first;
        if (x.second == y.second) return false;
        if (x.second == first || y.second == first) return x.second == first;
        return Turn(x.second, y.second) > 0;
      });
      for (std::size_t k = 0; k < keyed.size(); ++k) round[k] = keyed[k].second;
    }
    place_in_round_.resize(2 * edges_.size());
    for (const std::vector<int>& round : rounds_) {
      for (std::size_t k = 0; k < round.size(); ++k)
        place_in_round_[round[k]] = static_cast<int>(k);
    }
  }

  // The next half-edge with the same face on its left: at the head, the first one clockwise from
  // the way back.
  int Next(int h) const {
    const std::vector<int>& round = rounds_[Head(h)];
    const int place = place_in_round_[h ^ 1];
    return round[place > 0 ? place - 1 : static_cast<int>(round.size()) - 1];
  }

  void TraceLoops() {
    const int count = 2 * static_cast<int>(edges_.size());
    loop_of_.assign(count, -1);
    for (int first = 0; first < count; ++first) {
      if (loop_of_[first] >= 0) continue;
      const int number = static_cast<int>(loops_.size());
      loops_.push_back({first, false, -1, -1, false, {}});
      for (int h = first; loop_of_[h] < 0; h = Next(h)) loop_of_[h] = number;
    }
    for (int h = 0; h < count; ++h) {
      if (IsBuriedBeside(h)) loops_[loop_of_[h]].is_buried = true;
    }
  }

  // Whether a facet that passes along the half-edge, with its inside, has the half-edge's left on
  // its inner side. Along d = n x m the left of the plane with normal n lies below the plane with
  // normal m: d's left is n x d, and m . (n x (n x m)) = (n . m)² - |n|² |m|² < 0.
  bool IsBuriedBeside(int h) {
    for (const WallRun& run : edges_[h / 2].runs) {
      const Wall& wall = group_.walls[run.wall];
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
    const int axis = geometry_.LineAxis(group_.plane, plane);
    return Sense(h) * geometry_.LineAlong(group_.plane, line_plane, axis) *
           geometry_.LineAlong(group_.plane, plane, axis);
  }

  // Parts of the graph that hang together, and the loop that bounds each from outside: it passes
  // the sector that opens backwards at the part's first point in the order of coordinates.
  void FindOuterLoops() {
    std::vector<int> part(points_.size());
    std::iota(part.begin(), part.end(), 0);
    const auto find = [&](int p) {
      while (part[p] != p) p = part[p] = part[part[p]];
      return p;
    };
    for (const Edge& edge : edges_) part[find(edge.tail)] = find(edge.head);
    normal_axis_ = geometry_.NormalAxis(group_.plane);
    std::unordered_map<int, int> part_of_root;
    for (int p = 0; p < static_cast<int>(points_.size()); ++p) {
      const auto [place, added] =
          part_of_root.try_emplace(find(p), static_cast<int>(parts_.size()));
      if (added) {
        parts_.push_back({p, -1});
      } else if (IsBefore(p, parts_[place->second].first_point)) {
        parts_[place->second].first_point = p;
      }
    }
    for (Loop& loop : loops_) loop.part = part_of_root.at(find(Tail(loop.first)));
    for (Part& each : parts_) {
      const std::vector<int>& round = rounds_[each.first_point];
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
    for (const int k : order) {
      const int outer = parts_[k].outer_loop;
      if (loops_[outer].container >= 0) loops_[outer].cover = loops_[loops_[outer].container].cover;
      is_done[outer] = 1;
      std::vector<int> stack = {outer};
      while (!stack.empty()) {
        const int l = stack.back();
        stack.pop_back();
        int h = loops_[l].first;
        do {
          const int other = loop_of_[h ^ 1];
          if (!is_done[other]) {
            is_done[other] = 1;
            loops_[other].cover = CoverAcross(h, loops_[l].cover);
            stack.push_back(other);
          }
          h = Next(h);
        } while (h != loops_[l].first);
      }
    }
  }

  // What covers the right of a half-edge whose left is covered by `cover`.
  std::vector<int> CoverAcross(int h, std::vector<int> cover) {
    for (const WallRun& run : edges_[h / 2].runs) {
      const Wall& wall = group_.walls[run.wall];
      if (wall.other >= 0) continue;
      // Whether the facet lies on the half-edge's left.
      const bool runs_along = run.is_forward == (h % 2 == 0);
      if (wall.facet_is_left == runs_along) {
        std::erase(cover, wall.facet);
      } else {
        cover.push_back(wall.facet);
      }
    }
    return cover;
  }

  void Emit(std::vector<Cell>* cells) {
    std::unordered_map<int, int> cell_of_loop;
    for (std::size_t l = 0; l < loops_.size(); ++l) {
      if (loops_[l].is_outer || loops_[l].cover.empty()) continue;
      cell_of_loop[static_cast<int>(l)] = static_cast<int>(cells->size());
      Cell& cell = cells->emplace_back();
      cell.group = number_;
      AddLoop(loops_[l], &cell);
      for (const int f : loops_[l].cover) {
        const int plane = facet(f).plane;
        const bool agrees =
            plane == group_.plane || geometry_.NormalsAgree(plane, group_.plane) > 0;
        (agrees ? cell.along : cell.against).push_back(f);
      }
      std::sort(cell.along.begin(), cell.along.end());
      std::sort(cell.against.begin(), cell.against.end());
    }
    for (const Loop& loop : loops_) {
      if (!loop.is_outer || loop.container < 0) continue;
      const auto found = cell_of_loop.find(loop.container);
      if (found != cell_of_loop.end()) AddLoop(loop, &(*cells)[found->second]);
    }
  }

  void AddLoop(const Loop& loop, Cell* cell) {
    std::vector<int>& points = cell->loops.emplace_back();
    int h = loop.first;
    do {
      points.push_back(points_[Tail(h)]);
      cell->pieces.push_back(edges_[h / 2].piece);
      h = Next(h);
    } while (h != loop.first);
    cell->is_buried |= loop.is_buried;
  }

  struct Part {
    int first_point;
    int outer_loop;
  };

  SumGeometry& geometry_;
  const Arrangement& arrangement_;
  const PieceTable& table_;
  const int number_;
  const Group& group_;
  int normal_axis_ = 0;
  std::vector<Edge> edges_;
  std::vector<int> points_;
  FlatTable places_;
  std::vector<std::vector<int>> rounds_;
  std::vector<int> place_in_round_, loop_of_;
  std::vector<Loop> loops_;
  std::vector<Part> parts_;
};

}  // namespace

CellComplex FindCells(SumGeometry* geometry, const Arrangement& arrangement) {
  CellComplex complex;
  PieceTable table(arrangement.segments);
  for (int g = 0; g < static_cast<int>(arrangement.groups.size()); ++g) {
    if (arrangement.groups[g].walls.empty()) continue;
    GroupCells(geometry, arrangement, table, g).Run(&complex.cells);
  }
  complex.pieces = table.Take();
  return complex;
}

}  // namespace touchstone::internal
