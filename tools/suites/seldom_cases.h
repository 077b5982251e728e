// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_SUITES_SELDOM_CASES_H_
#define TOUCHSTONE_TOOLS_SUITES_SELDOM_CASES_H_

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <string_view>

namespace touchstone {

// A query of another suite, of seed 1, and what is added to its translation: along the ray, mostly,
// so that the search takes the same path and the verdict is another.
struct SeldomCase {
  std::string_view suite;
  std::uint64_t index;
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
};

// Together they end in every combination that campaign/reachable.h lists, asked with and without an
// early exit (tests/tools/seldom_test.cc; where a search has changed, that test says what is
// missing).
std::span<const SeldomCase> SeldomCases();

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_SUITES_SELDOM_CASES_H_
