// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_SUITES_ELLIPSOID_H_
#define TOUCHSTONE_TOOLS_SUITES_ELLIPSOID_H_

#include <memory>
#include <span>

#include "touchstone/tools/suites/suite.h"

namespace touchstone {

// Hulls of random points on ellipsoids 100 aspect : 100 : 100, the paper's bodies (section 5), one
// suite an aspect. `aspects` and `counts` are drawn from; `name` and `summary` must be literals.
std::unique_ptr<Suite> MakeEllipsoidSuite(std::string_view name, std::string_view summary,
                                          std::span<const double> aspects,
                                          std::span<const int> counts);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_SUITES_ELLIPSOID_H_
