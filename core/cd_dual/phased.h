// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_CD_DUAL_PHASED_H_
#define TOUCHSTONE_CORE_CD_DUAL_PHASED_H_

#include "touchstone/core/cd_dual/face_of_m.h"
#include "touchstone/core/cd_dual/portal.h"

namespace touchstone {

struct PhasedOutcome {
  Proposal proposal;
  Phase phase = Phase::kFaceVertex;  // that found the face proposed
  std::array<std::optional<FaceOfM>, 3> best;
  std::array<bool, 3> ran{};
};

// kPhased: the three phases of the paper, made correct. A phase may stop at a local maximum; what
// tells is whether the ray from c through o crosses the face found, which is the certificate of
// optimality. While it does not, the search turns the face's plane about the polygon's edge that
// the ray passes outside of, until the plane supports M again: that neighbouring face has a
// strictly larger signed distance, for the old crossing point lies strictly beyond it. From there
// the phases take over again.
//
// Starts from the face of P around its support along the ray instead of the paper's scan over all
// faces. Proposes; a proof is made elsewhere. Terminates: every move strictly increases the signed
// distance over finitely many faces; where rounding hides the increase it stops and says so (kStuck
// or a face to be proven).
PhasedOutcome SearchPhased(const MinkowskiDifference& m, bool early_exit, SearchLog* log);

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_CD_DUAL_PHASED_H_
