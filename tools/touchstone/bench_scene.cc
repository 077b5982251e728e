// SPDX-License-Identifier: MIT
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "touchstone/tools/bench/machine.h"
#include "touchstone/tools/bench/scene_bench.h"
#include "touchstone/tools/engines/world.h"
#include "touchstone/tools/numbers.h"
#include "touchstone/tools/result_json.h"
#include "touchstone/tools/table.h"
#include "touchstone/tools/touchstone/bench.h"
#include "touchstone/tools/touchstone/subcommands.h"

namespace touchstone {
namespace {

struct SceneBenchArguments {
  bool quick = false, json = false;
  std::uint64_t seed = 1;
  std::string svg, markdown;
};

Json ToJson(const SceneBenchReport& report) {
  Json json = Json::array();
  for (const SceneBenchRow& row : report.rows) {
    json.push_back({{"engine", row.engine},
                    {"bodies", row.bodies},
                    {"motion", ToString(row.motion)},
                    {"median_ms_per_step", row.median_ms_per_step},
                    {"pairs", row.pairs},
                    {"mismatches", row.mismatches}});
  }
  return json;
}

Table MakeTable(const SceneBenchReport& report) {
  Table table;
  table.Row({"engine", "bodies", "motion", "ms/step", "pairs", "mismatches"});
  for (const SceneBenchRow& row : report.rows) {
    table.Row({row.engine, std::to_string(row.bodies), std::string(ToString(row.motion)),
               Fixed(row.median_ms_per_step, 4), std::to_string(row.pairs),
               std::to_string(row.mismatches)});
  }
  return table;
}

Table MakeCounters(const SceneBenchReport& report) {
  const SceneCounters& c = report.counters;
  Table table;
  table.Row({"pairs of parts a step, 10,000 bodies, coherent", ""});
  const auto row = [&](const char* what, long count) {
    table.Row({what, Fixed(static_cast<double>(count) / std::max(1, report.counted_steps), 0)});
  };
  row("possible", c.pairs_possible);
  row("candidates: fat boxes met", c.pairs);
  row("not looked at: margin", c.by_margin);
  row("not looked at: rest", c.by_rest);
  row("looked at", c.looked_at);
  row("  decided by boxes", c.by_box);
  row("  by balls", c.by_balls);
  row("  by the last direction or simplex", c.by_guess);
  row("  by a query", c.queries);
  row("  for a longer margin: Distance", c.improved);
  row("    with big numbers", c.exact_queries);
  row("boxes made anew", c.boxes_made);
  return table;
}

std::string Outcome(bool met) { return met ? "met" : "missed"; }

Table MakeTargets(const SceneBenchReport& report) {
  Table table;
  table.Row({"target", "measured", ""});
  const auto* ours = FindRow(report, "touchstone", 10000, SceneMotion::kCoherent);
  double best = 0.0;
  for (const char* other : {"fcl", "bullet-f64"}) {
    const auto* row = FindRow(report, other, 10000, SceneMotion::kCoherent);
    if (row != nullptr && (best == 0.0 || row->median_ms_per_step < best)) {
      best = row->median_ms_per_step;
    }
  }
  if (ours != nullptr && best > 0.0) {
    const double ratio = best / ours->median_ms_per_step;
    table.Row({"10,000 coherent hulls, one thread: >= 5 times faster than the better other",
               Fixed(ratio, 1), Outcome(ratio >= 5.0)});
  }
  const auto* rest = FindRow(report, "touchstone", 10000, SceneMotion::kStatic);
  if (ours != nullptr && rest != nullptr) {
    const double share = 100.0 * rest->median_ms_per_step / ours->median_ms_per_step;
    table.Row({"nothing moving: <= 1 % of the moving step", Fixed(share, 3) + " %",
               Outcome(share <= 1.0)});
  }
  table.Row({"exponent from 1,000 to 100,000 bodies: <= 1.15", Fixed(report.exponent, 3),
             Outcome(report.exponent <= 1.15)});
  const long wrong = std::count_if(report.rows.begin(), report.rows.end(), [](const auto& row) {
    return row.engine.starts_with("touchstone") && row.mismatches > 0;
  });
  table.Row({"our scenes' mismatches, all rules on and off: 0", std::to_string(wrong),
             Outcome(wrong == 0)});
  table.Row({"bytes a body, a pair",
             Fixed(report.bytes_per_body, 0) + ", " + Fixed(report.bytes_per_pair, 0), ""});
  return table;
}

void WriteCsv(const SceneBenchReport& report, const std::string& path) {
  std::ofstream out(path);
  out << "engine,bodies,motion,median_ms_per_step,pairs,mismatches\n";
  for (const SceneBenchRow& row : report.rows) {
    out << row.engine << ',' << row.bodies << ',' << ToString(row.motion) << ','
        << ShortDouble(row.median_ms_per_step) << ',' << row.pairs << ',' << row.mismatches << '\n';
  }
}

int RunSceneBenchCommand(const SceneBenchArguments& arguments) {
  SceneBenchOptions options;
  options.quick = arguments.quick;
  options.seed = arguments.seed;
  if (!arguments.svg.empty()) PrepareFolder(arguments.svg);
  if (!arguments.markdown.empty()) PrepareFolder(arguments.markdown);
  for (const WorldDescription& other : OtherWorlds()) {
    if (other.unavailable.empty()) continue;
    std::cerr << "touchstone: engine " << other.name << " left out: " << other.unavailable << '\n';
  }
  if (isatty(STDERR_FILENO) != 0) options.progress = ShowProgress;
  const SceneBenchReport report = RunSceneBench(options);
  if (!arguments.svg.empty()) {
    WriteCsv(report, arguments.svg + "/scene.csv");
    PlotFigures(arguments.svg);
  }
  if (!arguments.markdown.empty()) {
    std::ofstream out(arguments.markdown + "/bench-scene.md");
    MakeTable(report).PrintMarkdown(out);
    out << '\n';
    MakeCounters(report).PrintMarkdown(out);
    out << '\n';
    MakeTargets(report).PrintMarkdown(out);
  }
  if (arguments.json) {
    std::cout << ToJson(report).dump(2) << '\n';
  } else {
    MakeTable(report).Print(std::cout);
    std::cout << '\n';
    MakeCounters(report).Print(std::cout);
    std::cout << '\n';
    MakeTargets(report).Print(std::cout);
    std::cout << '\n' << ProcessorName() << ", vector code for " << VectorClonesInUse() << '\n';
  }
  const bool ours_wrong =
      std::any_of(report.rows.begin(), report.rows.end(), [](const SceneBenchRow& row) {
        return row.engine.starts_with("touchstone") && row.mismatches > 0;
      });
  return ours_wrong ? kFindings : kFine;
}

}  // namespace

void AddBenchScene(CLI::App& bench, int& exit_code) {
  CLI::App* command =
      bench.add_subcommand("scene", "Steps of scenes of 100 to 100,000 bodies, by every engine");
  const auto arguments = std::make_shared<SceneBenchArguments>();
  command->add_flag("--quick", arguments->quick,
                    "fewer steps; 100,000 bodies by ours alone; within a minute");
  command->add_option("--seed", arguments->seed, "which bodies and motions")->capture_default_str();
  command->add_option("--svg", arguments->svg, "folder for scene.csv and its plot, scene.svg");
  command->add_option("--markdown", arguments->markdown, "folder for the tables: bench-scene.md");
  command->add_flag("--json", arguments->json, "print JSON: an array of rows");
  command->callback([arguments, &exit_code] { exit_code = RunSceneBenchCommand(*arguments); });
}

}  // namespace touchstone
