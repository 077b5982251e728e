// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/sample_internal.h"

#include <Eigen/Geometry>
#include <cmath>
#include <optional>
#include <utility>

namespace touchstone::internal {
namespace {

using Eigen::Vector3d;

// The weighted mean of points, exactly, with its rounding.
Sample MeanOf(SumGeometry* geometry, const std::array<int, 3>& points) {
  Sample sample;
  Dyadic product(1);
  for (const int x : points) product = product * geometry->Exact(x).denominator;
  sample.exact.coordinates = {Dyadic(0), Dyadic(0), Dyadic(0)};
  for (int k = 0; k < 3; ++k) {
    const Dyadic others = geometry->Exact(points[(k + 1) % 3]).denominator *
                          geometry->Exact(points[(k + 2) % 3]).denominator;
    sample.exact.coordinates =
        sample.exact.coordinates + others * geometry->Exact(points[k]).coordinates;
  }
  sample.exact.denominator = Dyadic(3) * product * geometry->factor();
  double largest = 0.0;
  for (int i = 0; i < 3; ++i) {
    sample.rounded[i] = RatioToDouble(sample.exact.coordinates[i], sample.exact.denominator);
    largest = std::max(largest, std::abs(sample.rounded[i]));
  }
  sample.error = kUnit * largest;
  return sample;
}

// A number near `value` of few bits, so that exact numbers made with it stay short.
double Short(double value) { return std::round(value * 0x1p20) * 0x1p-20; }

// corner + s (next - corner) + t (previous - corner) near the triangle's middle, for short s and t,
// if doubles can tell that it lies inside.
std::optional<Sample> TryInFacet(SumGeometry* geometry, const ArrangedFacet& facet,
                                 const std::array<int, 3>& triangle) {
  const int last = facet.corners[facet.count - 1];
  const SumPoint &p = geometry->point(facet.corners[0]), &q = geometry->point(facet.corners[1]),
                 &r = geometry->point(last);
  Vector3d middle = Vector3d::Zero();
  for (const int x : triangle) middle += geometry->point(x).rounded / 3.0;
  const Vector3d u = q.rounded - p.rounded, v = r.rounded - p.rounded, w = middle - p.rounded;
  const Vector3d normal = u.cross(v);
  const double squared = normal.squaredNorm();
  const double s = Short(w.cross(v).dot(normal) / squared);
  const double t = Short(u.cross(w).dot(normal) / squared);
  if (!(std::abs(s) < 2.0 && std::abs(t) < 2.0)) return std::nullopt;
  SumPoint x{SumPointForm::kVertex, {}, p.rounded + s * u + t * v, 0.0};
  // Weights of at most 5, 2 and 2 in size; six roundings of numbers of at most 10.
  x.error = 10.0 * std::max({p.error, q.error, r.error}) + 100.0 * kUnit;
  const int axis = geometry->NormalAxis(facet.plane);
  const auto turn = [&](int k) {
    return SumGeometry::TriageTurn(geometry->point(triangle[k]),
                                   geometry->point(triangle[(k + 1) % 3]), x, axis);
  };
  if (turn(0) == 0 || turn(1) != turn(0) || turn(2) != turn(0)) return std::nullopt;
  Sample sample;
  const DyadicVector& origin = geometry->Exact(facet.corners[0]).coordinates;
  sample.exact.coordinates = origin +
                             Dyadic(s) * (geometry->Exact(facet.corners[1]).coordinates - origin) +
                             Dyadic(t) * (geometry->Exact(last).coordinates - origin);
  sample.exact.denominator = geometry->factor();
  const double scale = geometry->pair().scale();
  sample.rounded = x.rounded / scale;
  sample.error = x.error / scale;
  return sample;
}

}  // namespace

Sample SampleIn(SumGeometry* geometry, const ArrangedFacet& facet,
                const std::array<int, 3>& triangle) {
  if (const auto sample = TryInFacet(geometry, facet, triangle)) return *sample;
  return MeanOf(geometry, triangle);
}

Sample SampleBetween(SumGeometry* geometry, int x, int y) {
  // Thirds are as good as halves.
  return MeanOf(geometry, {x, y, y});
}

double SquaredArea(const SumGeometry& geometry, const std::array<int, 3>& triangle) {
  const Vector3d& o = geometry.point(triangle[0]).rounded;
  return (geometry.point(triangle[1]).rounded - o)
      .cross(geometry.point(triangle[2]).rounded - o)
      .squaredNorm();
}

}  // namespace touchstone::internal
