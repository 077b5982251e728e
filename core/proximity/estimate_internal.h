// SPDX-License-Identifier: MIT
//
// Numbers with a running error bound, for values that are computed once a query.
#ifndef TOUCHSTONE_CORE_PROXIMITY_ESTIMATE_INTERNAL_H_
#define TOUCHSTONE_CORE_PROXIMITY_ESTIMATE_INTERNAL_H_

#include <Eigen/Core>
#include <array>
#include <cmath>

#include "touchstone/core/cd_dual/minkowski_difference.h"

namespace touchstone::internal {

// |value - exact| <= error. Each operation adds its own rounding, u |value| with u = kRoundingUnit;
// the factor 1.01 makes up for the roundings of the error itself, a handful of additions and
// products of numbers that are not negative; 2^-1000 for what underflow takes from a product.
struct Estimate {
  double value = 0.0;
  double error = 0.0;
};

inline Estimate operator+(const Estimate& a, const Estimate& b) {
  const double value = a.value + b.value;
  return {value, 1.01 * (a.error + b.error + kRoundingUnit * std::abs(value))};
}

inline Estimate operator-(const Estimate& a, const Estimate& b) {
  const double value = a.value - b.value;
  return {value, 1.01 * (a.error + b.error + kRoundingUnit * std::abs(value))};
}

inline Estimate operator*(const Estimate& a, const Estimate& b) {
  const double value = a.value * b.value;
  return {value, 1.01 * (std::abs(a.value) * b.error + std::abs(b.value) * a.error +
                         a.error * b.error + kRoundingUnit * std::abs(value)) +
                     0x1p-1000};
}

// The error is infinite, and the value zero, when b may be zero.
inline Estimate operator/(const Estimate& a, const Estimate& b) {
  const double margin = std::abs(b.value) - b.error;
  if (!(margin > 0x1p-900)) return {0.0, HUGE_VAL};
  const double value = a.value / b.value;
  return {value, 1.01 * ((a.error + std::abs(value) * b.error) / margin +
                         kRoundingUnit * std::abs(value)) +
                     0x1p-1000};
}

inline Estimate operator-(const Estimate& a) { return {-a.value, a.error}; }

using EstimateVector = std::array<Estimate, 3>;

inline EstimateVector MakeEstimate(const Eigen::Vector3d& v, double error) {
  return {Estimate{v[0], error}, Estimate{v[1], error}, Estimate{v[2], error}};
}
inline EstimateVector operator+(const EstimateVector& a, const EstimateVector& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline EstimateVector operator*(const Estimate& s, const EstimateVector& a) {
  return {s * a[0], s * a[1], s * a[2]};
}
inline Estimate Dot(const EstimateVector& a, const EstimateVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline EstimateVector Cross(const EstimateVector& a, const EstimateVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// A point of M, scaled, and the difference of two.
inline EstimateVector PointOf(const MinkowskiDifference& m, VertexPair pair) {
  return MakeEstimate(m.Point(pair), m.coordinate_error());
}
inline EstimateVector DifferenceOf(const MinkowskiDifference& m, VertexPair to, VertexPair from) {
  double error = 0.0;
  const Eigen::Vector3d difference = m.Difference(to, from, &error);
  return MakeEstimate(difference, error);
}

inline Eigen::Vector3d Values(const EstimateVector& a) {
  return {a[0].value, a[1].value, a[2].value};
}
// At least the distance of the values from the exact vector.
inline double ErrorNorm(const EstimateVector& a) {
  return 1.01 * std::hypot(a[0].error, a[1].error, a[2].error);
}
// hypot neither overflows nor underflows; off by less than 4 u of itself.
inline Estimate Norm(const EstimateVector& a) {
  const double value = std::hypot(a[0].value, a[1].value, a[2].value);
  return {value, 1.01 * (ErrorNorm(a) + 4.0 * kRoundingUnit * value)};
}

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_PROXIMITY_ESTIMATE_INTERNAL_H_
