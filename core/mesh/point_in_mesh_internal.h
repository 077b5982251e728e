// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_MESH_POINT_IN_MESH_INTERNAL_H_
#define TOUCHSTONE_CORE_MESH_POINT_IN_MESH_INTERNAL_H_

#include <Eigen/Core>
#include <functional>
#include <optional>

#include "touchstone/core/base/dyadic.h"
#include "touchstone/core/mesh/mesh_pair.h"

namespace touchstone::internal {

// Whether a point lies inside the solid, by the parity of a ray: along each of the six axis
// directions in turn until doubles can tell; nothing if they never can. The difference of the
// point and a point of the mesh, formed in doubles, is off by at most `error` in each coordinate.
// An answer is proof that the point is not on the surface. Complexity: O(sqrt n) on round bodies.
std::optional<bool> TriageInside(const PlacedMesh& mesh, const Eigen::Vector3d& point,
                                 double error);

// The same exactly; `difference(v)` is the mesh's point v minus the point in question, times a
// positive factor. Requires a point that is not on the surface; `point` and `error` as above.
bool IsInside(const PlacedMesh& mesh, const Eigen::Vector3d& point, double error,
              const std::function<DyadicVector(int)>& difference);

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_MESH_POINT_IN_MESH_INTERNAL_H_
