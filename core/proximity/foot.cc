// SPDX-License-Identifier: MIT
#include "touchstone/core/proximity/foot.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "touchstone/core/cd_dual/exact_support.h"
#include "touchstone/core/proximity/estimate_internal.h"

namespace touchstone {
namespace {

using internal::Cross;
using internal::Dot;
using internal::ErrorNorm;
using internal::Estimate;
using internal::EstimateVector;
using internal::MakeEstimate;
using internal::Values;

// x and the weights of the simplex's points, scaled.
struct FootNumbers {
  Estimate distance;
  EstimateVector x;
  Eigen::Vector3d outward;  // any length
  std::array<Estimate, 3> weights;
};

FootNumbers InDoubles(const MinkowskiDifference& m, const Simplex& simplex) {
  const auto edge_to = [&](int i) {
    return internal::DifferenceOf(m, simplex.points[i], simplex.points[0]);
  };
  const EstimateVector w = internal::PointOf(m, simplex.points[0]);
  const Estimate one{1.0, 0.0};
  FootNumbers out;
  if (simplex.size == 1) {
    out.weights[0] = one;
    out.x = w;
    out.distance = Norm(w);
    out.outward = -Values(out.x);
    return out;
  }
  const EstimateVector u = edge_to(1);
  if (simplex.size == 2) {
    out.weights[1] = -Dot(u, w) / Dot(u, u);
    out.weights[0] = one - out.weights[1];
    out.x = w + out.weights[1] * u;
    out.distance = Norm(out.x);
    out.outward = -Values(out.x);
    return out;
  }
  const EstimateVector v = edge_to(2), n = Cross(u, v);
  const Estimate squared = Dot(n, n), height = Dot(n, w), length = Norm(n);
  out.weights[1] = Dot(n, Cross(v, w)) / squared;
  out.weights[2] = Dot(n, Cross(w, u)) / squared;
  out.weights[0] = one - out.weights[1] - out.weights[2];
  out.distance = Estimate{std::abs(height.value), height.error} / length;
  out.x = (height / squared) * n;
  out.outward = Values(n);
  return out;
}

FootNumbers InBigNumbers(Signs* signs, const Simplex& simplex) {
  signs->CountExact();
  const ExactDifference& big = signs->exact();
  std::array<DyadicVector, 3> w;
  for (int i = 0; i < simplex.size; ++i) w[i] = big.Point(simplex.points[i]);
  std::array<Dyadic, 3> weights = {Dyadic(1), Dyadic(0), Dyadic(0)};
  Dyadic whole(1);
  DyadicVector x = w[0];  // times `whole` and the common factor of big points
  if (simplex.size == 2) {
    const DyadicVector u = w[1] - w[0];
    whole = Dot(u, u);
    weights = {Dot(u, w[1]), -Dot(u, w[0]), Dyadic(0)};
    for (int k = 0; k < 3; ++k) x[k] = weights[0] * w[0][k] + weights[1] * w[1][k];
  } else if (simplex.size == 3) {
    const DyadicVector n = Cross(w[1] - w[0], w[2] - w[0]);
    whole = Dot(n, n);
    for (int i = 0; i < 3; ++i) weights[i] = Dot(n, Cross(w[(i + 1) % 3], w[(i + 2) % 3]));
    const Dyadic height = Dot(n, w[0]);
    x = {height * n[0], height * n[1], height * n[2]};
  }
  // Every ratio is rounded once.
  const auto rounded = [](double value) {
    return Estimate{value, kRoundingUnit * std::abs(value)};
  };
  FootNumbers out;
  for (int i = 0; i < 3; ++i) out.weights[i] = rounded(RatioToDouble(weights[i], whole));
  const Dyadic scale(signs->difference().scale()), denominator = whole * big.factor();
  for (int k = 0; k < 3; ++k) out.x[k] = rounded(RatioToDouble(scale * x[k], denominator));
  out.distance = Norm(out.x);
  out.outward = -Values(out.x);
  if (simplex.size == 3) out.outward = ToDirection(Cross(w[1] - w[0], w[2] - w[0]));
  return out;
}

// sum l_i a_i as a_0 + sum l_i (a_i - a_0). Weights that rounding took out of [0, 1], or their sum,
// are brought back: nearer to the exact one, or no further from it than the weights before are from
// theirs.
template <class PointOfPair>
EstimateVector Mixed(const Simplex& simplex, const FootNumbers& numbers,
                     const PointOfPair& point_of) {
  const Eigen::Vector3d first = point_of(simplex.points[0]);
  EstimateVector sum = MakeEstimate(first, 0.0);
  double left = 1.0, error_before = 0.0;
  for (int i = 1; i < simplex.size; ++i) {
    Estimate weight = numbers.weights[i];
    weight.value = std::clamp(weight.value, 0.0, left);
    weight.error = std::max(weight.error, error_before);
    error_before += weight.error;
    left -= weight.value;
    const Eigen::Vector3d step = point_of(simplex.points[i]) - first;
    const double rounding = kRoundingUnit * step.cwiseAbs().maxCoeff();
    sum = sum + weight * MakeEstimate(step, rounding);
  }
  return sum;
}

Eigen::Vector3d Unit(const Eigen::Vector3d& x) {
  // hypot scales: x may be as short as a denormal number.
  const double length = std::hypot(x[0], x[1], x[2]);
  Eigen::Vector3d unit = x / length;
  if (!(length > 0.0) || !unit.allFinite()) return Eigen::Vector3d::UnitX();
  unit /= unit.norm();
  return unit;
}

Foot Finish(const MinkowskiDifference& m, const Simplex& simplex, const FootNumbers& numbers) {
  const RelativePose& pose = m.pose();
  const EstimateVector on_p =
      Mixed(simplex, numbers, [&](VertexPair pair) { return m.PointOfP(pair.p); });
  const EstimateVector on_q = Mixed(simplex, numbers, [&](VertexPair pair) -> Eigen::Vector3d {
    return pose.rotation() * m.PointOfQ(pair.q) + pose.translation();
  });
  Foot foot;
  foot.distance = m.Unscale(numbers.distance.value);
  foot.distance_error = m.Unscale(numbers.distance.error);
  foot.point = Values(numbers.x) / m.scale();
  foot.point_error = m.Unscale(ErrorNorm(numbers.x));
  foot.outward = Unit(numbers.outward);
  foot.on_p = Values(on_p);
  foot.on_q = Values(on_q);
  // R b + t is off by less than the coordinate error of b's points of M in each coordinate.
  foot.on_error =
      std::max(ErrorNorm(on_p), 1.01 * (ErrorNorm(on_q) + 1.8 * m.Unscale(m.coordinate_error())));
  return foot;
}

}  // namespace

Foot MeasureFoot(const MinkowskiDifference& m, const Simplex& simplex) {
  return Finish(m, simplex, InDoubles(m, simplex));
}

Foot MeasureFootExactly(Signs* signs, const Simplex& simplex) {
  return Finish(signs->difference(), simplex, InBigNumbers(signs, simplex));
}

}  // namespace touchstone
