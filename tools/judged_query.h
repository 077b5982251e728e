// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_JUDGED_QUERY_H_
#define TOUCHSTONE_TOOLS_JUDGED_QUERY_H_

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "touchstone/core/cd_dual/cd_dual.h"
#include "touchstone/exact/judge.h"
#include "touchstone/tools/suites/suite.h"

namespace touchstone {

// A finding of the judge, or of the tools: "unexpected_verdict" when a suite is certain of another.
struct NamedFinding {
  std::string kind;
  std::string detail;
};

// How far to look at one result.
struct JudgeDepth {
  bool phase_maxima = true;  // each phase against the exact maximum of its class: O(mn)
  bool construct = false;    // M built whole, too: small bodies only
  bool twin = true;          // kPublished: replay the pseudocode exactly, even where nothing failed
  bool warm = true;          // kPortal: ask again with the cache of a frame before, and judge that
};

// Everything, and M built whole where one can wait for it: a product of vertex counts up to 4000.
JudgeDepth DepthForOneQuery(const PlacedPair& pair);

// One query, asked of the core and judged by the exact half.
struct JudgedQuery {
  CollideResult result;
  double search_ns = 0.0;
  double judge_ns = 0.0;
  // kPublished: what the exact replay of the paper's pseudocode gets wrong. Else: what the judge
  // found.
  std::vector<NamedFinding> findings;
  // kPublished: what the judge found in the core's run and the exact replay does not share; an
  // effect of rounding, which the paper is not blamed for.
  std::vector<NamedFinding> rounding_findings;
  bool twin_ran = false;
};

// The exact half's view of the bodies of recent queries, so that consecutive queries with the same
// bodies share what was computed. One per thread.
class ExactBodies {
 public:
  exact::ExactBody Get(const ConvexPolyhedron& body);

 private:
  std::array<std::optional<exact::ExactBody>, 8> recent_;
  std::size_t next_ = 0;
};

// Runs the query without judging it.
JudgedQuery Ask(const PlacedPair& pair, const CollideOptions& options);
// Runs and judges it.
JudgedQuery AskAndJudge(const PlacedPair& pair, const CollideOptions& options,
                        const JudgeDepth& depth, ExactBodies& bodies);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_JUDGED_QUERY_H_
