// SPDX-License-Identifier: MIT
#include <iostream>
#include <memory>

#include "touchstone/tools/touchstone/proximity_output.h"
#include "touchstone/tools/touchstone/subcommands.h"

namespace touchstone {
namespace {

using Arguments = BodyArguments;

int RunDistance(const Arguments& arguments) {
  const PlacedPair pair = LoadPair(arguments);
  const Certainty certainty = ParseCertainty(arguments.certainty);
  const auto depth = ProximityDepthForOneQuery(pair, certainty);
  ExactBodies bodies;
  // Once to warm the caches, so that the time shown is the search's.
  AskDistance(pair, certainty, std::nullopt, bodies);
  const auto query =
      AskDistance(pair, certainty, arguments.judge ? ProximityDepth(depth) : std::nullopt, bodies);
  if (arguments.json) {
    std::cout << DescribeQuery(arguments, pair, depth, query).dump(2) << '\n';
  } else {
    PrintQuery(arguments, pair, depth, query);
  }
  return query.findings.empty() ? kFine : kFindings;
}

}  // namespace

void AddDistance(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand(
      "distance",
      "How far apart are two convex bodies? Prints distance, closest points and features");
  const auto arguments = std::make_shared<Arguments>();
  AddBodyArguments(command, arguments.get());
  command->callback([arguments, &exit_code] { exit_code = RunDistance(*arguments); });
}

}  // namespace touchstone
