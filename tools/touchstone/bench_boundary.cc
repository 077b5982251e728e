// SPDX-License-Identifier: MIT
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "touchstone/tools/bench/boundary_bench.h"
#include "touchstone/tools/numbers.h"
#include "touchstone/tools/result_json.h"
#include "touchstone/tools/table.h"
#include "touchstone/tools/touchstone/bench.h"
#include "touchstone/tools/touchstone/subcommands.h"

namespace touchstone {
namespace {

struct BoundaryArguments {
  bool quick = false, json = false;
  std::uint64_t seed = 1;
  std::string markdown, svg, meshes;
};

struct Results {
  std::optional<double> peak_bytes;
  std::vector<BoundaryRow> scenes, growth;
  double exponent = 0.0;
  std::vector<NefRow> nef;
  std::vector<MembershipRow> membership;
};

Results Measure(const BoundaryArguments& arguments) {
  Results results;
  results.peak_bytes = PeakMemoryOfTori(2000);
  const BoundaryBenchOptions options{arguments.quick ? 3 : 9, arguments.seed};
  results.scenes = TimePaperScenes(options);
  const std::vector<int> sizes = arguments.quick
                                     ? std::vector<int>{250, 500, 1000, 2000}
                                     : std::vector<int>{250, 500, 1000, 2000, 4000, 8000};
  results.growth = TimeGrowth(sizes, options);
  results.exponent = GrowthExponent(results.growth);
  results.nef = CompareWithNef(arguments.quick, 30.0, arguments.seed);
  results.membership =
      TimeMembership(arguments.meshes, arguments.quick ? 5000 : 50000, arguments.seed);
  return results;
}

Json ToJson(const std::vector<BoundaryRow>& rows) {
  Json json = Json::array();
  for (const BoundaryRow& row : rows) {
    json.push_back({{"scene", row.scene},
                    {"faces_a", row.faces_a},
                    {"faces_b", row.faces_b},
                    {"facets", row.facets},
                    {"crossings", row.crossings},
                    {"cells", row.cells},
                    {"memberships", row.memberships},
                    {"exact_signs", row.exact_signs},
                    {"triangles", row.triangles},
                    {"components", row.components},
                    {"median_seconds", row.median_seconds}});
  }
  return json;
}

Json ToJson(const Results& results) {
  Json nef = Json::array(), membership = Json::array();
  for (const NefRow& row : results.nef) {
    nef.push_back({{"pair", row.pair},
                   {"faces_a", row.faces_a},
                   {"faces_b", row.faces_b},
                   {"seconds", row.seconds},
                   {"nef_seconds", row.nef_seconds ? Json(*row.nef_seconds) : Json()},
                   {"same", row.is_same}});
  }
  for (const MembershipRow& row : results.membership) {
    membership.push_back({{"pair", row.pair},
                          {"faces_a", row.faces_a},
                          {"faces_b", row.faces_b},
                          {"mean_us", row.mean_us},
                          {"median_us", row.median_us},
                          {"p99_us", row.p99_us},
                          {"queries", row.queries},
                          {"undecided", row.undecided}});
  }
  return {{"scenes", ToJson(results.scenes)},
          {"growth", ToJson(results.growth)},
          {"exponent", results.exponent},
          {"peak_bytes", results.peak_bytes ? Json(*results.peak_bytes) : Json()},
          {"nef", nef},
          {"membership", membership}};
}

Table BoundaryTable(const std::vector<BoundaryRow>& rows) {
  Table table;
  table.Row({"scene", "faces", "facets", "crossings", "cells", "memberships", "exact signs",
             "triangles", "ms"});
  for (const BoundaryRow& row : rows) {
    table.Row({row.scene, std::to_string(row.faces_a) + " x " + std::to_string(row.faces_b),
               std::to_string(row.facets), std::to_string(row.crossings), std::to_string(row.cells),
               std::to_string(row.memberships), std::to_string(row.exact_signs),
               std::to_string(row.triangles), Fixed(1000.0 * row.median_seconds, 0)});
  }
  return table;
}

Table NefTable(const std::vector<NefRow>& rows) {
  Table table;
  table.Row({"pair", "faces", "ms", "Nef s", "times faster", "same"});
  for (const NefRow& row : rows) {
    table.Row({row.pair, std::to_string(row.faces_a) + " x " + std::to_string(row.faces_b),
               Fixed(1000.0 * row.seconds, 1),
               row.nef_seconds ? Fixed(*row.nef_seconds, 2) : "over 30",
               row.nef_seconds ? Fixed(*row.nef_seconds / row.seconds, 0) : "",
               row.nef_seconds ? (row.is_same ? "yes" : "no") : ""});
  }
  return table;
}

Table MembershipTable(const std::vector<MembershipRow>& rows) {
  Table table;
  table.Row({"pair", "faces", "mean µs", "median", "99 %", "queries", "undecided"});
  for (const MembershipRow& row : rows) {
    table.Row({row.pair, std::to_string(row.faces_a) + " x " + std::to_string(row.faces_b),
               Fixed(row.mean_us, 1), Fixed(row.median_us, 1), Fixed(row.p99_us, 1),
               std::to_string(row.queries), std::to_string(row.undecided)});
  }
  return table;
}

Table TargetTable(const Results& results) {
  Table table;
  table.Row({"measure", "target", "measured"});
  for (const BoundaryRow& row : results.scenes) {
    if (row.scene != "torus-torus") continue;
    table.Row(
        {"torus x torus, 2000 x 2000, one core", "0.4 s", Fixed(row.median_seconds, 2) + " s"});
  }
  table.Row({"growth of time in the facets, exponent", "1.15", Fixed(results.exponent, 2)});
  table.Row({"peak memory of that process", "100 MB",
             results.peak_bytes ? Fixed(*results.peak_bytes / 1e6, 0) + " MB" : "failed"});
  int finished = 0, same = 0;
  for (const NefRow& row : results.nef) {
    finished += row.nef_seconds.has_value();
    same += row.is_same;
  }
  table.Row({"as by Nef polyhedra", "all that finish in 30 s",
             std::to_string(same) + " of " + std::to_string(finished)});
  for (const MembershipRow& row : results.membership) {
    if (row.pair != "torus-torus") continue;
    table.Row({"membership, 2000 x 2000, mean", "20 µs", Fixed(row.mean_us, 1) + " µs"});
  }
  return table;
}

void WriteMarkdown(const std::string& folder, const Results& results) {
  PrepareFolder(folder);
  const auto write = [&](const char* name, const Table& table) {
    std::ofstream file(folder + '/' + name);
    table.PrintMarkdown(file);
    file.close();
    if (!file) throw BadInput{"--markdown: " + folder + '/' + name + " cannot be written"};
  };
  write("bench-boundary.md", BoundaryTable(results.scenes));
  write("bench-boundary-growth.md", BoundaryTable(results.growth));
  write("bench-boundary-nef.md", NefTable(results.nef));
  write("bench-membership.md", MembershipTable(results.membership));
  write("bench-boundary-targets.md", TargetTable(results));
}

void WriteFigure(const std::string& folder, const Results& results) {
  PrepareFolder(folder);
  std::ofstream file(folder + "/boundary-growth.csv");
  file << "scene,faces,facets,seconds,exponent\n";
  for (const BoundaryRow& row : results.growth) {
    file << row.scene << ',' << row.faces_a << ',' << row.facets << ','
         << ShortDouble(row.median_seconds) << ',' << ShortDouble(results.exponent) << '\n';
  }
  file.close();
  if (!file) throw BadInput{"--svg: " + folder + " cannot be written"};
  PlotFigures(folder);
}

int RunBoundaryCommand(const BoundaryArguments& arguments) {
  if (!arguments.meshes.empty() && !std::filesystem::is_directory(arguments.meshes)) {
    throw BadInput{"--meshes: " + arguments.meshes + " is not a folder"};
  }
  const Results results = Measure(arguments);
  if (!arguments.markdown.empty()) WriteMarkdown(arguments.markdown, results);
  if (!arguments.svg.empty()) WriteFigure(arguments.svg, results);
  if (arguments.json) {
    std::cout << ToJson(results).dump(2) << '\n';
  } else {
    BoundaryTable(results.scenes).Print(std::cout);
    std::cout << '\n';
    BoundaryTable(results.growth).Print(std::cout);
    std::cout << '\n';
    NefTable(results.nef).Print(std::cout);
    std::cout << '\n';
    MembershipTable(results.membership).Print(std::cout);
    std::cout << '\n';
    TargetTable(results).Print(std::cout);
  }
  for (const NefRow& row : results.nef) {
    if (row.nef_seconds && !row.is_same) return kFindings;
  }
  return kFine;
}

}  // namespace

void AddBenchBoundary(CLI::App& bench, int& exit_code) {
  CLI::App* command = bench.add_subcommand(
      "boundary",
      "The whole Minkowski boundary and membership: time, growth, memory, Nef polyhedra");
  const auto arguments = std::make_shared<BoundaryArguments>();
  command->add_flag("--quick", arguments->quick, "fewer sizes, rotations and pairs");
  command->add_option("--seed", arguments->seed, "which rotations")->capture_default_str();
  command->add_option("--meshes", arguments->meshes, "folder of closed meshes for membership");
  command->add_option("--markdown", arguments->markdown, "folder for the tables");
  command->add_option("--svg", arguments->svg, "folder for the plot of time against facets");
  command->add_flag("--json", arguments->json, "print JSON");
  command->callback([arguments, &exit_code] { exit_code = RunBoundaryCommand(*arguments); });
}

}  // namespace touchstone
