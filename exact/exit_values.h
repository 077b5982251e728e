// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef TOUCHSTONE_EXACT_EXIT_VALUES_H_
#define TOUCHSTONE_EXACT_EXIT_VALUES_H_

#include <array>
#include <optional>

#include "touchstone/exact/convert.h"
#include "touchstone/exact/extended.h"
#include "touchstone/exact/integer.h"
#include "touchstone/exact/real.h"

namespace touchstone::exact {

// The numbers that follow from c and from where a plane of M meets the ray: ratio = 1/s is an exact
// fraction, and only |c| and |n| are square roots. To about 1e-75 of themselves as Real, to 2^-58
// as Extended.
template <class Number>
struct ExitValuesOf {
  Number interior_distance;  // |c|
  Number signed_distance;    // d = (ratio - 1) / |c|
  Number plane_distance;     // from c to the plane, (h(n) - n.c) / |n|
  // For ratio > 0, where the ray meets the plane at all; zero otherwise.
  Number parameter;                  // s
  Number exit_travel;                // g = (1 - s) |c|
  Number normal_cosine;              // n.(-c) / (|n| |c|)
  std::array<Number, 3> exit_point;  // (1 - s) c
};
using ExitValues = ExitValuesOf<Real>;

// Requires c != o, c inside M, and ratio = RatioOf(pair, n).
ExitValues ValuesAt(const PlacedPair& pair, const IntegerVector& n, const Ratio& ratio);
// The same, for filters. Nothing where Extended does not serve, or where the integers are too long
// for its range.
std::optional<ExitValuesOf<Extended>> ExtendedValuesAt(const PlacedPair& pair,
                                                       const IntegerVector& n, const Ratio& ratio);

}  // namespace touchstone::exact

#endif  // TOUCHSTONE_EXACT_EXIT_VALUES_H_
