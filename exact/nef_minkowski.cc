// SPDX-License-Identifier: GPL-3.0-or-later
#include "touchstone/exact/nef_minkowski.h"

#include <algorithm>

#include "touchstone/exact/nef_sum_internal.h"

namespace touchstone::exact {
namespace {

IntegerPolyhedron WithLoopsOf(const ExactBodyData& body) {
  IntegerPolyhedron result;
  for (int f = 0; f < body.face_count; ++f) {
    result.loops.emplace_back(body.face(f).begin(), body.face(f).end());
  }
  return result;
}

}  // namespace

MinkowskiDifference NefMinkowski(const PlacedPair& pair) {
  // P's points as differences from Q's vertex 0, and Q's reflected from there: their sum is M.
  IntegerPolyhedron p = WithLoopsOf(pair.p()), q = WithLoopsOf(pair.q());
  for (int a = 0; a < pair.p().vertex_count; ++a) p.points.push_back(pair.Difference({a, 0}));
  for (int b = 0; b < pair.q().vertex_count; ++b) {
    q.points.push_back(pair.Difference({0, b}) - pair.Difference({0, 0}));
  }
  for (std::vector<int>& loop : q.loops) std::reverse(loop.begin(), loop.end());
  NefSum sum = SumOfNefPolyhedra(p, q);

  std::vector<ExactPlane> planes;
  for (const auto& [normal, offset] : sum.planes) {
    // Of the two orientations, the outward one: c is inside.
    if (Dot(normal, pair.c()) < offset) planes.push_back(MakePlane(normal, offset));
  }
  MinkowskiDifference result;
  result.facets = ClassifyFacets(pair, std::move(planes));
  result.vertices = Corners(std::move(sum.points), result.facets);
  return result;
}

}  // namespace touchstone::exact
