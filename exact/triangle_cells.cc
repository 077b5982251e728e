// SPDX-License-Identifier: GPL-3.0-or-later
#include "touchstone/exact/triangle_cells.h"

#include <algorithm>

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
  const mpq_class c = Area(s.first, s.second, t.first), d = Area(s.first, s.second, t.second);
  const mpq_class e = Area(t.first, t.second, s.first), f = Area(t.first, t.second, s.second);
  if (sgn(c) * sgn(d) >= 0 || sgn(e) * sgn(f) >= 0) return;  // ends are listed anyway
  heights->push_back(s.first[1] + (s.second[1] - s.first[1]) * e / (e - f));
}

void SortUnique(std::vector<mpq_class>* values) {
  std::sort(values->begin(), values->end());
  values->erase(std::unique(values->begin(), values->end()), values->end());
}

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

std::vector<RationalPoint> RationalTriangle::SamplePieces(
    std::span<const RationalSegment> segments) const {
  const std::array<FlatSegment, 3> sides = FlatSides();
  std::vector<FlatSegment> all(sides.begin(), sides.end());
  for (const auto& [a, b] : segments) all.emplace_back(Flatten(a), Flatten(b));
  const auto [low, high] = std::minmax({sides[0].first[1], sides[1].first[1], sides[2].first[1]});
  std::vector<mpq_class> heights;
  for (std::size_t k = 0; k < all.size(); ++k) {
    heights.push_back(all[k].first[1]);
    heights.push_back(all[k].second[1]);
    for (std::size_t l = 0; l < k; ++l) AddCrossing(all[k], all[l], &heights);
  }
  std::erase_if(heights, [&](const mpq_class& y) { return y < low || y > high; });
  SortUnique(&heights);

  std::vector<RationalPoint> samples;
  for (std::size_t k = 0; k + 1 < heights.size(); ++k) {
    const mpq_class y = (heights[k] + heights[k + 1]) / 2;
    std::vector<mpq_class> crossings, ends;
    for (const FlatSegment& side : sides) {
      if (Spans(side, y)) ends.push_back(At(side, y));
    }
    SortUnique(&ends);
    if (ends.size() < 2) continue;
    for (const FlatSegment& s : all) {
      if (!Spans(s, y)) continue;
      mpq_class x = At(s, y);
      if (x >= ends.front() && x <= ends.back()) crossings.push_back(std::move(x));
    }
    SortUnique(&crossings);
    for (std::size_t c = 0; c + 1 < crossings.size(); ++c) {
      samples.push_back(Lift({(crossings[c] + crossings[c + 1]) / 2, y}));
    }
  }
  return samples;
}

}  // namespace touchstone::exact
