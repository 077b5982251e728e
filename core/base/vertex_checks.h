// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_BASE_VERTEX_CHECKS_H_
#define TOUCHSTONE_CORE_BASE_VERTEX_CHECKS_H_

#include <Eigen/Core>
#include <span>

#include "touchstone/core/base/status.h"

namespace touchstone {

// What every builder asks of vertices. kNonFinite and kOutOfRange name the vertex (all coordinates
// below 1e-100: none), kTooFewVertices: fewer than four. Complexity: O(n).
Status CheckVertices(std::span<const Eigen::Vector3d> vertices);

// kDuplicateVertex names two vertices with equal coordinates. Complexity: O(n log n).
Status CheckDistinct(std::span<const Eigen::Vector3d> vertices);

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_BASE_VERTEX_CHECKS_H_
