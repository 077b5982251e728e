// SPDX-License-Identifier: GPL-3.0-or-later
#include "touchstone/exact/triangle_cells.h"

#include <algorithm>
#include <map>
#include <utility>

namespace touchstone::exact {
namespace {

using Flat = std::array<mpq_class, 2>;
using FlatSegment = std::pair<Flat, Flat>;

mpq_class Area(const Flat& a, const Flat& b, const Flat& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

// Where a segment that is not level meets the height y of its span.
mpq_class At(const FlatSegment& s, const mpq_class& y) {
  const auto& [a, b] = s;
  return a[0] + (b[0] - a[0]) * (y - a[1]) / (b[1] - a[1]);
}

bool Spans(const FlatSegment& s, const mpq_class& y) {
  return (s.first[1] < y && y < s.second[1]) || (s.second[1] < y && y < s.first[1]);
}

// Adds the height at which the lines of two segments cross, if within both.
void AddCrossing(const FlatSegment& s, const FlatSegment& t, std::vector<mpq_class>* heights) {
  for (int i = 0; i < 2; ++i) {
    if (std::max(s.first[i], s.second[i]) <= std::min(t.first[i], t.second[i]) ||
        std::max(t.first[i], t.second[i]) <= std::min(s.first[i], s.second[i])) {
      return;
    }
  }
  // Crossings in an end are listed anyway.
  const mpq_class c = Area(s.first, s.second, t.first), d = Area(s.first, s.second, t.second);
  if (sgn(c) * sgn(d) >= 0) return;
  const mpq_class e = Area(t.first, t.second, s.first), f = Area(t.first, t.second, s.second);
  if (sgn(e) * sgn(f) >= 0) return;
  heights->push_back(s.first[1] + (s.second[1] - s.first[1]) * e / (e - f));
}

void SortUnique(std::vector<mpq_class>* values) {
  std::sort(values->begin(), values->end());
  values->erase(std::unique(values->begin(), values->end()), values->end());
}

struct FlatPiece {
  Flat sample;
  mpq_class area;
};

// Cuts a triangle by segments into trapezoids, and joins those into pieces.
class Trapezoids {
 public:
  Trapezoids(const std::array<FlatSegment, 3>& sides, std::vector<FlatSegment> all)
      : sides_(sides), all_(std::move(all)) {}

  std::vector<FlatPiece> Run() {
    const std::vector<mpq_class> heights = Heights();
    std::size_t below = 0, end = 0;  // the layer below: trapezoids from `below` to `end`
    for (std::size_t k = 0; k + 1 < heights.size(); ++k) {
      AddLayer(heights[k], heights[k + 1]);
      if (k > 0) JoinLayers(below, end, heights[k]);
      below = std::exchange(end, trapezoids_.size());
    }
    return Collect();
  }

 private:
  struct Trapezoid {
    std::size_t left, right;  // segments
    Flat sample;
    mpq_class area;
  };

  std::vector<mpq_class> Heights() const {
    const auto [low, high] =
        std::minmax({sides_[0].first[1], sides_[1].first[1], sides_[2].first[1]});
    std::vector<mpq_class> heights;
    for (std::size_t k = 0; k < all_.size(); ++k) {
      heights.push_back(all_[k].first[1]);
      heights.push_back(all_[k].second[1]);
      for (std::size_t l = 0; l < k; ++l) AddCrossing(all_[k], all_[l], &heights);
    }
    std::erase_if(heights, [&](const mpq_class& y) { return y < low || y > high; });
    SortUnique(&heights);
    return heights;
  }

  // Between two heights nothing begins, ends or crosses: segments that span them stand in order.
  void AddLayer(const mpq_class& low, const mpq_class& high) {
    const mpq_class y = (low + high) / 2;
    std::vector<mpq_class> ends;
    for (const FlatSegment& side : sides_) {
      if (Spans(side, y)) ends.push_back(At(side, y));
    }
    SortUnique(&ends);
    if (ends.size() < 2) return;
    std::vector<std::pair<mpq_class, std::size_t>> crossings;
    for (std::size_t s = 0; s < all_.size(); ++s) {
      if (!Spans(all_[s], y)) continue;
      mpq_class x = At(all_[s], y);
      if (x >= ends.front() && x <= ends.back()) crossings.emplace_back(std::move(x), s);
    }
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t c = 0; c + 1 < crossings.size(); ++c) {
      const auto& [x, left] = crossings[c];
      const auto& [next_x, right] = crossings[c + 1];
      if (x == next_x) continue;
      trapezoids_.push_back({left, right, {(x + next_x) / 2, y}, (next_x - x) * (high - low)});
      parents_.push_back(parents_.size());
    }
  }

  // Joins trapezoids from `below` to `end` with those from `end` on that they meet at height y.
  void JoinLayers(std::size_t below, std::size_t end, const mpq_class& y) {
    std::vector<std::pair<mpq_class, mpq_class>> level;
    for (const FlatSegment& s : all_) {
      if (s.first[1] == y && s.second[1] == y)
        level.push_back(std::minmax(s.first[0], s.second[0]));
    }
    std::sort(level.begin(), level.end());
    std::size_t i = below, j = end;
    while (i < end && j < trapezoids_.size()) {
      const Trapezoid &m = trapezoids_[i], &n = trapezoids_[j];
      const mpq_class m_right = At(all_[m.right], y), n_right = At(all_[n.right], y);
      const mpq_class from = std::max(At(all_[m.left], y), At(all_[n.left], y));
      if (IsOpen(level, from, std::min(m_right, n_right))) parents_[Root(i)] = Root(j);
      ++(m_right < n_right ? i : j);
    }
  }

  // Whether some of the interval is free of the sorted ones.
  static bool IsOpen(const std::vector<std::pair<mpq_class, mpq_class>>& level, mpq_class from,
                     const mpq_class& to) {
    for (const auto& [begin, end] : level) {
      if (begin > from) break;
      from = std::max(from, end);
    }
    return from < to;
  }

  std::size_t Root(std::size_t i) {
    while (parents_[i] != i) i = parents_[i] = parents_[parents_[i]];
    return i;
  }

  // Samples are those of the largest trapezoids.
  std::vector<FlatPiece> Collect() {
    std::vector<FlatPiece> pieces;
    std::map<std::size_t, std::size_t> piece_of_root;
    std::vector<mpq_class> largest;
    for (std::size_t i = 0; i < trapezoids_.size(); ++i) {
      const Trapezoid& own = trapezoids_[i];
      const auto [place, added] = piece_of_root.try_emplace(Root(i), pieces.size());
      if (added) {
        pieces.push_back({own.sample, own.area});
        largest.push_back(own.area);
        continue;
      }
      FlatPiece& piece = pieces[place->second];
      piece.area += own.area;
      if (own.area > largest[place->second]) {
        piece.sample = own.sample;
        largest[place->second] = own.area;
      }
    }
    return pieces;
  }

  const std::array<FlatSegment, 3>& sides_;
  const std::vector<FlatSegment> all_;
  std::vector<Trapezoid> trapezoids_;
  std::vector<std::size_t> parents_;
};

}  // namespace

RationalPoint operator-(const RationalPoint& a, const RationalPoint& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

RationalPoint Cross(const RationalPoint& a, const RationalPoint& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

mpq_class Dot(const RationalPoint& a, const RationalPoint& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

RationalTriangle::RationalTriangle(const std::array<RationalPoint, 3>& corners)
    : corners_(corners), normal_(Cross(corners[1] - corners[0], corners[2] - corners[0])) {
  while (axis_ < 2 && sgn(normal_[axis_]) == 0) ++axis_;
  i_ = (axis_ + 1) % 3;
  j_ = (axis_ + 2) % 3;
}

int RationalTriangle::Side(const RationalPoint& x) const {
  return sgn(Dot(normal_, x - corners_[0]));
}

std::optional<RationalSegment> RationalTriangle::CutFrom(const RationalTriangle& other) const {
  std::vector<RationalPoint> ends;
  std::array<mpq_class, 3> height;
  for (int k = 0; k < 3; ++k) {
    height[k] = Dot(normal_, other.corners_[k] - corners_[0]);
    if (sgn(height[k]) == 0) ends.push_back(other.corners_[k]);
  }
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3;
    if (sgn(height[k]) * sgn(height[next]) >= 0) continue;
    const mpq_class s = height[k] / (height[k] - height[next]);
    RationalPoint at = other.corners_[next] - other.corners_[k];
    for (int i = 0; i < 3; ++i) at[i] = other.corners_[k][i] + s * at[i];
    ends.push_back(at);
  }
  if (ends.empty()) return std::nullopt;
  return RationalSegment{ends.front(), ends.back()};
}

std::array<FlatSegment, 3> RationalTriangle::FlatSides() const {
  std::array<FlatSegment, 3> sides;
  for (int k = 0; k < 3; ++k) {
    sides[k] = {Flatten(corners_[k]), Flatten(corners_[(k + 1) % 3])};
  }
  return sides;
}

bool RationalTriangle::Holds(const RationalPoint& x) const {
  const Flat flat = Flatten(x);
  const int sense = sgn(normal_[axis_]);
  for (const FlatSegment& side : FlatSides()) {
    if (sgn(Area(side.first, side.second, flat)) * sense < 0) return false;
  }
  return true;
}

bool RationalTriangle::HoldsInside(const RationalPoint& x) const {
  const Flat flat = Flatten(x);
  const int sense = sgn(normal_[axis_]);
  for (const FlatSegment& side : FlatSides()) {
    if (sgn(Area(side.first, side.second, flat)) * sense <= 0) return false;
  }
  return true;
}

bool RationalTriangle::Meets(const RationalSegment& segment) const {
  // The part of the segment, from 0 to 1, that is left by the three sides.
  mpq_class from = 0, to = 1;
  const Flat a = Flatten(segment.first), b = Flatten(segment.second);
  const int sense = sgn(normal_[axis_]);
  for (const FlatSegment& side : FlatSides()) {
    const mpq_class at_a = sense * Area(side.first, side.second, a);
    const mpq_class at_b = sense * Area(side.first, side.second, b);
    if (sgn(at_a) < 0 && sgn(at_b) < 0) return false;
    if (sgn(at_a) < 0) from = std::max(from, mpq_class(at_a / (at_a - at_b)));
    if (sgn(at_b) < 0) to = std::min(to, mpq_class(at_a / (at_a - at_b)));
  }
  return from <= to;
}

RationalPoint RationalTriangle::Lift(const Flat& x) const {
  RationalPoint lifted;
  lifted[i_] = x[0];
  lifted[j_] = x[1];
  lifted[axis_] = corners_[0][axis_] - (normal_[i_] * (x[0] - corners_[0][i_]) +
                                        normal_[j_] * (x[1] - corners_[0][j_])) /
                                           normal_[axis_];
  return lifted;
}

std::vector<RationalTriangle::Piece> RationalTriangle::Pieces(
    std::span<const RationalSegment> segments) const {
  const std::array<FlatSegment, 3> sides = FlatSides();
  std::vector<FlatSegment> all(sides.begin(), sides.end());
  for (const auto& [a, b] : segments) all.emplace_back(Flatten(a), Flatten(b));
  for (FlatSegment& s : all) s = std::minmax({s.first, s.second});
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  std::vector<Piece> pieces;
  for (const FlatPiece& piece : Trapezoids(sides, std::move(all)).Run()) {
    pieces.push_back({Lift(piece.sample), piece.area});
  }
  return pieces;
}

}  // namespace touchstone::exact
