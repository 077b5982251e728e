// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_CONVEX_SUPPORT_H_
#define TOUCHSTONE_CORE_CONVEX_SUPPORT_H_

#include <Eigen/Core>

#include "touchstone/core/convex/convex_polyhedron.h"

namespace touchstone {

// Returns a vertex of `body` that is extreme along `direction` (body frame, any length but zero),
// found in doubles by the fastest method for the body's size: up to rounding, no vertex has a
// larger dot product. `start` is a vertex to begin a climb from; -1 lets the body choose.
// `climb_steps`, when given, is increased by the number of moves made.
//
// The answer is a proposal: a proof is made where a verdict rests on it (cd_dual/certify.h).
// It is always a corner of the body, never a vertex inside an edge or a facet. Any direction is
// safe: one that is zero or not finite gives some vertex. Complexity: O(n) at worst; near-constant
// from the direction table.
int SupportVertex(const ConvexPolyhedron& body, const Eigen::Vector3d& direction, int start = -1,
                  int* climb_steps = nullptr);

// The same by looking at every vertex: the twin that SupportVertex is tested against. Ties go to
// the smallest index.
int SupportVertexByScan(const ConvexPolyhedron& body, const Eigen::Vector3d& direction);

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_CONVEX_SUPPORT_H_
