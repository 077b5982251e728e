// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <memory>
#include <string>
#include <string_view>
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
  bool quick = false, all_pairs = false, json = false;
  int first_pair = 0;
  std::uint64_t seed = 1;
  std::string part = "all";
  std::string markdown, svg, meshes;
};

struct Results {
  std::optional<double> peak_bytes;
  std::vector<BoundaryRow> scenes, growth;
  GrowthFit fit;
  std::vector<NefRow> nef;
  std::vector<MembershipRow> membership;
};

constexpr std::array<std::string_view, 6> kParts = {"all",    "memory", "scenes",
                                                    "growth", "nef",    "membership"};
constexpr double kNefSeconds = 30.0;

bool Wants(const BoundaryArguments& arguments, const char* part) {
  return arguments.part == "all" || arguments.part == part;
}

void ShowNef(const NefRow& row) {
  std::cerr << row.pair << ", " << row.faces_a << " x " << row.faces_b << ": "
            << Fixed(1000.0 * row.seconds, 1) << " ms, Nef ";
  if (row.nef_seconds) {
    std::cerr << Fixed(*row.nef_seconds, 2) << " s, " << (row.is_same ? "same" : "NOT THE SAME");
  } else {
    std::cerr << "over " << kNefSeconds << " s";
  }
  std::cerr << '\n';
}

// Every factor of about the root of two, so that a fit has points enough.
std::vector<int> GrowthSizes(bool quick) {
  if (quick) return {250, 500, 1000, 2000, 4000};
  return {250, 350, 500, 700, 1000, 1400, 2000, 2800, 4000, 5600, 8000};
}

Results Measure(const BoundaryArguments& arguments) {
  Results results;
  const bool quick = arguments.quick;
  if (Wants(arguments, "memory")) results.peak_bytes = PeakMemoryOfTori(2000);
  if (Wants(arguments, "scenes")) {
    results.scenes = TimePaperScenes({quick ? 3 : 9, quick ? 1 : 3, arguments.seed});
  }
  if (Wants(arguments, "growth")) {
    results.growth = TimeGrowth(GrowthSizes(quick), {5, quick ? 3 : 5, arguments.seed});
    results.fit = FitGrowth(results.growth);
  }
  if (Wants(arguments, "nef")) {
    const NefPairs pairs = arguments.all_pairs ? NefPairs::kAll
                           : quick             ? NefPairs::kFew
                                               : NefPairs::kMany;
    results.nef = CompareWithNef(pairs, arguments.first_pair, kNefSeconds, arguments.seed,
                                 arguments.all_pairs ? ShowNef : nullptr);
  }
  if (Wants(arguments, "membership")) {
    results.membership = TimeMembership(arguments.meshes, quick ? 5000 : 50000, arguments.seed);
  }
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
                    {"mean_facets", row.mean_facets},
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
          {"exponent", results.growth.empty() ? Json() : Json(results.fit.exponent)},
          {"exponent_error", results.growth.empty() ? Json() : Json(results.fit.error)},
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
               std::to_string(row.triangles), Fixed(1000.0 * row.median_seconds, 1)});
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
  if (!results.growth.empty()) {
    table.Row({"growth of time in the facets, exponent", "1.15",
               Fixed(results.fit.exponent, 3) + " ± " + Fixed(results.fit.error, 3)});
  }
  if (results.peak_bytes) {
    table.Row(
        {"peak memory of that process", "100 MB", Fixed(*results.peak_bytes / 1e6, 0) + " MB"});
  }
  int finished = 0, same = 0;
  for (const NefRow& row : results.nef) {
    finished += row.nef_seconds.has_value();
    same += row.is_same;
  }
  if (!results.nef.empty()) {
    table.Row({"as by Nef polyhedra", "all that finish in 30 s",
               std::to_string(same) + " of " + std::to_string(finished)});
  }
  for (const MembershipRow& row : results.membership) {
    if (row.pair != "torus-torus") continue;
    table.Row({"membership, 2000 x 2000, mean", "20 µs", Fixed(row.mean_us, 1) + " µs"});
  }
  return table;
}

