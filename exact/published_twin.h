// SPDX-License-Identifier: GPL-3.0-or-later
//
// The paper's pseudocode (Choi, Li, Wang, Cameron, section 3.3), replayed in exact arithmetic: what
// it answers, it answers because of what is printed and not because of rounding.
//
// What the paper leaves open is fixed here, and the core's kPublished follows the same conventions:
//
//   c            interior_point(i) of P minus the placed interior_point(j) of Q, as given.
//   first face   the face of P whose unit normal n has the largest n.s, s = -c (section 4.2), in
//                P's frame; ties go to the smallest face index.
//   support      the supporting vertex of Q-bar along the normal of a face of P is the vertex of Q
//                that is extreme along the opposite direction; ties go to the smallest vertex
//                index. Likewise for P in SEARCH-VF.
//   neighbours   of a face: the faces across its edges, in loop order (edge k joins loop[k] to
//                loop[k + 1]). All are evaluated; the first of the best is moved to, if strictly
//                better than the current face.
//   SEARCH-VF    starts from the face of smallest index among those incident, in Q, at the vertex
//                of the face that SEARCH-FV found. Its d_m starts afresh, from that face.
//   SEARCH-EE    starts from the better of the two faces found; on a tie, from SEARCH-FV's.
//   edges        are numbered as ExactBody numbers them; tail and head as there.
//   first push   for F(f_p, v_q): outer loop over the edges of f_p in loop order, inner loop over
//                the edges incident at v_q by increasing number; for F(v_p, f_q): outer loop over
//                the edges incident at v_p by increasing number, inner loop over the edges of f_q
//                in loop order. The stack is last in, first out; nothing is marked as visited.
//   later push   for an improving <e_p, e_q>: first <e_p, e'> for the edges e' incident at the tail
//                of e_q, then at its head, by increasing number, then <e', e_q> in the same manner;
//                the pair <e_p, e_q> itself is not pushed again.
//   arc test     section 4.3 with the strict inequalities as printed; a, b are the normals of the
//                faces left and right of e_p (the loop of the left face runs from tail to head),
//                c, d those of Q-bar for e_q.
//   visited      faces are the signed distances evaluated: pairs that fail the arc test are none.
//   early exit   as soon as a face with d > 0 is the best so far (the rest of the pseudocode could
//                not change the verdict). Off: the tests for d_m > 0 are left out.
#ifndef TOUCHSTONE_EXACT_PUBLISHED_TWIN_H_
#define TOUCHSTONE_EXACT_PUBLISHED_TWIN_H_

#include <gmpxx.h>

#include <array>
#include <optional>
#include <vector>

#include "touchstone/core/base/relative_pose.h"
#include "touchstone/core/cd_dual/result.h"
#include "touchstone/exact/exact_body.h"
#include "touchstone/exact/judge.h"

namespace touchstone::exact {

struct TwinOptions {
  bool early_exit = false;
  bool trace = false;
};

struct TwinResult {
  // As the core's kPublished fills it: verdict kSeparate or kOverlap ("overlap" includes touch),
  // tier kNone, phases, counts, face and, on request, trace. Doubles are the exact values, rounded.
  CollideResult result;
  // 1 + d |c| = 1/s, exact: of each phase's best face and of the final one.
  std::array<std::optional<mpq_class>, 3> phase_ratio;
  mpq_class ratio;
  std::vector<mpq_class> trace_ratio;  // in step with result.trace
};

// Runs CD-DUALITY exactly. Requires c != o and interior points that are interior.
TwinResult RunPublishedTwin(const ExactBody& p, const ExactBody& q, const RelativePose& pose,
                            int interior_p = 0, int interior_q = 0,
                            const TwinOptions& options = {});

// What the paper claims of the run and what does not hold: kWrongVerdict, kPhaseNotMaximal
// (theorems 1 and 2, and 6 for the third phase), kNotOptimal (theorem 6). With early exit only the
// verdict.
std::vector<Finding> JudgeTwin(const ExactBody& p, const ExactBody& q, const RelativePose& pose,
                               const TwinResult& twin, const TwinOptions& options = {});

}  // namespace touchstone::exact

#endif  // TOUCHSTONE_EXACT_PUBLISHED_TWIN_H_
