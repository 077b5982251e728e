// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef TOUCHSTONE_EXACT_NEF_MINKOWSKI_H_
#define TOUCHSTONE_EXACT_NEF_MINKOWSKI_H_

#include "touchstone/exact/convert.h"
#include "touchstone/exact/minkowski_difference.h"

namespace touchstone::exact {

// M by CGAL::minkowski_sum_3 of the Nef polyhedra of P and of Q reflected: slow (tenths of a second
// for n = 8), and the construction tier's own check.
MinkowskiDifference NefMinkowski(const PlacedPair& pair);

}  // namespace touchstone::exact

#endif  // TOUCHSTONE_EXACT_NEF_MINKOWSKI_H_
