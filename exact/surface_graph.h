// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef TOUCHSTONE_EXACT_SURFACE_GRAPH_H_
#define TOUCHSTONE_EXACT_SURFACE_GRAPH_H_

#include <array>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "touchstone/exact/triangle_cells.h"

namespace touchstone::exact {

// What a triangulated surface is, however it is cut into triangles: equal for two triangulations of
// one surface, and for no others that differ in a facet, a corner, a neighbour or the genus.
struct SurfaceGraph {
  // A plane's normal and offset, divided by the normal's first coordinate that is not zero, in
  // size; the normal keeps its sense.
  using Plane = std::array<mpq_class, 4>;
  // Triangles of one oriented plane that hang together through edges of two triangles.
  struct Facet {
    Plane plane;
    std::vector<RationalPoint> corners;  // of its border, sorted
    friend bool operator==(const Facet&, const Facet&) = default;
    friend bool operator<(const Facet& x, const Facet& y) {
      return std::tie(x.plane, x.corners) < std::tie(y.plane, y.corners);
    }
  };
  std::vector<Facet> facets;                   // sorted
  std::vector<std::pair<int, int>> neighbors;  // facets that share an edge; sorted, smaller first
  std::vector<int> euler_characteristics;      // of pieces that hang together by edges; sorted

  friend bool operator==(const SurfaceGraph&, const SurfaceGraph&) = default;
};

// Requires triangles of positive area. Complexity: O(n log n) comparisons of fractions.
SurfaceGraph MakeSurfaceGraph(std::span<const RationalPoint> points,
                              std::span<const std::array<int, 3>> triangles);

}  // namespace touchstone::exact

#endif  // TOUCHSTONE_EXACT_SURFACE_GRAPH_H_
