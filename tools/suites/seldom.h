// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_SUITES_SELDOM_H_
#define TOUCHSTONE_TOOLS_SUITES_SELDOM_H_

#include <memory>
#include <vector>

#include "touchstone/tools/suites/suite.h"

namespace touchstone {

// Cases of other suites (seldom_cases.h), which it holds.
std::unique_ptr<Suite> MakeSeldomSuite(std::vector<std::unique_ptr<Suite>> others);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_SUITES_SELDOM_H_
