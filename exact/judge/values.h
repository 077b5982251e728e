// SPDX-License-Identifier: GPL-3.0-or-later
//
// Check 4: how far d, g, c and the exit point may be from the truth, and how large the claimed
// errors and condition may be.
//
//   u      a relative error of coordinates        S   the size: PlacedPair::size()
//   c, s   as in decide.h; r = 1/s                nu  normal_cosine: n.(-c) / (|n| |c|), in (0, 1]
//   g, d   (1 - s) |c|, (r - 1) / |c|             value: the double that the result states
//
// First-order conditions. Moving every coordinate by u S moves the plane of the exit facet, at the
// exit point, by at most a small multiple of u S along its normal (the exit point is a convex
// combination of the facet's vertices, so a thin triangle does no harm), and c by as much. The
// ray's point 1 - s = t is where t n.c = k, k the plane's offset: dt = (dk - t n.dc) / (n.c), so
// |dt| <= u S (1 + |t|) / (nu |c|), and 1 + |1 - s| <= 1 + (1 + s) is a constant times 1 + s. Hence
//
//   amplification of g:  A_g = S (1 + s) / nu                            |dg| <= const u A_g
//   amplification of d:  A_d = S (1 + s) / (nu s^2 |c|^2) + |d| S / |c|   |dd| <= const u A_d
//
// (d depends on s by r - 1 = 1/s - 1, and on |c|, which moves by u S.) The constant covers the
// three coordinates, the three products of a rotation, and the factor above: it is taken as 64.
//
// What the judge demands of a BoundedValue (value, error, condition) with amplification A:
//
//   |value - exact| <= error                                 else value_out_of_bounds
//   condition <= 64 (1 + A / |value|)         value != 0     else loose_bound
//   error <= 1e-12 condition |value|          value != 0     else loose_bound
//   error <= 64e-12 A                         value == 0     else loose_bound
//   error and condition are finite and not negative          else loose_bound
//
// Of the exit point (1 - s) c: |point - exact| <= exit_point_error <= 64e-12 (A_g + |g|).
// Of interior_difference: |stated - c| <= 64 * 2^-53 S in each coordinate.
//
// S is the largest absolute coordinate of P's vertices, plus that of Q's, plus the largest absolute
// entry of the translation; for a pose made from two world poses plus those of the two world
// translations. All four amplifications are computed from the exact values, to a relative error
// below 1e-12.
#ifndef TOUCHSTONE_EXACT_JUDGE_VALUES_H_
#define TOUCHSTONE_EXACT_JUDGE_VALUES_H_

#include "touchstone/exact/exit_values.h"

namespace touchstone::exact {

struct Amplifications {
  double signed_distance;  // A_d
  double exit_travel;      // A_g
};

inline constexpr double kConditionFactor = 64.0;
inline constexpr double kErrorFactor = 1e-12;

// Requires that the ray meets the plane (ratio > 0).
template <class Number>
Amplifications AmplificationsAt(const ExitValuesOf<Number>& values, double size) {
  const Number one(1.0), s = values.parameter, length = values.interior_distance;
  const Number g = Number(size) * (one + s) / values.normal_cosine;
  const Number d =
      g / (s * s * length * length) + Abs(values.signed_distance) * Number(size) / length;
  return {d.ToDouble(), g.ToDouble()};
}

}  // namespace touchstone::exact

#endif  // TOUCHSTONE_EXACT_JUDGE_VALUES_H_
