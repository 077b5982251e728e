// SPDX-License-Identifier: MIT
#include "touchstone/core/base/dyadic.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstdint>
#include <limits>

namespace touchstone {
namespace {

constexpr int kDigits = 53;              // of a double's significand
constexpr int kLeastExponent = -1074;    // of the last place of a denormal
constexpr int kGreatestExponent = 1024;  // every finite double is below 2^1024
constexpr std::uint64_t kHiddenBit = std::uint64_t{1} << 52;

// The leading bits of a positive integer: value = (bits + something in [0, 1)) * 2^shift, that
// something not zero iff `sticky`. 64 bits when the integer has as many.
struct LeadingBits {
  std::uint64_t bits;
  int shift;
  bool sticky;
};

template <class Integer>
LeadingBits Lead(const Integer& positive) {
  const int length = static_cast<int>(msb(positive)) + 1;
  const int shift = std::max(0, length - 64);
  const Integer top = positive >> shift;
  return {static_cast<std::uint64_t>(top), shift, static_cast<int>(lsb(positive)) < shift};
}

// bits * 2^-drop rounded to the nearest integer, ties to even; 1 <= drop <= 64.
std::uint64_t RoundShift(std::uint64_t bits, int drop, bool sticky) {
  const std::uint64_t kept = drop < 64 ? bits >> drop : 0;
  const std::uint64_t half = std::uint64_t{1} << (drop - 1);
  const std::uint64_t rest = bits & (half | (half - 1));
  const bool up = rest > half || (rest == half && (sticky || (kept & 1) != 0));
  return kept + (up ? 1 : 0);
}

// The double nearest to (bits + [sticky]) * 2^exponent, put together from its bit pattern so that
// no rounding mode and no flush-to-zero has a say. Requires all 53 digits to be in `bits` if
// `sticky`.
double Assemble(std::uint64_t bits, int exponent, bool sticky, bool negative) {
  const std::uint64_t sign = negative ? std::uint64_t{1} << 63 : 0;
  const int length = 64 - std::countl_zero(bits);
  const int top = exponent + length;  // the value lies in [2^(top - 1), 2^top)
  if (bits == 0 || top < kLeastExponent) return std::bit_cast<double>(sign);
  if (top > kGreatestExponent) {
    return negative ? -std::numeric_limits<double>::infinity()
                    : std::numeric_limits<double>::infinity();
  }
  const int digits = std::min(kDigits, top - kLeastExponent);
  const int drop = length - digits;
  const std::uint64_t significand = drop > 0 ? RoundShift(bits, drop, sticky) : bits << -drop;
  // The hidden bit adds one to the exponent field, as does a carry out of the significand.
  const std::uint64_t field = digits == kDigits ? static_cast<std::uint64_t>(top + 1021) : 0;
  return std::bit_cast<double>(sign | ((field << 52) + significand));
}

}  // namespace

Dyadic::Dyadic(double value) {
  const auto pattern = std::bit_cast<std::uint64_t>(value);
  const int field = static_cast<int>((pattern >> 52) & 0x7ff);
  assert(field != 0x7ff);
  std::uint64_t significand = pattern & (kHiddenBit - 1);
  if (field != 0) significand |= kHiddenBit;
  if (significand == 0) return;
  const int zeros = std::countr_zero(significand);
  mantissa_ = significand >> zeros;
  if ((pattern >> 63) != 0) mantissa_.backend().negate();
  exponent_ = std::max(field, 1) - 1075 + zeros;
}

double Dyadic::ToDouble() const {
  if (sign() == 0) return 0.0;
  const LeadingBits lead = Lead(Integer(abs(mantissa_)));
  return Assemble(lead.bits, exponent_ + lead.shift, lead.sticky, sign() < 0);
}

double Dyadic::ToScaledDouble(int* exponent) const {
  *exponent = 0;
  if (sign() == 0) return 0.0;
  const LeadingBits lead = Lead(Integer(abs(mantissa_)));
  const int length = 64 - std::countl_zero(lead.bits);
  *exponent = exponent_ + lead.shift + length;
  double fraction = Assemble(lead.bits, -length, lead.sticky, sign() < 0);
  if (fraction == 1.0 || fraction == -1.0) {  // rounded up to the next power of two
    fraction *= 0.5;
    ++*exponent;
  }
  return fraction;
}

Dyadic Dyadic::Sum(const Dyadic& a, const Dyadic& b, bool subtract) {
  if (b.sign() == 0) return a;
  if (a.sign() == 0) return subtract ? -b : b;
  Dyadic sum;
  sum.exponent_ = std::min(a.exponent_, b.exponent_);
  if (a.exponent_ == b.exponent_) {
    sum.mantissa_ = a.mantissa_;
  } else {
    sum.mantissa_ = a.mantissa_ << (a.exponent_ - sum.exponent_);
  }
  if (b.exponent_ == sum.exponent_) {
    subtract ? sum.mantissa_ -= b.mantissa_ : sum.mantissa_ += b.mantissa_;
  } else {
    const Integer shifted = b.mantissa_ << (b.exponent_ - sum.exponent_);
    subtract ? sum.mantissa_ -= shifted : sum.mantissa_ += shifted;
  }
  return sum;
}

Dyadic operator+(const Dyadic& a, const Dyadic& b) { return Dyadic::Sum(a, b, false); }
Dyadic operator-(const Dyadic& a, const Dyadic& b) { return Dyadic::Sum(a, b, true); }

Dyadic operator*(const Dyadic& a, const Dyadic& b) {
  Dyadic product;
  if (a.sign() == 0 || b.sign() == 0) return product;
  product.mantissa_ = a.mantissa_ * b.mantissa_;
  product.exponent_ = a.exponent_ + b.exponent_;
  return product;
}

Dyadic Dyadic::operator-() const {
  Dyadic negated = *this;
  negated.mantissa_.backend().negate();
  return negated;
}

double RatioToDouble(const Dyadic& a, const Dyadic& b) {
  assert(b.sign() != 0);
  if (a.sign() == 0) return 0.0;
  using Integer = Dyadic::Integer;
  Integer numerator = abs(a.mantissa_);
  const Integer denominator = abs(b.mantissa_);
  // At least 64 bits of quotient, and whether anything remains, decide the rounding to 53.
  const int shift =
      std::max(0, 65 + static_cast<int>(msb(denominator)) - static_cast<int>(msb(numerator)));
  numerator <<= shift;
  Integer quotient, remainder;
  divide_qr(numerator, denominator, quotient, remainder);
  const LeadingBits lead = Lead(quotient);
  return Assemble(lead.bits, a.exponent_ - b.exponent_ - shift + lead.shift,
                  lead.sticky || remainder.sign() != 0, (a.sign() < 0) != (b.sign() < 0));
}

DyadicVector ToDyadic(const Eigen::Vector3d& v) {
  return {Dyadic(v[0]), Dyadic(v[1]), Dyadic(v[2])};
}

DyadicVector operator+(const DyadicVector& a, const DyadicVector& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

DyadicVector operator-(const DyadicVector& a, const DyadicVector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

DyadicVector Cross(const DyadicVector& a, const DyadicVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Dyadic Dot(const DyadicVector& a, const DyadicVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Dyadic Determinant(const DyadicVector& a, const DyadicVector& b, const DyadicVector& c) {
  return Dot(a, Cross(b, c));
}

}  // namespace touchstone
