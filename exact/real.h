// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef TOUCHSTONE_EXACT_REAL_H_
#define TOUCHSTONE_EXACT_REAL_H_

#include <mpfr.h>

#include "touchstone/exact/integer.h"

namespace touchstone::exact {

// A number of 256 bits: where a square root stands between an exact fraction and a double. Each
// operation is off by at most 2^-256 of its result; formulas here are products, quotients and
// square roots of exact integers, a dozen operations at most, hence good to 2^-250 (5e-76).
class Real {
 public:
  Real() {
    mpfr_custom_init(limbs_, kBits);
    mpfr_custom_init_set(value_, MPFR_ZERO_KIND, 0, kBits, limbs_);
  }
  explicit Real(double v) : Real() { mpfr_set_d(value_, v, MPFR_RNDN); }
  explicit Real(const Integer& v) : Real() { mpfr_set_z(value_, v.get_mpz_t(), MPFR_RNDN); }
  Real(const Real& o) : Real() { mpfr_set(value_, o.value_, MPFR_RNDN); }
  Real& operator=(const Real& o) {
    mpfr_set(value_, o.value_, MPFR_RNDN);
    return *this;
  }

  friend Real operator+(const Real& a, const Real& b) {
    Real r;
    mpfr_add(r.value_, a.value_, b.value_, MPFR_RNDN);
    return r;
  }
  friend Real operator-(const Real& a, const Real& b) {
    Real r;
    mpfr_sub(r.value_, a.value_, b.value_, MPFR_RNDN);
    return r;
  }
  friend Real operator*(const Real& a, const Real& b) {
    Real r;
    mpfr_mul(r.value_, a.value_, b.value_, MPFR_RNDN);
    return r;
  }
  friend Real operator/(const Real& a, const Real& b) {
    Real r;
    mpfr_div(r.value_, a.value_, b.value_, MPFR_RNDN);
    return r;
  }
  friend Real Sqrt(const Real& a) {
    Real r;
    mpfr_sqrt(r.value_, a.value_, MPFR_RNDN);
    return r;
  }
  friend Real Abs(const Real& a) {
    Real r;
    mpfr_abs(r.value_, a.value_, MPFR_RNDN);
    return r;
  }
  // a * 2^e.
  friend Real Scale(const Real& a, long e) {
    Real r;
    mpfr_mul_2si(r.value_, a.value_, e, MPFR_RNDN);
    return r;
  }
  friend bool operator<(const Real& a, const Real& b) {
    return mpfr_less_p(a.value_, b.value_) != 0;
  }
  friend bool operator>(const Real& a, const Real& b) { return b < a; }

  int sign() const { return mpfr_sgn(value_); }
  // The nearest double.
  double ToDouble() const { return mpfr_get_d(value_, MPFR_RNDN); }

 private:
  static constexpr int kBits = 256;
  mpfr_t value_;
  mp_limb_t limbs_[kBits / GMP_NUMB_BITS];  // the significand: nothing is on the heap
};

}  // namespace touchstone::exact

#endif  // TOUCHSTONE_EXACT_REAL_H_
