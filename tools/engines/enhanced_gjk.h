// SPDX-License-Identifier: MIT
//
//   Cameron 1997        here            meaning
//   A, B                P, Q            the bodies; Q placed in P's frame
//   A - B               M               their Minkowski difference
//   V_k                 Simplex         at most four vertices of M
//   v                   nearest         the point of the simplex nearest to the origin
#ifndef TOUCHSTONE_TOOLS_ENGINES_ENHANCED_GJK_H_
#define TOUCHSTONE_TOOLS_ENGINES_ENHANCED_GJK_H_

#include <Eigen/Core>
#include <array>

#include "touchstone/core/base/relative_pose.h"
#include "touchstone/core/cd_dual/result.h"
#include "touchstone/core/convex/convex_polyhedron.h"

namespace touchstone {

// The vertex pairs of the last simplex, to begin the next frame with.
struct GjkSimplex {
  std::array<VertexPair, 4> pairs;
  int size = 0;
};

struct GjkOptions {
  // Relative: the search has converged when the distance can shrink by no more than this part of
  // the extent of M around the origin.
  double tolerance = 1e-12;
  // Go on to the nearest points where a separating direction would do for the verdict.
  bool want_distance = false;
};

struct GjkResult {
  Verdict verdict = Verdict::kUndecided;  // kSeparate, kOverlap, or kUndecided at the bound
  double distance = 0.0;                  // an upper bound, converged when `want_distance` was set
};

// The enhanced GJK that the paper compares itself with: support by hill climbing over the bodies'
// edges from the previous support vertex, and an end as soon as a direction separates. In plain
// doubles, without proofs. Touch is answered as overlap or separate, as rounding has it.
//
// `simplex`, when given, is where the search begins and what it leaves behind. Complexity: O(sqrt
// n) a climb at worst on round bodies, 5 to 20 rounds; ends after a fixed number of rounds. Source:
// S. Cameron, "Enhancing GJK: computing minimum and penetration distances between convex
// polyhedra", ICRA 1997; the point of a simplex nearest to the origin by regions after Ericson,
// "Real-Time Collision Detection", section 5.1.
GjkResult EnhancedGjk(const ConvexPolyhedron& p, const ConvexPolyhedron& q,
                      const RelativePose& pose, const GjkOptions& options,
                      GjkSimplex* simplex = nullptr);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_ENGINES_ENHANCED_GJK_H_
