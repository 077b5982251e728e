// SPDX-License-Identifier: MIT
#include <iostream>
#include <memory>

#include "touchstone/exact/decide.h"
#include "touchstone/tools/campaign/shrink.h"
#include "touchstone/tools/case_file.h"
#include "touchstone/tools/judged_query.h"
#include "touchstone/tools/result_json.h"
#include "touchstone/tools/touchstone/subcommands.h"

namespace touchstone {
namespace {

struct Arguments {
  std::string path;
  std::string search;  // empty: the case's
  bool trace = false, json = false;
};

// A case of a campaign: asks its engine, in a process of its own, and judges.
int ReplayEngine(const Arguments& arguments, const CaseFile& query) {
  constexpr double kPatience = 20.0;
  const std::vector<NamedFinding> findings = AskApart(query.engine, query.pair, kPatience);
  const Verdict truth = exact::Decide(query.pair.p, query.pair.q, query.pair.pose).verdict;
  if (arguments.json) {
    const Json json = {{"case", arguments.path},
                       {"suite", query.suite},
                       {"seed", query.seed},
                       {"index", query.index},
                       {"engine", query.engine},
                       {"truth", ToString(truth)},
                       {"recorded_finding", query.finding},
                       {"findings", ToJson(findings)}};
    std::cout << json.dump(2) << '\n';
  } else {
    std::cout << "case             " << query.suite << ", seed " << query.seed << ", index "
              << query.index << '\n'
              << "bodies           " << query.pair.p.vertex_count() << " and "
              << query.pair.q.vertex_count() << " vertices\n"
              << "engine           " << query.engine << '\n'
              << "truth            " << ToString(truth) << '\n'
              << "recorded         " << query.finding << ' ' << query.detail << '\n';
    for (const NamedFinding& finding : findings)
      std::cout << "finding          " << finding.kind << ": " << finding.detail << '\n';
    if (findings.empty()) std::cout << "finding          none\n";
  }
  return findings.empty() ? kFine : kFindings;
}

int RunReplay(const Arguments& arguments) {
  const Loaded<CaseFile> loaded = ReadCase(arguments.path);
  if (!loaded.ok()) throw BadInput{loaded.error()};
  const CaseFile& query = *loaded;
  if (!query.engine.empty() && arguments.search.empty()) return ReplayEngine(arguments, query);
  const CollideOptions options{
      .search = arguments.search.empty() ? query.search : ParseSearch(arguments.search),
      .certainty = query.certainty,
      .early_exit = query.early_exit,
      .trace = arguments.trace};
  ExactBodies bodies;
  const JudgedQuery judged = AskAndJudge(query.pair, options, DepthForOneQuery(query.pair), bodies);
  if (arguments.json) {
    Json json = {{"case", arguments.path},
                 {"suite", query.suite},
                 {"seed", query.seed},
                 {"index", query.index},
                 {"search", ToString(options.search)},
                 {"recorded_finding", query.finding},
                 {"findings", ToJson(judged.findings)},
                 {"rounding_findings", ToJson(judged.rounding_findings)},
                 {"result", ToJson(judged.result)}};
    std::cout << json.dump(2) << '\n';
  } else {
    std::cout << "case             " << query.suite << ", seed " << query.seed << ", index "
              << query.index << '\n'
              << "bodies           " << query.pair.p.vertex_count() << " and "
              << query.pair.q.vertex_count() << " vertices\n"
              << "search           " << ToString(options.search) << ", "
              << ToString(options.certainty) << (options.early_exit ? ", early exit" : "") << '\n';
    PrintResult(std::cout, judged.result);
    std::cout << "recorded         " << query.finding << ' ' << query.detail << '\n';
    for (const NamedFinding& finding : judged.findings)
      std::cout << "finding          " << finding.kind << ": " << finding.detail << '\n';
    for (const NamedFinding& finding : judged.rounding_findings) {
      std::cout << "in doubles only  " << finding.kind << ": " << finding.detail << '\n';
    }
    if (judged.findings.empty()) std::cout << "finding          none\n";
  }
  return judged.findings.empty() ? kFine : kFindings;
}

}  // namespace

void AddReplay(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("replay", "Run and judge the query in a case file again");
  const auto arguments = std::make_shared<Arguments>();
  command->add_option("CASE", arguments->path, "a case file that verify or fuzz wrote")->required();
  command->add_option("--search", arguments->search,
                      "published, phased or portal, instead of the case's");
  command->add_flag("--trace", arguments->trace, "print the faces visited, by phase");
  command->add_flag("--json", arguments->json, "print JSON");
  command->callback([arguments, &exit_code] { exit_code = RunReplay(*arguments); });
}

}  // namespace touchstone
