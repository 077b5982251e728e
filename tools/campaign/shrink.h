// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_CAMPAIGN_SHRINK_H_
#define TOUCHSTONE_TOOLS_CAMPAIGN_SHRINK_H_

#include <functional>
#include <optional>
#include <string>

#include "touchstone/tools/campaign/contestant.h"
#include "touchstone/tools/suites/suite.h"

namespace touchstone {

// Asks one contestant one query, in a process of its own, and judges it. Returns every finding,
// "crash" and "hang" (no answer in `hang_seconds`) among them. Requires a process without threads.
// Sampling is set aside: values and phase maxima are looked at, M is not built.
std::vector<NamedFinding> AskApart(const std::string& engine, const PlacedPair& pair,
                                   double hang_seconds);

struct ShrinkOptions {
  double seconds = 20.0;  // after which the best so far is returned
  double hang_seconds = 2.0;
};

// A simpler query with the same finding: of the same kind, by the same engine. Vertices are dropped
// and the hull taken anew; then R and t, then the coordinates, are rounded to fewer and fewer
// decimals, and numbers set to zero; and all of that again until nothing more is possible or the
// time is up. Nothing when the query does not have the finding. What a suite was certain of is
// dropped: the judge says what is true.
std::optional<PlacedPair> Shrink(const std::string& engine, const std::string& kind,
                                 const PlacedPair& pair, const ShrinkOptions& options);

// The same for any property of a query.
PlacedPair ShrinkWhile(const PlacedPair& pair, double seconds,
                       const std::function<bool(const PlacedPair&)>& holds);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_CAMPAIGN_SHRINK_H_
