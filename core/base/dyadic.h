// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_BASE_DYADIC_H_
#define TOUCHSTONE_CORE_BASE_DYADIC_H_

#include <Eigen/Core>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <utility>

namespace touchstone {

// An exact number m * 2^e: every finite double, and every sum, difference and product of such.
// No division, hence no gcd and no rounding; the sign of any polynomial of doubles is exact.
class Dyadic {
 public:
  Dyadic() = default;
  // Requires a finite value. Independent of the rounding mode and of flush-to-zero.
  explicit Dyadic(double value);
  explicit Dyadic(int value) : mantissa_(value) {}

  int sign() const { return mantissa_.sign(); }
  // The nearest double, ties to even, denormal ones included, whatever the rounding mode; infinite
  // beyond a double's range.
  double ToDouble() const;
  // Returns f with value = f * 2^*exponent up to one rounding of f to nearest, 0.5 <= |f| < 1, or 0
  // for 0: never out of range.
  double ToScaledDouble(int* exponent) const;

  friend Dyadic operator+(const Dyadic& a, const Dyadic& b);
  friend Dyadic operator-(const Dyadic& a, const Dyadic& b);
  friend Dyadic operator*(const Dyadic& a, const Dyadic& b);
  Dyadic operator-() const;

  friend double RatioToDouble(const Dyadic& a, const Dyadic& b);

 private:
  // Up to 1024 bits live in place: degree-six polynomials of doubles of similar size do not
  // allocate.
  using Integer = boost::multiprecision::number<boost::multiprecision::cpp_int_backend<
      1024, 0, boost::multiprecision::signed_magnitude, boost::multiprecision::unchecked,
      std::allocator<boost::multiprecision::limb_type>>>;
  Dyadic(Integer mantissa, int exponent) : mantissa_(std::move(mantissa)), exponent_(exponent) {}
  // a + b, or a - b
  static Dyadic Sum(const Dyadic& a, const Dyadic& b, bool subtract);

  Integer mantissa_ = 0;
  int exponent_ = 0;
};

// The double nearest to a / b, as Dyadic::ToDouble; b not zero.
double RatioToDouble(const Dyadic& a, const Dyadic& b);

using DyadicVector = std::array<Dyadic, 3>;

DyadicVector ToDyadic(const Eigen::Vector3d& v);
DyadicVector operator+(const DyadicVector& a, const DyadicVector& b);
DyadicVector operator-(const DyadicVector& a, const DyadicVector& b);
DyadicVector Cross(const DyadicVector& a, const DyadicVector& b);
Dyadic Dot(const DyadicVector& a, const DyadicVector& b);
// det [a b c] = a . (b x c).
Dyadic Determinant(const DyadicVector& a, const DyadicVector& b, const DyadicVector& c);

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_BASE_DYADIC_H_
