// SPDX-License-Identifier: MIT
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "touchstone/tools/judged_proximity.h"
#include "touchstone/tools/numbers.h"
#include "touchstone/tools/proximity_json.h"
#include "touchstone/tools/touchstone/body_arguments.h"
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
    Json json = DescribeBodies(arguments, pair);
    json["certainty"] = arguments.certainty;
    json.update(ToJson(query.result));
    json["query_ns"] = query.query_ns;
    if (arguments.judge) {
      json["judge"] = {{"findings", ToJson(query.findings)},
                       {"constructed", depth.construct},
                       {"judge_ns", query.judge_ns}};
    }
    std::cout << json.dump(2) << '\n';
  } else {
    PrintBodies(std::cout, arguments, pair);
    PrintResult(std::cout, query.result);
    if (arguments.judge) PrintFindings(std::cout, query.findings, depth.construct);
    PrintTimes(std::cout, query.query_ns, arguments.judge, query.judge_ns);
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
