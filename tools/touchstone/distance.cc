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

void AddDistance(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand(
      "distance",
      "How far apart are two convex bodies? Prints distance, closest points and features");
  const auto arguments = std::make_shared<Arguments>();
  AddBodyArguments(command, arguments.get());
  command->callback([arguments, &exit_code] { exit_code = RunDistance(*arguments); });
}

}  // namespace touchstone
