// SPDX-License-Identifier: MIT
#include "touchstone/core/proximity/signs_of_points.h"

#include <algorithm>

#include "touchstone/core/proximity/estimate_internal.h"

namespace touchstone {
namespace {

using internal::Cross;
using internal::DifferenceOf;
using internal::Dot;
using internal::Estimate;
using internal::EstimateVector;
using internal::MakeEstimate;
using internal::PointOf;

std::optional<int> Settled(const Estimate& value) {
  if (value.value > value.error) return 1;
  if (value.value < -value.error) return -1;
  return std::nullopt;  // also for NaN
}

DyadicVector ExactNormal(const ExactDifference& big, const std::array<VertexPair, 3>& points) {
  const DyadicVector origin = big.Point(points[0]);
  return Cross(big.Point(points[1]) - origin, big.Point(points[2]) - origin);
}

// How many different numbers there are among four; the first two of them in `values`.
int CountDistinct(const std::array<int, 4>& numbers) {
  int count = 0;
  for (int i = 0; i < 4; ++i) {
    count += std::find(numbers.begin(), numbers.begin() + i, numbers[i]) == numbers.begin() + i;
  }
  return count;
}

// Whether one facet of the body (faces in one plane taken together) holds all four vertices.
bool ShareFacet(const ConvexPolyhedron& shape, const std::array<int, 4>& vertices) {
  const auto holds = [&](int facet, int v) {
    const auto faces = shape.vertex_faces(v);
    return std::any_of(faces.begin(), faces.end(),
                       [&](int f) { return shape.facet_of_face(f) == facet; });
  };
  const auto faces = shape.vertex_faces(vertices[0]);
  return std::any_of(faces.begin(), faces.end(), [&](int f) {
    const int facet = shape.facet_of_face(f);
    return holds(facet, vertices[1]) && holds(facet, vertices[2]) && holds(facet, vertices[3]);
  });
}

}  // namespace

std::optional<int> AlongEdge(Signs* signs, VertexPair to, VertexPair from, VertexPair at) {
  const MinkowskiDifference& m = signs->difference();
  if (const auto sign = Settled(Dot(DifferenceOf(m, to, from), PointOf(m, at)))) return sign;
  if (!signs->exact_allowed()) return std::nullopt;
  signs->CountExact();
  const ExactDifference& big = signs->exact();
  return Dot(big.Point(to) - big.Point(from), big.Point(at)).sign();
}

std::optional<int> FootSide(Signs* signs, const FacetPlane& plane, VertexPair a, VertexPair b) {
  const MinkowskiDifference& m = signs->difference();
  const EstimateVector n = MakeEstimate(plane.normal, plane.normal_error);
  // a x b as a x (b - a): the nearness of a and b does no harm.
  if (const auto sign = Settled(Dot(n, Cross(PointOf(m, a), DifferenceOf(m, b, a))))) return sign;
  if (!signs->exact_allowed()) return std::nullopt;
  signs->CountExact();
  const ExactDifference& big = signs->exact();
  return Dot(ExactNormal(big, plane.points), Cross(big.Point(a), big.Point(b))).sign();
}

std::optional<int> Beyond(Signs* signs, const std::array<VertexPair, 3>& points, VertexPair w) {
  const MinkowskiDifference& m = signs->difference();
  if (CoplanarByIdentity(m, {points[0], points[1], points[2], w})) return 0;
  const EstimateVector n =
      Cross(DifferenceOf(m, points[1], points[0]), DifferenceOf(m, points[2], points[0]));
  if (const auto sign = Settled(Dot(n, DifferenceOf(m, w, points[0])))) return sign;
  if (!signs->exact_allowed()) return std::nullopt;
  signs->CountExact();
  const ExactDifference& big = signs->exact();
  return Dot(ExactNormal(big, points), big.Point(w) - big.Point(points[0])).sign();
}

bool CoplanarByIdentity(const MinkowskiDifference& m, const std::array<VertexPair, 4>& points) {
  const std::array<int, 4> in_p = {points[0].p, points[1].p, points[2].p, points[3].p};
  const std::array<int, 4> in_q = {points[0].q, points[1].q, points[2].q, points[3].q};
  const int count_p = CountDistinct(in_p), count_q = CountDistinct(in_q);
  if (count_p <= 2 && count_q <= 2) return true;
  if (std::min(in_p[0], in_q[0]) < 0) return false;  // c
  if (count_q == 1) return ShareFacet(m.p(), in_p);
  if (count_p == 1) return ShareFacet(m.q(), in_q);
  return false;
}

int CompareDistances(Signs* signs, const std::array<VertexPair, 3>& a,
                     const std::array<VertexPair, 3>& b) {
  signs->CountExact();
  const ExactDifference& big = signs->exact();
  const DyadicVector normal_a = ExactNormal(big, a), normal_b = ExactNormal(big, b);
  const Dyadic height_a = Dot(normal_a, big.Point(a[0])), height_b = Dot(normal_b, big.Point(b[0]));
  return (height_a * height_a * Dot(normal_b, normal_b) -
          height_b * height_b * Dot(normal_a, normal_a))
      .sign();
}

}  // namespace touchstone
