// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef TOUCHSTONE_EXACT_NEF_MESH_SUM_H_
#define TOUCHSTONE_EXACT_NEF_MESH_SUM_H_

#include <array>
#include <vector>

#include "touchstone/exact/mesh_pair.h"
#include "touchstone/exact/triangle_cells.h"

namespace touchstone::exact {

// M° = int A ⊕ -int B, an open set, by CGAL::minkowski_sum_3, in the pair's integers.
struct NefMeshSum {
  // The boundary of its closure, outward.
  std::vector<RationalPoint> points;
  std::vector<std::array<int, 3>> triangles;
  // Exact slots: what the closure's interior has more than the set. Its vertices and the middles of
  // its edges; none where there are no slots.
  std::vector<RationalPoint> slot_samples;
};

// Seconds for tens of faces, minutes for hundreds: the bodies are cut into convex parts, and the
// sums of all pairs of parts are united. CGAL stays behind this function: it compiles for a minute.
NefMeshSum MakeNefMeshSum(const PlacedMeshPair& pair);

}  // namespace touchstone::exact

#endif  // TOUCHSTONE_EXACT_NEF_MESH_SUM_H_
