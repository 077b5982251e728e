// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef TOUCHSTONE_EXACT_CONVEX_HULL_H_
#define TOUCHSTONE_EXACT_CONVEX_HULL_H_

#include <Eigen/Core>
#include <span>

#include "touchstone/core/base/status.h"
#include "touchstone/core/convex/convex_polyhedron.h"

namespace touchstone::exact {

struct HullOptions {
  // Faces are whole facets, polygons of any size; otherwise each facet is cut into triangles by a
  // fan from its vertex of smallest index.
  bool merge_coplanar = false;
};

// Returns the convex hull of `points`, built with exact predicates.
//
// The vertices are exactly the extreme points, their coordinates unchanged and in the order of
// their first appearance in `points`; points within an edge or a face of the hull are left out.
// Each loop starts at its smallest vertex and the faces are sorted, so that the answer depends on
// the points and their order alone. Errors: kNonFinite (naming the point), kTooFewVertices (fewer
// than four distinct points), kFlat, and whatever ConvexPolyhedron::Build refuses (kOutOfRange,
// kNoInteriorPoint). Complexity: expected O(n log n).
StatusOr<ConvexPolyhedron> ConvexHull(std::span<const Eigen::Vector3d> points,
                                      const HullOptions& options = {});

}  // namespace touchstone::exact

#endif  // TOUCHSTONE_EXACT_CONVEX_HULL_H_
