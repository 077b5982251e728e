// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef TOUCHSTONE_EXACT_JUDGE_H_
#define TOUCHSTONE_EXACT_JUDGE_H_

#include <string>
#include <string_view>
#include <vector>

#include "touchstone/core/base/relative_pose.h"
#include "touchstone/core/cd_dual/result.h"
#include "touchstone/exact/exact_body.h"

namespace touchstone::exact {

enum class FindingKind {
  kWrongVerdict,      // not the exact verdict
  kUndecided,         // no verdict, where one was due
  kBadCertificate,    // does not prove the verdict it comes with
  kNotAFace,          // the exit face is no facet of M, or the ray misses the triangle given
  kWrongClass,        // the facet's features are not of the class, or not the features, named
  kValueOutOfBounds,  // d, g, c or the exit point is further from the truth than claimed
  kLooseBound,        // the claimed error or condition is larger than it may be (judge/values.h)
  kNotOptimal,        // a facet of M, but not the one the ray leaves by
  kPhaseNotMaximal,   // a phase's result is not what it claims of its class
  kBadCounters,       // counts, trace, phase, tier and termination contradict each other
  kUnentitledExit,    // stopped early without leave or without proof
  kMissingPart,       // a part that the result owes is absent
};
inline constexpr int kFindingKindCount = 12;

// snake_case: "wrong_verdict", ...
std::string_view ToString(FindingKind kind);

struct Finding {
  FindingKind kind;
  std::string detail;  // one line
};

// How the result was asked for, and how far to look.
struct JudgeOptions {
  Search search = Search::kPortal;
  Certainty certainty = Certainty::kExact;
  bool early_exit = false;
  // Hold each phase's report against the exact maximum of its class: O(mn).
  bool check_phase_maxima = true;
  // Also build M whole, by exact hull, and compare: for small bodies.
  bool construct = false;
};

// Returns everything that is wrong with `result` as the answer to "do P and Q meet?", Q placed by
// `pose`; empty when the result stands. Every statement is checked by exact signs; doubles only
// decide what an error bound lets them decide.
//
// kPublished is held to what the paper claims of it: its verdict, its face as the maximum over
// F(M), and all three phases as maxima; but it owes no certificate, and "overlap" includes touch,
// as in the paper's definition 1. Complexity: O(m + n), with the phase maxima O(mn).
std::vector<Finding> Judge(const ExactBody& p, const ExactBody& q, const RelativePose& pose,
                           const CollideResult& result, const JudgeOptions& options = {});

}  // namespace touchstone::exact

#endif  // TOUCHSTONE_EXACT_JUDGE_H_
