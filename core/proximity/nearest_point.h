// SPDX-License-Identifier: MIT
//
// The distance search in doubles: which vertices of M span the point nearest to o.
#ifndef TOUCHSTONE_CORE_PROXIMITY_NEAREST_POINT_H_
#define TOUCHSTONE_CORE_PROXIMITY_NEAREST_POINT_H_

#include <array>

#include "touchstone/core/cd_dual/minkowski_difference.h"

namespace touchstone {

// One to three vertices of M.
struct Simplex {
  std::array<VertexPair, 3> points;
  int size = 0;
};

// What the search proposes. Nothing here is proven.
struct NearestProposal {
  enum class Kind {
    kNearest,  // o is nearest to the hull of `simplex`, and nothing of M lies nearer
    kMeets,    // o seems to be in M, or nearer than rounding can tell
  };
  Kind kind = Kind::kMeets;
  Simplex simplex;  // the last one seen
};

// Gilbert, Johnson and Keerthi's search: keeps a simplex of vertices of M and its point x nearest
// to o, asks for the support along -x, and takes the new vertex in, until it brings nothing nearer.
// `start` is where to begin: the simplex of a similar query, or none (size 0).
//
// Ends when rounding sees no progress: each round brings x strictly nearer, else it is the last,
// and after kMaxRounds in any case. Complexity: five to ten support pairs from nothing, one or two
// from a good start.
NearestProposal SearchNearest(const MinkowskiDifference& m, const Simplex& start,
                              PhaseCounts* counts);

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_PROXIMITY_NEAREST_POINT_H_
