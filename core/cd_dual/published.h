// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_CD_DUAL_PUBLISHED_H_
#define TOUCHSTONE_CORE_CD_DUAL_PUBLISHED_H_

#include "touchstone/core/cd_dual/face_of_m.h"

namespace touchstone {

// The outcome of CD-DUALITY as printed: the face with the largest signed distance met, the phase
// that met it, and the best face of each phase.
struct PublishedOutcome {
  FaceOfM face;
  Phase phase;
  bool stopped_early = false;
  std::array<std::optional<FaceOfM>, 3> best;
  std::array<bool, 3> ran{};
};

// PROCEDURE CD-DUALITY to the letter, in doubles: heuristic first face, SEARCH-FV, SEARCH-VF from
// the first face (by index) incident at the vertex of Q that SEARCH-FV ended with, SEARCH-EE from
// the better of the two. Separate iff the distance is positive. Wrong at times, for Theorem 1
// fails: it exists to be judged.
PublishedOutcome SearchPublished(const MinkowskiDifference& m, bool early_exit, SearchLog* log);

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_CD_DUAL_PUBLISHED_H_
