// SPDX-License-Identifier: MIT
#include "touchstone/core/convex/bounding_ellipsoid.h"

#include <algorithm>
#include <cmath>

namespace touchstone {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kUnit = 0x1p-52;  // relative error of one operation in any rounding mode

// Three times the covariance. Divided by the count as it goes: no sum leaves the range of a double.
Matrix3d SecondMoments(std::span<const Vector3d> vertices) {
  const double share = 1.0 / static_cast<double>(vertices.size());
  Vector3d mean = Vector3d::Zero();
  for (const Vector3d& vertex : vertices) mean += share * vertex;
  Matrix3d moments = Matrix3d::Zero();
  for (const Vector3d& vertex : vertices) {
    const Vector3d x = vertex - mean;
    moments += (3.0 * share * x) * x.transpose();
  }
  return moments;
}

// Cholesky's factor; where a pivot drowns in rounding (a body a million times thinner than wide)
// the pivot is lifted to a millionth of the largest, which only makes the ellipsoid thicker.
Matrix3d LowerFactor(const Matrix3d& a) {
  const double least = 1e-12 * a.diagonal().maxCoeff();
  Matrix3d factor = Matrix3d::Zero();
  for (int j = 0; j < 3; ++j) {
    double pivot = a(j, j);
    for (int k = 0; k < j; ++k) pivot -= factor(j, k) * factor(j, k);
    factor(j, j) = std::sqrt(std::max(pivot, least));
    for (int i = j + 1; i < 3; ++i) {
      double sum = a(i, j);
      for (int k = 0; k < j; ++k) sum -= factor(i, k) * factor(j, k);
      factor(i, j) = sum / factor(j, j);
    }
  }
  return factor;
}

// The Euclidean length, rounded up.
double LengthBound(const Vector3d& v) {
  return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) * (1.0 + 8 * kUnit);
}

}  // namespace

BoundingEllipsoid BoundVertices(std::span<const Vector3d> vertices, const Vector3d& middle) {
  BoundingEllipsoid bound;
  const Matrix3d l = LowerFactor(SecondMoments(vertices));
  bound.factor_xx = l(0, 0), bound.factor_yx = l(1, 0), bound.factor_zx = l(2, 0);
  bound.factor_yy = l(1, 1), bound.factor_zy = l(2, 1), bound.factor_zz = l(2, 2);
  const Matrix3d a = l * l.transpose();
  bound.moments = {a(0, 0), a(0, 1), a(0, 2), a(1, 1), a(1, 2), a(2, 2)};
  for (const Vector3d& vertex : vertices) {
    const Vector3d x = vertex - middle;
    Vector3d y;  // about l^-1 x
    y[0] = x[0] / l(0, 0);
    y[1] = (x[1] - l(1, 0) * y[0]) / l(1, 1);
    y[2] = (x[2] - l(2, 0) * y[0] - l(2, 1) * y[1]) / l(2, 2);
    // What l y misses, and what may be wrong with that: x was rounded once, each sum of l y has
    // three products and three sums, 5 u of its absolute terms.
    const Vector3d image = l * y;
    const Vector3d terms = l.cwiseAbs() * y.cwiseAbs();
    const Vector3d missed =
        (x - image).cwiseAbs() + 6.0 * kUnit * (x.cwiseAbs() + terms + image.cwiseAbs());
    bound.radius = std::max(bound.radius, LengthBound(y));
    bound.slack = std::max(bound.slack, LengthBound(missed));
    // |fl(x)| is within 2 u |x| of the length.
    bound.ball_radius = std::max(bound.ball_radius, LengthBound(x) * (1.0 + 4 * kUnit));
  }
  return bound;
}

}  // namespace touchstone
