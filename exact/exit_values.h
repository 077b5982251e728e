// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef TOUCHSTONE_EXACT_EXIT_VALUES_H_
#define TOUCHSTONE_EXACT_EXIT_VALUES_H_

#include <array>

#include "touchstone/exact/convert.h"
#include "touchstone/exact/integer.h"
#include "touchstone/exact/real.h"

namespace touchstone::exact {

// The numbers that follow from c and from where a plane of M meets the ray, to about 1e-75 of
// themselves: ratio = 1/s is an exact fraction, and only |c| and |n| are square roots.
struct ExitValues {
  Real interior_distance;  // |c|
  Real signed_distance;    // d = (ratio - 1) / |c|
  Real plane_distance;     // from c to the plane, (h(n) - n.c) / |n|
  // For ratio > 0, where the ray meets the plane at all; zero otherwise.
  Real parameter;                  // s
  Real exit_travel;                // g = (1 - s) |c|
  Real normal_cosine;              // n.(-c) / (|n| |c|)
  std::array<Real, 3> exit_point;  // (1 - s) c
};

// Requires c != o, c inside M, and ratio = RatioOf(pair, n).
ExitValues ValuesAt(const PlacedPair& pair, const IntegerVector& n, const Ratio& ratio);

}  // namespace touchstone::exact

#endif  // TOUCHSTONE_EXACT_EXIT_VALUES_H_
