// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/integers.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace touchstone {
namespace {

using Eigen::Vector3d;

// value = mantissa * 2^exponent, whatever the rounding mode.
struct Parts {
  std::int64_t mantissa;
  int exponent;
};

Parts Split(double value) {
  const auto pattern = std::bit_cast<std::uint64_t>(value);
  const int field = static_cast<int>((pattern >> 52) & 0x7ff);
  std::uint64_t significand = pattern & ((std::uint64_t{1} << 52) - 1);
  if (field != 0) significand |= std::uint64_t{1} << 52;
  if (significand == 0) return {0, std::numeric_limits<int>::max()};
  const int zeros = std::countr_zero(significand);
  const auto mantissa = static_cast<std::int64_t>(significand >> zeros);
  return {(pattern >> 63) != 0 ? -mantissa : mantissa, std::max(field, 1) - 1075 + zeros};
}

Integer At(const Parts& parts, int exponent) {
  if (parts.mantissa == 0) return 0;
  return Integer(parts.mantissa) << (parts.exponent - exponent);
}

}  // namespace

IntegerVector operator-(const IntegerVector& v) { return {-v[0], -v[1], -v[2]}; }

IntegerVector operator+(const IntegerVector& a, const IntegerVector& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

IntegerVector Multiple(const Integer& factor, const IntegerVector& v) {
  return {factor * v[0], factor * v[1], factor * v[2]};
}

Integer Dot(const IntegerVector& a, const IntegerVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

IntegerVector Cross(const IntegerVector& a, const IntegerVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Integer Determinant(const IntegerVector& a, const IntegerVector& b, const IntegerVector& c) {
  return Dot(a, Cross(b, c));
}

int DigitsOf(const IntegerVector& v) {
  int digits = 0;
  for (const Integer& x : v) {
    if (x.sign() != 0) digits = std::max(digits, static_cast<int>(msb(abs(x))) + 1);
  }
  return digits;
}

IntegerVector Shifted(const IntegerVector& v, int shift) {
  IntegerVector shifted;
  for (int i = 0; i < 3; ++i) {
    const Integer magnitude =
        shift >= 0 ? Integer(abs(v[i]) << shift) : Integer(abs(v[i]) >> -shift);
    shifted[i] = v[i].sign() < 0 ? Integer(-magnitude) : magnitude;
  }
  return shifted;
}

IntegerVector ToIntegers(const Vector3d& v) { return DifferenceToIntegers(v, Vector3d::Zero()); }

IntegerVector DifferenceToIntegers(const Vector3d& to, const Vector3d& from) {
  Parts parts[2][3];
  int exponent = std::numeric_limits<int>::max();
  for (int i = 0; i < 3; ++i) {
    parts[0][i] = Split(to[i]);
    parts[1][i] = Split(from[i]);
    exponent = std::min({exponent, parts[0][i].exponent, parts[1][i].exponent});
  }
  IntegerVector difference;
  for (int i = 0; i < 3; ++i) difference[i] = At(parts[0][i], exponent) - At(parts[1][i], exponent);
  return difference;
}

std::vector<IntegerVector> ToCommonIntegers(std::span<const Vector3d> vectors) {
  int exponent = std::numeric_limits<int>::max();
  for (const Vector3d& v : vectors) {
    for (int i = 0; i < 3; ++i) exponent = std::min(exponent, Split(v[i]).exponent);
  }
  std::vector<IntegerVector> integers;
  for (const Vector3d& v : vectors) {
    integers.push_back(
        {At(Split(v[0]), exponent), At(Split(v[1]), exponent), At(Split(v[2]), exponent)});
  }
  return integers;
}

IntegerVector Primitive(const IntegerVector& v) {
  const Integer divisor = gcd(gcd(v[0], v[1]), v[2]);
  if (divisor == 1) return v;
  return {v[0] / divisor, v[1] / divisor, v[2] / divisor};
}

// Coordinates are cut to 62 digits, 2^-61 of the largest, and rounded, 2^-53; squares, sum, root
// and quotient add at most 2^-51.3 to a coordinate below one in all.
Vector3d UnitOf(const IntegerVector& v) {
  const IntegerVector cut = Shifted(v, 62 - DigitsOf(v));
  Vector3d x;
  for (int i = 0; i < 3; ++i) x[i] = static_cast<double>(static_cast<std::int64_t>(cut[i]));
  return x / std::sqrt(x.squaredNorm());
}

double ToScaledDouble(const Integer& value, int* exponent) {
  *exponent = 0;
  if (value.sign() == 0) return 0.0;
  const Integer magnitude = abs(value);
  const int digits = static_cast<int>(msb(magnitude)) + 1;
  const Integer cut =
      digits > 62 ? Integer(magnitude >> (digits - 62)) : Integer(magnitude << (62 - digits));
  *exponent = digits;
  const double fraction = static_cast<double>(static_cast<std::int64_t>(cut)) * 0x1p-62;
  return value.sign() < 0 ? -fraction : fraction;
}

}  // namespace touchstone
