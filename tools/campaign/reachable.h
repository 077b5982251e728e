// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_CAMPAIGN_REACHABLE_H_
#define TOUCHSTONE_TOOLS_CAMPAIGN_REACHABLE_H_

#include <span>
#include <string>
#include <string_view>

namespace touchstone {

// The combinations of face class, deciding phase, verdict, termination and tier that a search of
// ours can end in, when it is asked as campaigns ask (cold; an early exit now and then), each as
// the words of core/cd_dual/result.h, class first, with blanks between. Empty for other engines.
// One that is met and not listed is reported, so that the list stays true.
std::span<const std::string_view> ReachableCombinations(const std::string& engine);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_CAMPAIGN_REACHABLE_H_
