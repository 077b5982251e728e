// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef TOUCHSTONE_EXACT_EXTENDED_H_
#define TOUCHSTONE_EXACT_EXTENDED_H_

#include <cfloat>
#include <cmath>

#include "touchstone/exact/integer.h"

namespace touchstone::exact {

// The host's widest number, with the interface of Real, for filters: what it settles needs no Real.
// With the 64 bits of x86's long double each operation is off by at most 2^-63 of its result in any
// rounding mode, and a conversion from an integer by 2^-62; formulas here are products, quotients
// and square roots, a dozen operations at most, and sums of what has one sign, hence good to 2^-58.
class Extended {
 public:
  // Whether it is wider than a double here, and its range that of 15 bits of exponent.
  static constexpr bool kServes = LDBL_MANT_DIG >= 64 && LDBL_MAX_EXP >= 16384;
  // Integers short enough that their products of degree four, and powers of two up to 2^2200
  // besides, stay in that range.
  static bool Holds(const Integer& v) { return kServes && mpz_size(v.get_mpz_t()) <= 39; }
  static bool Holds(const IntegerVector& v) { return Holds(v[0]) && Holds(v[1]) && Holds(v[2]); }

  Extended() = default;
  explicit Extended(double v) : value_(v) {}
  explicit Extended(const Integer& v) : value_(FromInteger(v)) {}

  friend Extended operator+(Extended a, Extended b) { return Of(a.value_ + b.value_); }
  friend Extended operator-(Extended a, Extended b) { return Of(a.value_ - b.value_); }
  friend Extended operator*(Extended a, Extended b) { return Of(a.value_ * b.value_); }
  friend Extended operator/(Extended a, Extended b) { return Of(a.value_ / b.value_); }
  friend Extended Sqrt(Extended a) { return Of(std::sqrt(a.value_)); }
  friend Extended Abs(Extended a) { return Of(std::fabs(a.value_)); }
  friend Extended Scale(Extended a, long e) { return Of(std::scalbln(a.value_, e)); }
  friend bool operator<(Extended a, Extended b) { return a.value_ < b.value_; }
  friend bool operator>(Extended a, Extended b) { return a.value_ > b.value_; }

  int sign() const { return (value_ > 0) - (value_ < 0); }
  double ToDouble() const { return static_cast<double>(value_); }

 private:
  static Extended Of(long double v) {
    Extended result;
    result.value_ = v;
    return result;
  }
  // The top two limbs, which hold at least 65 bits; what is cut off is below 2^-64 of the whole.
  static long double FromInteger(const Integer& v) {
    static_assert(GMP_NUMB_BITS == 64);
    const std::size_t count = mpz_size(v.get_mpz_t());
    if (count == 0) return 0.0L;
    const long double high = mpz_getlimbn(v.get_mpz_t(), static_cast<mp_size_t>(count) - 1);
    if (count == 1) return sgn(v) < 0 ? -high : high;
    const long double low = mpz_getlimbn(v.get_mpz_t(), static_cast<mp_size_t>(count) - 2);
    const long double size =
        std::scalbln(high * 0x1p64L + low, 64 * (static_cast<long>(count) - 2));
    return sgn(v) < 0 ? -size : size;
  }

  long double value_ = 0.0L;
};

}  // namespace touchstone::exact

#endif  // TOUCHSTONE_EXACT_EXTENDED_H_
