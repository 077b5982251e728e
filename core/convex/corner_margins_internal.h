// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_CONVEX_CORNER_MARGINS_INTERNAL_H_
#define TOUCHSTONE_CORE_CONVEX_CORNER_MARGINS_INTERNAL_H_

#include <vector>

#include "touchstone/core/convex/convex_polyhedron_data.h"

namespace touchstone::internal {

// For each corner v a lower bound of the margin of its cone of edges: delta with
// g.(w - v) >= delta |w - v| for a unit axis g and every neighbour w. Zero for other vertices, and
// where no margin could be proven.
//
// What it is for: if n.(w - v) <= eps |w - v| for every neighbour, then n.(x - v) <= eps D / delta
// for every x in the body, D its diameter. The body lies in the cone: x - v = sum l_i (w_i - v),
// l_i >= 0, so delta sum l_i |w_i - v| <= g.(x - v) <= D, and n.(x - v) <= eps sum l_i |w_i - v|.
//
// The axis is the inward sum of the normals of the faces at v. (The mean of the edges' directions
// fails at corners where many edges crowd on one side.)
std::vector<double> CornerMargins(const ConvexPolyhedronData& data);

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_CONVEX_CORNER_MARGINS_INTERNAL_H_
