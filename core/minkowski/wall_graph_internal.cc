// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/wall_graph_internal.h"

#include <algorithm>

#include "touchstone/core/minkowski/flat_table_internal.h"

namespace touchstone::internal {

PieceTable::PieceTable(const Arrangement& arrangement, int point_count) {
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

WallGraph::WallGraph(SumGeometry* geometry, const Arrangement& arrangement, const PieceTable& table)
    : geometry_(*geometry),
      arrangement_(arrangement),
      table_(table),
      place_of_point_(static_cast<std::size_t>(geometry->point_count()), -1),
      edge_of_piece_(table.piece_count(), -1) {}

void WallGraph::Build(const Group& group) {
  group_ = &group;
  GatherEdges();
  SortRounds();
}

int WallGraph::PlaceOf(int point) {
  int& place = place_of_point_[point];
  if (place < 0) {
    place = static_cast<int>(points_.size());
    points_.push_back(point);
  }
  return place;
}

void WallGraph::GatherEdges() {
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
      WallEdge& edge = edges_[number];
      const bool is_forward = points_[edge.tail] == segment.points[k];
      runs_.push_back({static_cast<int>(w), is_forward, edge.first_run});
      edge.first_run = static_cast<int>(runs_.size()) - 1;
    }
  }
  for (const int point : points_) place_of_point_[point] = -1;
  for (const WallEdge& edge : edges_) edge_of_piece_[edge.piece] = -1;
}

// Directions are s (n x n_h), and n . ((n x n_h) x (n x n_k)) = |n|² det(n, n_h, n_k).
int WallGraph::Turn(int h, int k) {
  const int p = edges_[h / 2].line_plane, q = edges_[k / 2].line_plane;
  if (p == q) return 0;
  return Sense(h) * Sense(k) * geometry_.NormalsDeterminant(group_->plane, p, q);
}

// For half-edges on one line.
bool WallGraph::RunTheSameWay(int h, int k) {
  const int p = edges_[h / 2].line_plane, q = edges_[k / 2].line_plane;
  if (p == q) return Sense(h) == Sense(k);
  const int axis = geometry_.LineAxis(group_->plane, p);
  return Sense(h) * geometry_.LineAlong(group_->plane, p, axis) ==
         Sense(k) * geometry_.LineAlong(group_->plane, q, axis);
}

void WallGraph::SortRounds() {
  const int count = half_edge_count();
  first_of_round_.assign(points_.size() + 1, 0);
  for (int h = 0; h < count; ++h) ++first_of_round_[Tail(h)];
  int sum = 0;
  for (int& first : first_of_round_) first = std::exchange(sum, sum + first);
  rounds_.resize(static_cast<std::size_t>(count));
  for (int h = 0; h < count; ++h) rounds_[first_of_round_[Tail(h)]++] = h;
  for (int p = point_count(); p > 0; --p) first_of_round_[p] = first_of_round_[p - 1];
  first_of_round_[0] = 0;
  for (int p = 0; p < point_count(); ++p) SortRound(p);
  place_in_round_.resize(static_cast<std::size_t>(count));
  for (int p = 0; p < point_count(); ++p) {
    const std::span<const int> round = Round(p);
    for (std::size_t k = 0; k < round.size(); ++k) place_in_round_[round[k]] = static_cast<int>(k);
  }
}

void WallGraph::SortRound(int place) {
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

}  // namespace touchstone::internal
