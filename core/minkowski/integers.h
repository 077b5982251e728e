// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_MINKOWSKI_INTEGERS_H_
#define TOUCHSTONE_CORE_MINKOWSKI_INTEGERS_H_

#include <Eigen/Core>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <span>
#include <vector>

namespace touchstone {

// Directions are integer vectors, up to a positive factor: sums, products and quotients that come
// out even keep them so.
using Integer = boost::multiprecision::number<
    boost::multiprecision::cpp_int_backend<512, 0, boost::multiprecision::signed_magnitude,
                                           boost::multiprecision::unchecked,
                                           std::allocator<boost::multiprecision::limb_type>>,
    boost::multiprecision::et_off>;
using IntegerVector = std::array<Integer, 3>;

IntegerVector operator-(const IntegerVector& v);
IntegerVector operator+(const IntegerVector& a, const IntegerVector& b);
IntegerVector Multiple(const Integer& factor, const IntegerVector& v);
Integer Dot(const IntegerVector& a, const IntegerVector& b);
IntegerVector Cross(const IntegerVector& a, const IntegerVector& b);
// det [a b c] = a . (b x c).
Integer Determinant(const IntegerVector& a, const IntegerVector& b, const IntegerVector& c);

// The number of binary digits of the largest coordinate.
int DigitsOf(const IntegerVector& v);
// v times 2^shift, or over 2^-shift and cut off.
IntegerVector Shifted(const IntegerVector& v, int shift);

// A positive multiple of v, or of to - from, exactly. Requires finite values.
IntegerVector ToIntegers(const Eigen::Vector3d& v);
IntegerVector DifferenceToIntegers(const Eigen::Vector3d& to, const Eigen::Vector3d& from);

// All times one power of two, by which they become integers.
std::vector<IntegerVector> ToCommonIntegers(std::span<const Eigen::Vector3d> vectors);

// v over the greatest common divisor of its coordinates. Requires v not zero.
IntegerVector Primitive(const IntegerVector& v);
// v over its length: each coordinate within 2^-51. Requires v not zero.
Eigen::Vector3d UnitOf(const IntegerVector& v);

// The value is f * 2^*exponent for the f returned, up to 2^-52 of itself; 0.5 <= |f| <= 1, or 0.
double ToScaledDouble(const Integer& value, int* exponent);

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_MINKOWSKI_INTEGERS_H_
