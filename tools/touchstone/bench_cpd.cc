// SPDX-License-Identifier: MIT
#include <fstream>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "touchstone/tools/bench/machine.h"
#include "touchstone/tools/cpd_profile.h"
#include "touchstone/tools/cpd_run.h"
#include "touchstone/tools/result_json.h"
#include "touchstone/tools/table.h"
#include "touchstone/tools/touchstone/bench.h"
#include "touchstone/tools/touchstone/cpd.h"
#include "touchstone/tools/touchstone/heap_meter.h"
#include "touchstone/tools/touchstone/subcommands.h"

namespace touchstone {
namespace {

struct CpdArguments {
  bool quick = false, json = false, profile = false;
  int frames = 0;
  std::string scene, markdown;
};

Json ToJson(const std::vector<CpdBenchRow>& rows) {
  Json json = Json::array();
  for (const CpdBenchRow& row : rows) {
    json.push_back({{"scene", row.scene},
                    {"method", row.method},
                    {"median_ms", row.median_ms},
                    {"p99_ms", row.p99_ms},
                    {"frames", row.frames},
                    {"events", row.events},
                    {"jumps", row.jumps},
                    {"findings", row.findings},
                    {"combinatorial", row.combinatorial}});
  }
  return json;
}

Table MakeTable(const std::vector<CpdBenchRow>& rows) {
  Table table;
  table.Row({"scene", "method", "median ms", "p99 ms", "frames", "events", "of them combinatorial",
             "jumps", "findings"});
  for (const CpdBenchRow& row : rows) {
    table.Row({row.scene, row.method, Fixed(row.median_ms, 3), Fixed(row.p99_ms, 3),
               std::to_string(row.frames), std::to_string(row.events),
               std::to_string(row.combinatorial), std::to_string(row.jumps),
               std::to_string(row.findings)});
  }
  return table;
}

void PrintProfile(const CpdArguments& arguments) {
  Table table;
  table.Row({"scene", "solver MB", "membership: overlapping us", "separate us", "1e-7 off touch us",
             "cached witness ns"});
  for (const PaperScene& scene : AllPaperScenes()) {
    if (!arguments.scene.empty() && scene.name != arguments.scene) continue;
    const CpdProfile row = ProfileCpd(scene, MeterHeap);
    table.Row({row.scene, Fixed(row.solver_mb, 1), Fixed(row.overlapping_us, 2),
               Fixed(row.separate_us, 2), Fixed(row.near_touch_us, 2), Fixed(row.witness_ns, 0)});
  }
  table.Print(std::cout);
  if (!arguments.scene.empty()) return;
  Table growth;
  growth.Row({"tori, faces", "contact body ms", "depth cold ms", "coherent at 0.1 ms"});
  for (const int faces : {2000, 8000, 32000, 128000}) {
    if (arguments.quick && faces > 8000) continue;
    const DepthGrowthRow row = MeasureDepthGrowth(faces);
    growth.Row({std::to_string(row.faces), Fixed(row.body_ms, 1), Fixed(row.cold_ms, 3),
                Fixed(row.coherent_ms, 3)});
  }
  std::cout << '\n';
  growth.Print(std::cout);
}

int RunCpdBench(const CpdArguments& arguments) {
  CpdBenchOptions options;
  if (arguments.quick)
    options = {.frames = 25, .judged_frames = 2, .bisected_steps = 2, .seconds = 6};
  if (arguments.frames > 0) options.frames = arguments.frames;
  if (!arguments.scene.empty() && FindPaperScene(arguments.scene) == nullptr) {
    throw BadInput{"--scene: there is no scene '" + arguments.scene + "'"};
  }
  if (arguments.profile) {
    PrintProfile(arguments);
    return kFine;
  }
  std::vector<CpdBenchRow> rows;
  for (const PaperScene& scene : AllPaperScenes()) {
    if (!arguments.scene.empty() && scene.name != arguments.scene) continue;
    const std::vector<CpdBenchRow> own = BenchCpdScene(scene, options);
    rows.insert(rows.end(), own.begin(), own.end());
  }
  if (!arguments.markdown.empty()) {
    std::ofstream out(arguments.markdown + "/bench-cpd.md");
    if (!out) throw BadInput{"--markdown: " + arguments.markdown + " cannot be written"};
    MakeTable(rows).PrintMarkdown(out);
  }
  if (arguments.json) {
    std::cout << ToJson(rows).dump(2) << '\n';
  } else {
    MakeTable(rows).Print(std::cout);
    std::cout << '\n' << ProcessorName() << ", vector code for " << VectorClonesInUse() << '\n';
  }
  int findings = 0;
  for (const CpdBenchRow& row : rows) findings += row.findings;
  return findings > 0 ? kFindings : kFine;
}

}  // namespace

void AddBenchCpd(CLI::App& bench, int& exit_code) {
  CLI::App* command = bench.add_subcommand(
      "cpd", "Penetration depth of meshes on the paper's four scenes: its Table 1, and depths");
  const auto arguments = std::make_shared<CpdArguments>();
  command->add_flag("--quick", arguments->quick, "few frames: within a minute");
  command->add_option("--scene", arguments->scene, "one scene only");
  command->add_option("--frames", arguments->frames, "frames of each motion");
  command->add_option("--markdown", arguments->markdown, "folder for the table as bench-cpd.md");
  command->add_flag("--profile", arguments->profile,
                    "instead: what a solver holds, what membership costs, and how depths grow with "
                    "the faces of tori");
  command->add_flag("--json", arguments->json, "print JSON: an array of rows");
  command->callback([arguments, &exit_code] { exit_code = RunCpdBench(*arguments); });
}

}  // namespace touchstone
