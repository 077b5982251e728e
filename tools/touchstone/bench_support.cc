// SPDX-License-Identifier: MIT
#include <fstream>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "touchstone/tools/bench/machine.h"
#include "touchstone/tools/bench/support_bench.h"
#include "touchstone/tools/result_json.h"
#include "touchstone/tools/table.h"
#include "touchstone/tools/touchstone/bench.h"
#include "touchstone/tools/touchstone/subcommands.h"

namespace touchstone {
namespace {

struct SupportArguments {
  bool quick = false, json = false;
  std::uint64_t seed = 1;
  std::string markdown;
};

std::vector<SupportBenchCase> MakeCases(bool quick) {
  std::vector<SupportBenchCase> cases = {
      {"ellipsoid-2", 20}, {"ellipsoid-2", 100}, {"ellipsoid-2", 1000}};
  if (quick) return cases;
  const std::vector<SupportBenchCase> more = {
      {"ellipsoid-2", 20000}, {"ellipsoid-10", 1000}, {"grid", 1000},
      {"grid", 20000},        {"prism", 20},          {"prism", 2000},
      {"slab", 2000},         {"bipyramid", 1000},    {"ellipsoid-2", 200000}};
  cases.insert(cases.end(), more.begin(), more.end());
  return cases;
}

Json ToJson(const std::vector<SupportBenchRow>& rows) {
  Json json = Json::array();
  for (const SupportBenchRow& row : rows) {
    json.push_back({{"shape", row.shape},
                    {"n", row.n},
                    {"method", row.method},
                    {"independent_ns", row.independent_ns},
                    {"dependent_ns", row.dependent_ns},
                    {"lower", row.lower}});
  }
  return json;
}

// A method a column: independent / dependent.
Table MakeTable(const std::vector<SupportBenchRow>& rows) {
  Table table;
  std::vector<std::string> head = {"body", "n"}, cells;
  std::string shape;
  int n = -1;
  for (const SupportBenchRow& row : rows) {
    if (row.shape == rows[0].shape && row.n == rows[0].n) head.push_back(row.method);
  }
  table.Row(head);
  for (const SupportBenchRow& row : rows) {
    if (row.shape != shape || row.n != n) {
      if (!cells.empty()) table.Row(cells);
      cells = {row.shape, std::to_string(row.n)};
      shape = row.shape;
      n = row.n;
    }
    std::string cell = Fixed(row.independent_ns, 0) + " / " + Fixed(row.dependent_ns, 0);
    if (row.lower > 0.0) cell += " (" + Fixed(100.0 * row.lower, 1) + " % lower)";
    cells.push_back(cell);
  }
  if (!cells.empty()) table.Row(cells);
  return table;
}

int RunSupportCommand(const SupportArguments& arguments) {
  SupportBenchOptions options;
  options.cases = MakeCases(arguments.quick);
  options.seed = arguments.seed;
  std::ofstream markdown;
  if (!arguments.markdown.empty()) {
    markdown.open(arguments.markdown + "/bench-support.md");
    if (!markdown) throw BadInput{"--markdown: " + arguments.markdown + " cannot be written"};
  }
  const std::vector<SupportBenchRow> rows = RunSupportBench(options);
  if (markdown.is_open()) MakeTable(rows).PrintMarkdown(markdown);
  if (arguments.json) {
    std::cout << ToJson(rows).dump(2) << '\n';
  } else {
    std::cout << "ns a query, directions independent / each waiting for the answer before\n\n";
    MakeTable(rows).Print(std::cout);
    std::cout << '\n' << ProcessorName() << ", vector code for " << VectorClonesInUse() << '\n';
  }
  return kFine;
}

}  // namespace

void AddBenchSupport(CLI::App& bench, int& exit_code) {
  CLI::App* command = bench.add_subcommand("support", "One support query by every method there is");
  const auto arguments = std::make_shared<SupportArguments>();
  command->add_flag("--quick", arguments->quick, "ellipsoids of 20, 100, 1000 points only");
  command->add_option("--seed", arguments->seed, "which bodies and directions")
      ->capture_default_str();
  command->add_option("--markdown", arguments->markdown,
                      "folder for the table as bench-support.md");
  command->add_flag("--json", arguments->json, "print JSON: an array of rows");
  command->callback([arguments, &exit_code] { exit_code = RunSupportCommand(*arguments); });
}

}  // namespace touchstone
