// SPDX-License-Identifier: MIT
//
// What the subcommands that ask one question of two convex bodies share.
#ifndef TOUCHSTONE_TOOLS_TOUCHSTONE_BODY_ARGUMENTS_H_
#define TOUCHSTONE_TOOLS_TOUCHSTONE_BODY_ARGUMENTS_H_

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "touchstone/tools/judged_query.h"
#include "touchstone/tools/result_json.h"
#include "touchstone/tools/suites/suite.h"

namespace touchstone {

struct BodyArguments {
  std::string p, q;
  std::vector<std::string> pose;
  std::string certainty = "exact";
  bool judge = false, hull = false, json = false;
};

// P, Q, --pose, --certainty, --judge, --hull, --json.
void AddBodyArguments(CLI::App* command, BodyArguments* arguments);
// Throws BadInput for files or poses that will not do.
PlacedPair LoadPair(const BodyArguments& arguments);

// The bodies as the beginning of the answer.
Json DescribeBodies(const BodyArguments& arguments, const PlacedPair& pair);
void PrintBodies(std::ostream& out, const BodyArguments& arguments, const PlacedPair& pair);
// What the judge found, one line a finding.
void PrintFindings(std::ostream& out, const std::vector<NamedFinding>& findings, bool constructed);
void PrintTimes(std::ostream& out, double query_ns, bool judged, double judge_ns);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_TOUCHSTONE_BODY_ARGUMENTS_H_
