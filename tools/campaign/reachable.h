// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_CAMPAIGN_REACHABLE_H_
#define TOUCHSTONE_TOOLS_CAMPAIGN_REACHABLE_H_

#include <string>
#include <vector>

namespace touchstone {

// The combinations of face class, deciding phase, verdict, termination and tier that a search of
// ours can end in, when it is asked as campaigns ask (cold; an early exit now and then), each as
// the words of core/cd_dual/result.h, class first, with blanks between. By rules that say why the
// others cannot occur; one that does is reported, and fails a run that asks for coverage. Empty for
// other engines.
const std::vector<std::string>& ReachableCombinations(const std::string& engine);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_CAMPAIGN_REACHABLE_H_
