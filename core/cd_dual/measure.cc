// SPDX-License-Identifier: MIT
#include "touchstone/core/cd_dual/measure.h"

#include <algorithm>
#include <cmath>

namespace touchstone {
namespace {

constexpr double kClaimPerCondition = 1e-12;  // the largest relative error claimed, per condition

struct Estimate {
  double value = 0.0;
  double error = 0.0;
};

// (a +- ea) / (b +- eb), the quotient rounded once. An error of infinity when b may be zero.
Estimate Divide(const Estimate& a, const Estimate& b) {
  const double value = a.value / b.value;
  const double margin = std::abs(b.value) - b.error;
  if (!(margin > 0.0)) return {0.0, HUGE_VAL};
  return {value, 1.01 * ((a.error + std::abs(value) * b.error) / margin +
                         1.1 * kRoundingUnit * std::abs(value))};
}

Estimate Multiply(const Estimate& a, const Estimate& b) {
  const double value = a.value * b.value;
  return {value, 1.01 * (std::abs(a.value) * b.error + std::abs(b.value) * a.error +
                         a.error * b.error + 1.1 * kRoundingUnit * std::abs(value))};
}

// The exit's three numbers in scaled lengths: tau = -K / E with exit point tau c, g and d.
struct ExitNumbers {
  Estimate tau, g, d;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  double point_error = 0.0;
};

ExitNumbers InDoubles(const Signs& signs, const std::array<VertexPair, 3>& triangle) {
  const MinkowskiDifference& m = signs.difference();
  const FacetPlane plane = signs.Plane(triangle);
  Eigen::Vector3d w = m.Point(triangle[0]);
  for (int i = 1; i < 3; ++i) {  // the plane's point nearest to o: the tilt of n weighs least there
    const Eigen::Vector3d other = m.Point(triangle[i]);
    if (other.squaredNorm() < w.squaredNorm()) w = other;
  }
  // n.x with n off by dn and x by dx in each coordinate.
  const auto along_normal = [&](const Eigen::Vector3d& x, double dx) {
    const double ln = plane.normal.lpNorm<1>() + 3.0 * plane.normal_error;
    return Estimate{plane.normal.dot(x),
                    1.01 * (3.1 * kRoundingUnit * ln * x.cwiseAbs().maxCoeff() + ln * dx +
                            plane.normal_error * x.lpNorm<1>()) +
                        0x1p-1000};
  };
  const double e = m.coordinate_error();
  const Estimate k = along_normal(w, e);
  const Estimate toward_o = along_normal(-m.c(), e);
  // w - c is rounded once more: at most u times a coordinate no larger than 2.
  const Estimate depth = along_normal(w - m.c(), 2.0 * e + 2.0 * kRoundingUnit);
  const Estimate c{m.c_norm(), 1.01 * (1.8 * e + 4.0 * kRoundingUnit * m.c_norm())};

  ExitNumbers out;
  out.tau = Divide({-k.value, k.error}, toward_o);
  out.g = Multiply(out.tau, c);
  out.d = Divide(Divide({-k.value, k.error}, depth), c);
  out.point = out.tau.value * m.c();
  out.point_error = 1.01 * (out.g.error + 1.8 * e * std::abs(out.tau.value)) +
                    2.0 * kRoundingUnit * std::abs(out.g.value);
  return out;
}

ExitNumbers InBigNumbers(Signs* signs, const std::array<VertexPair, 3>& triangle) {
  const MinkowskiDifference& m = signs->difference();
  const ExactDifference& big = signs->exact();
  const DyadicVector v0 = big.Point(triangle[0]);
  const DyadicVector n = Cross(big.Point(triangle[1]) - v0, big.Point(triangle[2]) - v0);
  const DyadicVector c = big.Point(kInteriorDifference);
  const Dyadic k = Dot(n, v0), depth = Dot(n, v0 - c), toward_o = depth - k;

  // c itself, scaled: big points carry a factor (one unless there are two world poses).
  const Dyadic scale(m.scale());
  Eigen::Vector3d c_scaled;
  for (int i = 0; i < 3; ++i) c_scaled[i] = RatioToDouble(scale * c[i], big.factor());
  const double length = c_scaled.norm();

  // Each ratio is good to 2 ulp, each coordinate of c too, the norm adds three roundings, each
  // product one: below 8 u; 12 u leaves room for the roundings of the claim itself.
  const auto claimed = [](double value) {
    return Estimate{value, 12.0 * kRoundingUnit * std::abs(value)};
  };
  ExitNumbers out;
  out.tau = claimed(-RatioToDouble(k, toward_o));
  out.g = claimed(out.tau.value * length);
  out.d = claimed(-RatioToDouble(k, depth) / length);
  out.point = out.tau.value * c_scaled;
  out.point_error = out.g.error * 2.0;
  return out;
}

}  // namespace

void MeasureExit(Signs* signs, const std::array<VertexPair, 3>& triangle, CollideResult* result) {
  const MinkowskiDifference& m = signs->difference();
  ExitNumbers numbers = InDoubles(*signs, triangle);

  // A perturbation of the points by delta moves the plane's crossing with the line of c by about
  // delta / |n.c / (|n||c|)|: relative to g, size / (cosine |g|); d = g / (|c|^2 s) with s = 1 -
  // g/|c| changes by delta / (cosine |c|^2 s^2).
  const Eigen::Vector3d n = signs->Plane(triangle).normal;
  const double cosine = std::abs(n.dot(m.c())) / (n.norm() * m.c_norm());
  const auto conditions = [&](const ExitNumbers& x) {
    const double s = 1.0 - x.tau.value;
    const double in_g = m.size() / (cosine * std::abs(x.g.value));
    const double in_d = m.size() / (cosine * m.c_norm() * m.c_norm() * s * s * std::abs(x.d.value));
    return std::pair{in_g, in_d};
  };
  auto [condition_g, condition_d] = conditions(numbers);
  const auto tight = [](const Estimate& x, double condition) {
    return x.error <= kClaimPerCondition * condition * std::abs(x.value);
  };
  if (!tight(numbers.g, condition_g) || !tight(numbers.d, condition_d)) {
    numbers = InBigNumbers(signs, triangle);
    std::tie(condition_g, condition_d) = conditions(numbers);
  }
  const auto bounded = [](const Estimate& x, double condition, double factor) {
    if (x.value == 0.0) return BoundedValue{0.0, x.error * factor, 1.0};  // not -0
    if (!std::isfinite(condition)) condition = 1.0;
    return BoundedValue{x.value * factor, x.error * factor, std::max(condition, 1.0)};
  };
  result->exit_travel = bounded(numbers.g, condition_g, 1.0 / m.scale());
  result->signed_distance = bounded(numbers.d, condition_d, m.scale());
  result->exit_point = numbers.point / m.scale();
  result->exit_point_error = numbers.point_error / m.scale();
}

}  // namespace touchstone
