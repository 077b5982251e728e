// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef TOUCHSTONE_EXACT_NEAREST_POINT_H_
#define TOUCHSTONE_EXACT_NEAREST_POINT_H_

#include <array>
#include <optional>
#include <span>

#include "touchstone/core/cd_dual/result.h"
#include "touchstone/exact/convert.h"

namespace touchstone::exact {

// A point of M as a sum of vertices of M: x = numerator / denominator in the integer coordinates of
// the PlacedPair, = sum weights[i] points[i] / denominator.
struct ExactPoint {
  IntegerVector numerator;
  Integer denominator = 1;  // positive
  std::array<VertexPair, 3> points;
  std::array<Integer, 3> weights;  // not negative; their sum is the denominator
  int size = 0;
};

// The point nearest to o of the line or plane through one, two or three vertices of M; nothing when
// these do not span one, or when one of its weights is negative.
std::optional<ExactPoint> NearestOfHull(const PlacedPair& pair, std::span<const VertexPair> points);

// The point nearest to o of the hull of up to four vertices of M, o not in it.
std::optional<ExactPoint> NearestOfVertices(const PlacedPair& pair,
                                            std::span<const VertexPair> vertices);

// Whether nothing of M is nearer to o than x: M lies beyond the plane through x with normal x.
bool IsNearest(const PlacedPair& pair, const ExactPoint& x);

// The point of M nearest to o, when P and Q are separate; nothing when they meet. By the search of
// Gilbert, Johnson and Keerthi in exact arithmetic: x comes strictly nearer at every step and is
// one point for a simplex, so it ends. Complexity: O(m + n) a step, about ten steps.
std::optional<ExactPoint> FindNearest(const PlacedPair& pair);

// |x|, and the point of P, sum weights[i] P_i, in true lengths.
Real LengthOf(const PlacedPair& pair, const ExactPoint& x);
std::array<Real, 3> PointOnP(const PlacedPair& pair, const ExactPoint& x);
// The point of Q in P's frame: PointOnP - x.
std::array<Real, 3> PointOnQ(const PlacedPair& pair, const ExactPoint& x);

}  // namespace touchstone::exact

#endif  // TOUCHSTONE_EXACT_NEAREST_POINT_H_
