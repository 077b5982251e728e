// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_SUITES_REPORTED_CASES_H_
#define TOUCHSTONE_TOOLS_SUITES_REPORTED_CASES_H_

#include <Eigen/Core>
#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "touchstone/core/cd_dual/result.h"

namespace touchstone {

// A placement that users of a collision library reported as answered wrong.
struct ReportedCase {
  std::string_view name;
  std::string_view source;                // where it was reported
  std::string_view note;                  // what went wrong there
  Verdict verdict;                        // of the exact bodies
  std::vector<Eigen::Vector3d> p, q;      // the bodies are the hulls of these points
  std::array<double, 12> p_pose, q_pose;  // in the world: rows of [R | t]
};

std::span<const ReportedCase> ReportedCases();

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_SUITES_REPORTED_CASES_H_
