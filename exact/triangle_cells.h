// SPDX-License-Identifier: GPL-3.0-or-later
//
// One triangle and what lies in its plane, in fractions.
#ifndef TOUCHSTONE_EXACT_TRIANGLE_CELLS_H_
#define TOUCHSTONE_EXACT_TRIANGLE_CELLS_H_

#include <gmpxx.h>

#include <array>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace touchstone::exact {

using RationalPoint = std::array<mpq_class, 3>;
using RationalSegment = std::pair<RationalPoint, RationalPoint>;

RationalPoint operator-(const RationalPoint& a, const RationalPoint& b);
RationalPoint Cross(const RationalPoint& a, const RationalPoint& b);
mpq_class Dot(const RationalPoint& a, const RationalPoint& b);

class RationalTriangle {
 public:
  // Requires corners that are not collinear.
  explicit RationalTriangle(const std::array<RationalPoint, 3>& corners);

  const std::array<RationalPoint, 3>& corners() const { return corners_; }
  const RationalPoint& normal() const { return normal_; }
  // The sign of normal . (x - corner).
  int Side(const RationalPoint& x) const;

  // What the plane cuts from another triangle that does not lie in it: a segment, its ends equal
  // where the plane meets a corner only; nothing where it misses.
  std::optional<RationalSegment> CutFrom(const RationalTriangle& other) const;

  // Of points and segments in the plane: does the closed triangle hold, or meet, them?
  bool Holds(const RationalPoint& x) const;
  bool HoldsInside(const RationalPoint& x) const;  // the open triangle
  bool Meets(const RationalSegment& segment) const;

  // A connected piece of the open triangle.
  struct Piece {
    RationalPoint sample;  // inside it
    mpq_class area;        // of its shadow along `axis()`
  };
  // The pieces that segments in the plane cut the open triangle into. Between the heights at which
  // segments begin, end or cross one another, they cut it into trapezoids; those that meet along a
  // height where no segment lies between them are one piece. Complexity: O(n^2 log n) and the
  // heights times n.
  std::vector<Piece> Pieces(std::span<const RationalSegment> segments) const;

  // A coordinate of the normal that is not zero.
  int axis() const { return axis_; }

 private:
  using Flat = std::array<mpq_class, 2>;
  using FlatSegment = std::pair<Flat, Flat>;

  Flat Flatten(const RationalPoint& x) const { return {x[i_], x[j_]}; }
  RationalPoint Lift(const Flat& x) const;
  std::array<FlatSegment, 3> FlatSides() const;

  std::array<RationalPoint, 3> corners_;
  RationalPoint normal_;
  int axis_ = 0, i_ = 1, j_ = 2;  // normal_[axis_] is not zero
};

}  // namespace touchstone::exact

#endif  // TOUCHSTONE_EXACT_TRIANGLE_CELLS_H_
