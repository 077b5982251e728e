// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_CD_DUAL_STEEPEST_ASCENT_INTERNAL_H_
#define TOUCHSTONE_CORE_CD_DUAL_STEEPEST_ASCENT_INTERNAL_H_

#include <vector>

#include "touchstone/core/cd_dual/face_of_m.h"

namespace touchstone {

// The loop that SEARCH-FV and SEARCH-VF share: from `first`, move to the best of the faces of M
// that the adjacent faces of `shape` span, while it is better. `IndexOf(face)` is the face of
// `shape` that a face of M comes from; `Evaluate(f, from)` the face of M that face f spans.
template <class IndexOf, class Evaluate>
FaceOfM SteepestAscent(const ConvexPolyhedron& shape, const FaceOfM& first, Phase phase,
                       bool early_exit, SearchLog* log, IndexOf index_of, Evaluate evaluate) {
  FaceOfM best = first;
  log->Visit(phase, best, true);
  while (!(early_exit && best.signed_distance > 0.0)) {
    const int f = index_of(best);
    FaceOfM steepest = best;
    std::size_t steepest_step = 0;
    for (const int e : shape.face_edges(f)) {
      const FaceOfM next = evaluate(shape.face_across(e, f), best);
      log->Visit(phase, next, false);
      if (next.signed_distance > steepest.signed_distance) {
        steepest = next;
        if (log->trace) steepest_step = log->trace->size() - 1;
      }
    }
    if (!(steepest.signed_distance > best.signed_distance)) break;
    if (log->trace) (*log->trace)[steepest_step].accepted = true;
    best = steepest;
  }
  return best;
}

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_CD_DUAL_STEEPEST_ASCENT_INTERNAL_H_