void WriteMarkdown(const std::string& folder, const Results& results) {
  PrepareFolder(folder);
  const auto write = [&](const char* name, const auto& rows, const auto& make_table) {
    if (rows.empty()) return;
    std::ofstream file(folder + '/' + name);
    make_table(rows).PrintMarkdown(file);
    file.close();
    if (!file) throw BadInput{"--markdown: " + folder + '/' + name + " cannot be written"};
  };
  write("bench-boundary.md", results.scenes, BoundaryTable);
  write("bench-boundary-growth.md", results.growth, BoundaryTable);
  write("bench-boundary-nef.md", results.nef, NefTable);
  write("bench-membership.md", results.membership, MembershipTable);
  std::ofstream targets(folder + "/bench-boundary-targets.md");
  TargetTable(results).PrintMarkdown(targets);
}

void WriteFile(const std::string& path, const std::function<void(std::ostream&)>& write) {
  std::ofstream file(path);
  write(file);
  file.close();
  if (!file) throw BadInput{"--svg: " + path + " cannot be written"};
}

void WriteFigures(const std::string& folder, const Results& results) {
  PrepareFolder(folder);
  if (!results.nef.empty()) {
    WriteFile(folder + "/boundary-nef.csv", [&](std::ostream& file) {
      file << "pair,faces_a,faces_b,seconds,nef_seconds,same\n";
      for (const NefRow& row : results.nef) {
        file << '"' << row.pair << "\"," << row.faces_a << ',' << row.faces_b << ','
             << Fixed(row.seconds, 5) << ',' << (row.nef_seconds ? Fixed(*row.nef_seconds, 2) : "")
             << ',' << (row.nef_seconds ? row.is_same ? "yes" : "no" : "") << '\n';
      }
    });
  }
  if (results.growth.empty()) return;
  WriteFile(folder + "/boundary-growth.csv", [&](std::ostream& file) {
    file << "scene,faces,facets,seconds,exponent\n";
    for (const BoundaryRow& row : results.growth) {
      file << row.scene << ',' << row.faces_a << ',' << Fixed(row.mean_facets, 1) << ','
           << Fixed(row.median_seconds, 6) << ',' << Fixed(results.fit.exponent, 4) << '\n';
    }
  });
  PlotFigures(folder);
}

int RunBoundaryCommand(const BoundaryArguments& arguments) {
  if (!arguments.meshes.empty() && !std::filesystem::is_directory(arguments.meshes)) {
    throw BadInput{"--meshes: " + arguments.meshes + " is not a folder"};
  }
  if (std::find(kParts.begin(), kParts.end(), arguments.part) == kParts.end()) {
    throw BadInput{"--part: '" + arguments.part +
                   "' is none of all, memory, scenes, growth, nef, membership"};
  }
  const Results results = Measure(arguments);
  if (!arguments.markdown.empty()) WriteMarkdown(arguments.markdown, results);
  if (!arguments.svg.empty()) WriteFigures(arguments.svg, results);
  if (arguments.json) {
    std::cout << ToJson(results).dump(2) << '\n';
  } else {
    const auto print = [](const auto& rows, const auto& make_table) {
      if (rows.empty()) return;
      make_table(rows).Print(std::cout);
      std::cout << '\n';
    };
    print(results.scenes, BoundaryTable);
    print(results.growth, BoundaryTable);
    print(results.nef, NefTable);
    print(results.membership, MembershipTable);
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
  command->add_option("--part", arguments->part, "memory, scenes, growth, nef, membership, or all")
      ->capture_default_str();
  command->add_flag("--all-pairs", arguments->all_pairs,
                    "against Nef polyhedra: every two shapes, told as they come; an hour or more");
  command->add_option("--first-pair", arguments->first_pair, "with --all-pairs: where to begin")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command->add_option("--seed", arguments->seed, "which rotations")->capture_default_str();
  command->add_option("--meshes", arguments->meshes, "folder of closed meshes for membership");
  command->add_option("--markdown", arguments->markdown, "folder for the tables");
  command->add_option("--svg", arguments->svg,
                      "folder for boundary-growth.csv and its plot, and boundary-nef.csv");
  command->add_flag("--json", arguments->json, "print JSON");
  command->callback([arguments, &exit_code] { exit_code = RunBoundaryCommand(*arguments); });
}

}  // namespace touchstone
