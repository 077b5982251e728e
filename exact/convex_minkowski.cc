// SPDX-License-Identifier: GPL-3.0-or-later
#include "touchstone/exact/convex_minkowski.h"

#include <algorithm>

#include "touchstone/exact/hull_of_integers_internal.h"

namespace touchstone::exact {

MinkowskiDifference ConvexMinkowski(const PlacedPair& pair) {
  std::vector<IntegerVector> differences;
  for (int a = 0; a < pair.p().vertex_count; ++a) {
    for (int b = 0; b < pair.q().vertex_count; ++b) differences.push_back(pair.Difference({a, b}));
  }
  std::sort(differences.begin(), differences.end());
  differences.erase(std::unique(differences.begin(), differences.end()), differences.end());
  std::vector<ExactPlane> planes;
  std::vector<IntegerVector> used;
  for (const std::array<int, 3>& triangle : HullOfIntegers(differences)) {
    const IntegerVector& a = differences[triangle[0]];
    const IntegerVector n = Cross(differences[triangle[1]] - a, differences[triangle[2]] - a);
    planes.push_back(MakePlane(n, Dot(n, a)));
    for (const int i : triangle) used.push_back(differences[i]);
  }
  MinkowskiDifference result;
  result.facets = ClassifyFacets(pair, std::move(planes));
  result.vertices = Corners(std::move(used), result.facets);
  return result;
}

}  // namespace touchstone::exact
