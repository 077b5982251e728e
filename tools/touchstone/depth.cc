// SPDX-License-Identifier: MIT
#include <iostream>
#include <memory>

#include "touchstone/tools/touchstone/proximity_output.h"
#include "touchstone/tools/touchstone/subcommands.h"

namespace touchstone {
namespace {

struct Arguments : BodyArguments {
  bool certificate = false;
};

int RunDepth(const Arguments& arguments) {
  const PlacedPair pair = LoadPair(arguments);
  const PenetrationOptions options{.certainty = ParseCertainty(arguments.certainty),
                                   .certificate = arguments.certificate};
  const auto depth = ProximityDepthForOneQuery(pair, options.certainty);
  ExactBodies bodies;
  PenetrationCache memory;
  // Once to warm the caches, so that the time shown is the search's.
  AskPenetration(pair, options, std::nullopt, bodies, &memory);
  memory.Clear();
  const auto query = AskPenetration(
      pair, options, arguments.judge ? ProximityDepth(depth) : std::nullopt, bodies, &memory);
  if (arguments.json) {
    std::cout << DescribeQuery(arguments, pair, depth, query).dump(2) << '\n';
  } else {
    PrintQuery(arguments, pair, depth, query);
  }
  return query.findings.empty() ? kFine : kFindings;
}

}  // namespace

void AddDepth(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand(
      "depth",
      "How deep are two convex bodies in each other? Prints the least translation that parts them");
  const auto arguments = std::make_shared<Arguments>();
  AddBodyArguments(command, arguments.get());
  command->add_flag("--certificate", arguments->certificate,
                    "with the polytope that proves the lower bound");
  command->callback([arguments, &exit_code] { exit_code = RunDepth(*arguments); });
}

}  // namespace touchstone
