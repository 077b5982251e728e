// SPDX-License-Identifier: MIT
//
// The walls of a group as a graph in its plane: points, edges, and the exact order of the edges
// round each point.
#ifndef TOUCHSTONE_CORE_MINKOWSKI_WALL_GRAPH_INTERNAL_H_
#define TOUCHSTONE_CORE_MINKOWSKI_WALL_GRAPH_INTERNAL_H_

#include <span>
#include <utility>
#include <vector>

#include "touchstone/core/minkowski/arrangement_internal.h"
#include "touchstone/core/minkowski/cells_internal.h"
#include "touchstone/core/minkowski/sum_geometry_internal.h"

namespace touchstone::internal {

// All pieces of all segments, numbered by their ends.
class PieceTable {
 public:
  PieceTable(const Arrangement& arrangement, int point_count);

  // The piece between points k and k + 1 of a segment.
  int PieceOf(int segment, int k) const { return numbers_[first_[segment] + k]; }
  std::size_t piece_count() const { return pieces_.size(); }
  std::vector<Piece> Take() { return std::move(pieces_); }

 private:
  std::vector<int> first_, numbers_;
  std::vector<Piece> pieces_;
};

// A wall as it runs along an edge.
struct WallRun {
  int wall;
  bool is_forward;  // from the edge's first point to its second, along the wall's segment
  int next;         // of the same edge; -1: none
};

struct WallEdge {
  int piece;
  int tail, head;  // places in the graph's points
  int line_plane;
  int sense;  // 1: tail to head is along (group normal) x (line plane's normal)
  int first_run = -1;
};

// One group's graph at a time, in storage that is used again. Half-edge 2 e + 0 runs along edge e
// from its first point to its second, 2 e + 1 back.
class WallGraph {
 public:
  // Keeps references to all three.
  WallGraph(SumGeometry* geometry, const Arrangement& arrangement, const PieceTable& table);

  // Complexity: O(w log w) for w pieces of walls.
  void Build(const Group& group);

  int point_count() const { return static_cast<int>(points_.size()); }
  int point(int place) const { return points_[place]; }
  std::span<const WallEdge> edges() const { return edges_; }
  const WallEdge& edge_of(int h) const { return edges_[h / 2]; }
  const WallRun& run(int r) const { return runs_[r]; }
  int half_edge_count() const { return 2 * static_cast<int>(edges_.size()); }

  int Tail(int h) const { return h % 2 == 0 ? edges_[h / 2].tail : edges_[h / 2].head; }
  int Head(int h) const { return Tail(h ^ 1); }
  int Sense(int h) const { return h % 2 == 0 ? edges_[h / 2].sense : -edges_[h / 2].sense; }
  // The half-edges that leave a point, counterclockwise seen against the group's normal.
  std::span<const int> Round(int place) const {
    return {rounds_.data() + first_of_round_[place], rounds_.data() + first_of_round_[place + 1]};
  }
  // The next half-edge with the same face on its left: at the head, the first one clockwise from
  // the way back.
  int Next(int h) const {
    const std::span<const int> round = Round(Head(h));
    const int place = place_in_round_[h ^ 1];
    return place > 0 ? round[place - 1] : round.back();
  }
  // The sign of the turn from half-edge h to k, both from one point.
  int Turn(int h, int k);

 private:
  int PlaceOf(int point);
  void GatherEdges();
  void SortRounds();
  void SortRound(int place);
  bool RunTheSameWay(int h, int k);

  SumGeometry& geometry_;
  const Arrangement& arrangement_;
  const PieceTable& table_;
  const Group* group_ = nullptr;
  std::vector<int> place_of_point_, edge_of_piece_;  // -1 between groups
  std::vector<WallEdge> edges_;
  std::vector<WallRun> runs_;
  std::vector<int> points_;
  std::vector<int> first_of_round_, rounds_;  // half-edges by the place of their tails
  std::vector<int> place_in_round_;
  std::vector<std::pair<int, int>> keyed_;
};

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_MINKOWSKI_WALL_GRAPH_INTERNAL_H_
