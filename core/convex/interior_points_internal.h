// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_CONVEX_INTERIOR_POINTS_INTERNAL_H_
#define TOUCHSTONE_CORE_CONVEX_INTERIOR_POINTS_INTERNAL_H_

#include "touchstone/core/base/orientation.h"
#include "touchstone/core/base/status.h"
#include "touchstone/core/convex/convex_polyhedron_data.h"

namespace touchstone::internal {

// Whether `point` lies strictly below the planes of all faces, by exact signs. Complexity: O(n).
bool IsStrictlyInside(const Orientation& orientation, const ConvexPolyhedronData& data,
                      const Eigen::Vector3d& point);

// Fills the two interior points: near the mean of the vertices, and farther off it; both off the
// planes of symmetry that bodies have. Where rounding spoils these, doubles near them and near
// other means. Returns kNotConvex where a vertex beyond a face is why a candidate is not inside,
// and kNoInteriorPoint where no candidate was proven inside. Complexity: O(n) per candidate, and
// one candidate each is enough for all but the thinnest bodies.
Status FindInteriorPoints(const Orientation& orientation, ConvexPolyhedronData* data);

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_CONVEX_INTERIOR_POINTS_INTERNAL_H_
