// SPDX-License-Identifier: GPL-3.0-or-later
#include "touchstone/exact/integer.h"

#include <algorithm>
#include <bit>
#include <climits>
#include <cmath>
#include <cstdint>

namespace touchstone::exact {

SplitDouble Split(double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  long mantissa = static_cast<long>(bits & ((std::uint64_t{1} << 52) - 1));
  const int biased = static_cast<int>((bits >> 52) & 0x7ff);
  int exponent = biased == 0 ? -1074 : biased - 1075;
  if (biased != 0) mantissa |= long{1} << 52;
  if (mantissa == 0) return {};
  const int zeros = std::countr_zero(static_cast<std::uint64_t>(mantissa));
  mantissa >>= zeros;
  exponent += zeros;
  return {(bits >> 63) != 0 ? -mantissa : mantissa, exponent};
}

int CommonExponent(const double* values, int count, int start) {
  int exponent = start;
  for (int i = 0; i < count; ++i) {
    const SplitDouble split = Split(values[i]);
    if (split.mantissa != 0 && split.exponent < exponent) exponent = split.exponent;
  }
  return exponent;
}

Integer ToInteger(double value, int exponent) {
  const SplitDouble split = Split(value);
  Integer result = split.mantissa;
  if (split.mantissa != 0) {
    mpz_mul_2exp(result.get_mpz_t(), result.get_mpz_t(),
                 static_cast<mp_bitcnt_t>(split.exponent - exponent));
  }
  return result;
}

IntegerVector ToInteger(const Eigen::Vector3d& v, int exponent) {
  return {ToInteger(v.x(), exponent), ToInteger(v.y(), exponent), ToInteger(v.z(), exponent)};
}

Integer Dot(const IntegerVector& a, const IntegerVector& b) {
  Integer sum;
  mpz_mul(sum.get_mpz_t(), a[0].get_mpz_t(), b[0].get_mpz_t());
  mpz_addmul(sum.get_mpz_t(), a[1].get_mpz_t(), b[1].get_mpz_t());
  mpz_addmul(sum.get_mpz_t(), a[2].get_mpz_t(), b[2].get_mpz_t());
  return sum;
}

int DotSign(const IntegerVector& a, const IntegerVector& b) { return sgn(Dot(a, b)); }

IntegerVector Cross(const IntegerVector& a, const IntegerVector& b) {
  IntegerVector result;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    mpz_mul(result[i].get_mpz_t(), a[j].get_mpz_t(), b[k].get_mpz_t());
    mpz_submul(result[i].get_mpz_t(), a[k].get_mpz_t(), b[j].get_mpz_t());
  }
  return result;
}

Integer Determinant(const IntegerVector& a, const IntegerVector& b, const IntegerVector& c) {
  return Dot(a, Cross(b, c));
}

IntegerVector operator-(const IntegerVector& a, const IntegerVector& b) {
  return {Integer(a[0] - b[0]), Integer(a[1] - b[1]), Integer(a[2] - b[2])};
}

IntegerVector operator-(const IntegerVector& a) {
  return {Integer(-a[0]), Integer(-a[1]), Integer(-a[2])};
}

IntegerVector operator*(const Integer& s, const IntegerVector& a) {
  return {Integer(s * a[0]), Integer(s * a[1]), Integer(s * a[2])};
}

bool IsZero(const IntegerVector& a) { return sgn(a[0]) == 0 && sgn(a[1]) == 0 && sgn(a[2]) == 0; }

IntegerVector Multiply(const IntegerMatrix& m, const IntegerVector& v) {
  return {Dot(m[0], v), Dot(m[1], v), Dot(m[2], v)};
}

IntegerVector MultiplyTransposed(const IntegerMatrix& m, const IntegerVector& v) {
  IntegerVector result;
  for (int i = 0; i < 3; ++i) {
    mpz_mul(result[i].get_mpz_t(), m[0][i].get_mpz_t(), v[0].get_mpz_t());
    mpz_addmul(result[i].get_mpz_t(), m[1][i].get_mpz_t(), v[1].get_mpz_t());
    mpz_addmul(result[i].get_mpz_t(), m[2][i].get_mpz_t(), v[2].get_mpz_t());
  }
  return result;
}

IntegerMatrix Multiply(const IntegerMatrix& a, const IntegerMatrix& b) {
  return {MultiplyTransposed(b, a[0]), MultiplyTransposed(b, a[1]), MultiplyTransposed(b, a[2])};
}

IntegerMatrix Cofactors(const IntegerMatrix& m) {
  return {Cross(m[1], m[2]), Cross(m[2], m[0]), Cross(m[0], m[1])};
}

IntegerMatrix Transposed(const IntegerMatrix& m) {
  return {IntegerVector{m[0][0], m[1][0], m[2][0]}, IntegerVector{m[0][1], m[1][1], m[2][1]},
          IntegerVector{m[0][2], m[1][2], m[2][2]}};
}

Eigen::Vector3d ToDirection(const IntegerVector& v, long* exponent) {
  double mantissa[3];
  long exponents[3];
  long largest = LONG_MIN;
  for (int i = 0; i < 3; ++i) {
    mantissa[i] = mpz_get_d_2exp(&exponents[i], v[i].get_mpz_t());
    if (mantissa[i] != 0.0 && exponents[i] > largest) largest = exponents[i];
  }
  if (exponent != nullptr) *exponent = largest == LONG_MIN ? 0 : largest;
  Eigen::Vector3d result = Eigen::Vector3d::Zero();
  for (int i = 0; i < 3; ++i) {
    if (mantissa[i] == 0.0 || exponents[i] - largest < -1000) continue;
    result[i] = std::ldexp(mantissa[i], static_cast<int>(exponents[i] - largest));
  }
  return result;
}

double Quotient(const Integer& a, const Integer& b, long exponent) {
  if (sgn(a) == 0) return 0.0;
  long exponent_a = 0, exponent_b = 0;
  const double mantissa_a = mpz_get_d_2exp(&exponent_a, a.get_mpz_t());
  const double mantissa_b = mpz_get_d_2exp(&exponent_b, b.get_mpz_t());
  const long e = exponent_a - exponent_b + exponent;
  return e < -1000 ? 0.0
                   : std::ldexp(mantissa_a / mantissa_b, static_cast<int>(std::min(e, 1023L)));
}

int Compare(const Ratio& a, const Ratio& b) {
  const int sign_a = sgn(a.numerator), sign_b = sgn(b.numerator);
  if (sign_a != sign_b) return sign_a < sign_b ? -1 : 1;
  return sgn(Integer(a.numerator * b.denominator - b.numerator * a.denominator));
}

mpq_class ToRational(const Ratio& a) {
  mpq_class result(a.numerator, a.denominator);
  result.canonicalize();
  return result;
}

}  // namespace touchstone::exact
