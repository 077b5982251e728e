// SPDX-License-Identifier: MIT
#include <array>
#include <iostream>
#include <memory>
#include <vector>

#include "touchstone/tools/judged_query.h"
#include "touchstone/tools/result_json.h"
#include "touchstone/tools/touchstone/body_arguments.h"
#include "touchstone/tools/touchstone/subcommands.h"

namespace touchstone {
namespace {

struct Arguments : BodyArguments {
  std::string search = "portal";
  bool early_exit = false, common_point = false, trace = false;
};

void PrintJudgement(const Arguments& arguments, const JudgedQuery& query, bool constructed) {
  if (!arguments.judge) return;
  PrintFindings(std::cout, query.findings, constructed);
  for (const NamedFinding& finding : query.rounding_findings) {
    std::cout << "judge            in doubles only: " << finding.kind << ": " << finding.detail
              << '\n';
  }
}

int RunCollide(const Arguments& arguments) {
  const PlacedPair pair = LoadPair(arguments);
  const CollideOptions options{.search = ParseSearch(arguments.search),
                               .certainty = ParseCertainty(arguments.certainty),
                               .early_exit = arguments.early_exit,
                               .common_point = arguments.common_point,
                               .trace = arguments.trace};
  const JudgeDepth depth = DepthForOneQuery(pair);
  ExactBodies bodies;
  JudgedQuery query =
      Ask(pair, options);  // warms the caches, so that the time shown is the search's
  query = arguments.judge ? AskAndJudge(pair, options, depth, bodies) : Ask(pair, options);

  if (arguments.json) {
    Json json = DescribeBodies(arguments, pair);
    json["search"] = arguments.search;
    json["certainty"] = arguments.certainty;
    json["early_exit"] = arguments.early_exit;
    json.update(ToJson(query.result));
    json["search_ns"] = query.search_ns;
    if (arguments.judge) {
      json["judge"] = {{"findings", ToJson(query.findings)},
                       {"rounding_findings", ToJson(query.rounding_findings)},
                       {"constructed", depth.construct},
                       {"judge_ns", query.judge_ns}};
    }
    std::cout << json.dump(2) << '\n';
  } else {
    PrintBodies(std::cout, arguments, pair);
    std::cout << "search           " << arguments.search << ", " << arguments.certainty << '\n';
    PrintResult(std::cout, query.result);
    PrintJudgement(arguments, query, depth.construct);
    PrintTimes(std::cout, query.search_ns, arguments.judge, query.judge_ns);
  }
  return query.findings.empty() ? kFine : kFindings;
}

}  // namespace

void AddCollide(CLI::App& app, int& exit_code) {
  CLI::App* command =
      app.add_subcommand("collide", "Do two convex bodies meet? Prints the verdict and its proof");
  const auto arguments = std::make_shared<Arguments>();
  AddBodyArguments(command, arguments.get());
  command->add_option("--search", arguments->search, "published, phased or portal")
      ->capture_default_str();
  command->add_flag("--common-point", arguments->common_point,
                    "Name a point of both bodies where they touch or overlap");
  command->add_flag("--early-exit", arguments->early_exit,
                    "stop as soon as the verdict is certain");
  command->add_flag("--trace", arguments->trace, "print the faces visited, by phase");
  command->callback([arguments, &exit_code] { exit_code = RunCollide(*arguments); });
}

}  // namespace touchstone
