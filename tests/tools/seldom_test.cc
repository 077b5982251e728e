// SPDX-License-Identifier: MIT
//
// The suite `seldom` and the list of reachable combinations, held against each other.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "touchstone/core/cd_dual/cd_dual.h"
#include "touchstone/tools/campaign/reachable.h"
#include "touchstone/tools/suites/registry.h"
#include "touchstone/tools/suites/seldom_cases.h"

namespace touchstone {
namespace {

std::string CombinationOf(const CollideResult& result) {
  std::string words = result.face ? std::string(ToString(result.face->face_class)) : "none";
  for (const std::string_view word : {ToString(result.phase), ToString(result.verdict),
                                      ToString(result.termination), ToString(result.tier)})
    words += ' ' + std::string(word);
  return words;
}

// Every case at two scales, as it stands and moved, with and without an early exit.
std::map<std::string, int> Tally(const Suite& suite, Search search) {
  std::map<std::string, int> tally;
  const std::size_t blocks = 2 * SeldomCases().size();
  for (std::size_t block = 0; block < blocks; ++block) {
    for (const std::uint64_t index : {80 * block, 80 * block + 1}) {
      const PlacedPair pair = suite.Generate(1, index);
      for (const bool early_exit : {false, true}) {
        ++tally[CombinationOf(
            Collide(pair.p, pair.q, pair.pose, {.search = search, .early_exit = early_exit}))];
      }
    }
  }
  return tally;
}

TEST(Seldom, ReachesEveryListedCombinationAndNoOther) {
  const auto suites = MakeSuites("");
  const auto seldom = std::find_if(suites.begin(), suites.end(),
                                   [](const auto& suite) { return suite->name() == "seldom"; });
  ASSERT_NE(seldom, suites.end());
  for (const std::string engine : {"portal", "phased"}) {
    const Search search = engine == "portal" ? Search::kPortal : Search::kPhased;
    std::map<std::string, int> tally = Tally(**seldom, search);
    const std::vector<std::string>& listed = ReachableCombinations(engine);
    EXPECT_EQ(listed.size(), engine == "portal" ? 48u : 135u);
    for (const std::string& combination : listed) {
      // As it stands at both scales.
      EXPECT_GE(tally[combination], 2) << engine << ": " << combination;
      tally.erase(combination);
    }
    for (const auto& [combination, count] : tally)
      ADD_FAILURE() << engine << ": not listed: " << combination;
  }
  EXPECT_TRUE(ReachableCombinations("published").empty());
}

}  // namespace
}  // namespace touchstone
