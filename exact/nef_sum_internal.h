// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef TOUCHSTONE_EXACT_NEF_SUM_INTERNAL_H_
#define TOUCHSTONE_EXACT_NEF_SUM_INTERNAL_H_

#include <vector>

#include "touchstone/exact/integer.h"

namespace touchstone::exact {

// A closed polyhedron: loops counterclockwise from outside.
struct IntegerPolyhedron {
  std::vector<IntegerVector> points;
  std::vector<std::vector<int>> loops;
};

// The planes n.x = k of all facets of a sum, in both orientations, and its vertices.
struct NefSum {
  std::vector<std::pair<IntegerVector, Integer>> planes;
  std::vector<IntegerVector> points;
};

// The Minkowski sum by CGAL::minkowski_sum_3. CGAL stays behind this one function: it compiles for
// a minute.
NefSum SumOfNefPolyhedra(const IntegerPolyhedron& a, const IntegerPolyhedron& b);

}  // namespace touchstone::exact

#endif  // TOUCHSTONE_EXACT_NEF_SUM_INTERNAL_H_
