// SPDX-License-Identifier: MIT
//
//   here        meaning
//   w_i         the simplex's vertices of M, one to three
//   x           the point of their hull nearest to o, = sum l_i w_i
//   x's normal  M lies on the far side of the plane through x with normal x: x is nearest in all M
#ifndef TOUCHSTONE_CORE_PROXIMITY_NEAREST_PROOF_H_
#define TOUCHSTONE_CORE_PROXIMITY_NEAREST_PROOF_H_

#include <optional>

#include "touchstone/core/cd_dual/signs.h"
#include "touchstone/core/proximity/nearest_point.h"

namespace touchstone {

struct NearestProof {
  // The simplex; three points run counterclockwise seen from o's side, which is outside M.
  Simplex simplex;
  Feature feature_p, feature_q;  // what supports P along -x and Q along x
};

// Proves that x is the point of M nearest to o, hence that the bodies are separate and how far, by
// signs alone (KKT): the l_i are not negative, and nothing of M lies on o's side of x's plane,
// which one corner's neighbours on each body tell. Nothing if it is not so or (kFloat) cannot be
// told.
std::optional<NearestProof> ProveNearest(Signs* signs, const Simplex& simplex);

// A positive multiple of x if all l_i are positive and x is not o; nothing otherwise. Exact.
// Degree in the coordinates: 1, 3, 2 for one, two, three points.
std::optional<DyadicVector> ExactNearest(const ExactDifference& big, const Simplex& simplex);

// The simplex that ProveNearest accepts, by exact signs, when the bodies are separate: what
// finishes a search that doubles could not. Starts from the vertices of `start`.
//
// Terminates: x comes strictly nearer with every vertex taken in, x is one point for a simplex, and
// there are finitely many. Complexity: a handful of rounds of exact support from a good start.
Simplex FindExactNearest(Signs* signs, const Simplex& start, PhaseCounts* counts);

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_PROXIMITY_NEAREST_PROOF_H_
