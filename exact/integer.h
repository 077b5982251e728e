// SPDX-License-Identifier: GPL-3.0-or-later
//
// Exact arithmetic: every double of a query is an integer times a power of two, so after scaling to
// a common power every predicate is the sign of a polynomial of integers. No division, no gcd.
#ifndef TOUCHSTONE_EXACT_INTEGER_H_
#define TOUCHSTONE_EXACT_INTEGER_H_

#include <gmpxx.h>

#include <Eigen/Core>
#include <array>

namespace touchstone::exact {

using Integer = mpz_class;
using IntegerVector = std::array<Integer, 3>;
using IntegerMatrix = std::array<IntegerVector, 3>;  // rows

// value = mantissa * 2^exponent; the mantissa is odd, or zero with exponent 0.
struct SplitDouble {
  long mantissa = 0;
  int exponent = 0;
};
SplitDouble Split(double value);

// The smallest exponent of the non-zero values; INT_MAX if all are zero.
int CommonExponent(const double* values, int count, int start);
// value / 2^exponent, which must be an integer.
Integer ToInteger(double value, int exponent);
IntegerVector ToInteger(const Eigen::Vector3d& v, int exponent);

Integer Dot(const IntegerVector& a, const IntegerVector& b);
// sign(a . b).
int DotSign(const IntegerVector& a, const IntegerVector& b);
IntegerVector Cross(const IntegerVector& a, const IntegerVector& b);
// det [a b c] = a . (b x c).
Integer Determinant(const IntegerVector& a, const IntegerVector& b, const IntegerVector& c);
IntegerVector operator-(const IntegerVector& a, const IntegerVector& b);
IntegerVector operator-(const IntegerVector& a);
IntegerVector operator*(const Integer& s, const IntegerVector& a);
bool IsZero(const IntegerVector& a);

IntegerVector Multiply(const IntegerMatrix& m, const IntegerVector& v);
IntegerVector MultiplyTransposed(const IntegerMatrix& m, const IntegerVector& v);
IntegerMatrix Multiply(const IntegerMatrix& a, const IntegerMatrix& b);
// det(m) times the inverse transpose of m: how normals transform.
IntegerMatrix Cofactors(const IntegerMatrix& m);
IntegerMatrix Transposed(const IntegerMatrix& m);

// v / 2^*exponent in doubles, the largest component in [0.5, 1) in size, or zero for zero. Each
// component is off by less than 2^-52 of itself, or of 2^-1000 where that is more.
Eigen::Vector3d ToDirection(const IntegerVector& v, long* exponent = nullptr);

// a / b * 2^exponent to within 2^-51 of itself; zero where that is below 2^-1000.
double Quotient(const Integer& a, const Integer& b, long exponent);

// A fraction with a positive denominator, not reduced.
struct Ratio {
  Integer numerator;
  Integer denominator = 1;
};
// sign(a - b).
int Compare(const Ratio& a, const Ratio& b);
mpq_class ToRational(const Ratio& a);

}  // namespace touchstone::exact

#endif  // TOUCHSTONE_EXACT_INTEGER_H_
