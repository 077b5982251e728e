// SPDX-License-Identifier: GPL-3.0-or-later
#include "touchstone/exact/nearest_point.h"

#include <algorithm>
#include <vector>

#include "touchstone/exact/support.h"

namespace touchstone::exact {
namespace {

bool HoldsOrigin(const PlacedPair& pair, const std::vector<VertexPair>& tetrahedron) {
  std::array<IntegerVector, 4> w;
  for (int i = 0; i < 4; ++i) w[i] = pair.Difference(tetrahedron[i]);
  const int whole = sgn(Determinant(w[1] - w[0], w[2] - w[0], w[3] - w[0]));
  if (whole == 0) return false;
  // o replaces each vertex in turn: the volume keeps its sign.
  const int parts[4] = {sgn(Determinant(w[1], w[2], w[3])), -sgn(Determinant(w[0], w[2], w[3])),
                        sgn(Determinant(w[0], w[1], w[3])), -sgn(Determinant(w[0], w[1], w[2]))};
  return std::all_of(parts, parts + 4, [&](int part) { return part * whole >= 0; });
}

std::array<Real, 3> ToLength(const PlacedPair& pair, const IntegerVector& v,
                             const Integer& denominator) {
  std::array<Real, 3> result;
  for (int k = 0; k < 3; ++k) result[k] = pair.ToLength(Real(v[k]) / Real(denominator));
  return result;
}

}  // namespace

std::optional<ExactPoint> NearestOfHull(const PlacedPair& pair,
                                        std::span<const VertexPair> points) {
  ExactPoint x;
  x.size = static_cast<int>(points.size());
  std::array<IntegerVector, 3> w;
  for (int i = 0; i < x.size; ++i) {
    x.points[i] = points[i];
    w[i] = pair.Difference(points[i]);
  }
  if (x.size == 1) {
    x.weights[0] = 1;
    x.numerator = w[0];
    return x;
  }
  const IntegerVector u = w[1] - w[0];
  if (x.size == 2) {
    x.denominator = Dot(u, u);
    x.weights = {Dot(u, w[1]), Integer(-Dot(u, w[0])), 0};
  } else {
    const IntegerVector n = Cross(u, w[2] - w[0]);
    x.denominator = Dot(n, n);
    for (int i = 0; i < 3; ++i) x.weights[i] = Dot(n, Cross(w[(i + 1) % 3], w[(i + 2) % 3]));
  }
  if (sgn(x.denominator) == 0) return std::nullopt;
  for (int i = 0; i < x.size; ++i) {
    if (sgn(x.weights[i]) < 0) return std::nullopt;
    for (int k = 0; k < 3; ++k) x.numerator[k] += x.weights[i] * w[i][k];
  }
  return x;
}

std::optional<ExactPoint> NearestOfVertices(const PlacedPair& pair,
                                            std::span<const VertexPair> vertices) {
  const int count = static_cast<int>(vertices.size());
  std::optional<ExactPoint> best;
  for (unsigned members = 1; members < 1u << count; ++members) {
    std::vector<VertexPair> part;
    for (int i = 0; i < count; ++i) {
      if (members >> i & 1u) part.push_back(vertices[i]);
    }
    if (part.size() > 3) continue;
    std::optional<ExactPoint> x = NearestOfHull(pair, part);
    if (!x.has_value()) continue;
    // The nearest point of the hull is that of one of its parts, and no part has a nearer one.
    // |x|^2 = x.x / denominator^2.
    const Integer squared = Dot(x->numerator, x->numerator);
    if (best.has_value()) {
      const Integer best_squared = Dot(best->numerator, best->numerator);
      if (squared * best->denominator * best->denominator >=
          best_squared * x->denominator * x->denominator) {
        continue;
      }
    }
    best = std::move(x);
  }
  return best;
}

bool IsNearest(const PlacedPair& pair, const ExactPoint& x) {
  if (IsZero(x.numerator)) return false;
  const IntegerVector lowest = pair.Difference(SupportingPair(pair, -x.numerator));
  // Every point of the simplex with a positive weight is as far along x as x itself.
  return Dot(x.numerator, lowest) * x.denominator >= Dot(x.numerator, x.numerator);
}

std::optional<ExactPoint> FindNearest(const PlacedPair& pair) {
  std::vector<VertexPair> vertices = {SupportingPair(pair, pair.v())};
  for (;;) {
    const std::optional<ExactPoint> x = NearestOfVertices(pair, vertices);
    if (!x.has_value() || IsZero(x->numerator)) return std::nullopt;
    const VertexPair lowest = SupportingPair(pair, -x->numerator);
    if (Dot(x->numerator, pair.Difference(lowest)) * x->denominator >=
        Dot(x->numerator, x->numerator)) {
      return x;
    }
    vertices.assign(x->points.begin(), x->points.begin() + x->size);
    vertices.push_back(lowest);
    if (vertices.size() == 4 && HoldsOrigin(pair, vertices)) return std::nullopt;
  }
}

Real LengthOf(const PlacedPair& pair, const ExactPoint& x) {
  return pair.ToLength(Sqrt(Real(Dot(x.numerator, x.numerator))) / Real(x.denominator));
}

std::array<Real, 3> PointOnP(const PlacedPair& pair, const ExactPoint& x) {
  IntegerVector sum;
  for (int i = 0; i < x.size; ++i) {
    for (int k = 0; k < 3; ++k) sum[k] += x.weights[i] * pair.p().vertices[x.points[i].p][k];
  }
  std::array<Real, 3> point;
  for (int k = 0; k < 3; ++k)
    point[k] = Scale(Real(sum[k]) / Real(x.denominator), pair.p().exponent);
  return point;
}

std::array<Real, 3> PointOnQ(const PlacedPair& pair, const ExactPoint& x) {
  std::array<Real, 3> point = PointOnP(pair, x);
  const std::array<Real, 3> difference = ToLength(pair, x.numerator, x.denominator);
  for (int k = 0; k < 3; ++k) point[k] = point[k] - difference[k];
  return point;
}

}  // namespace touchstone::exact
