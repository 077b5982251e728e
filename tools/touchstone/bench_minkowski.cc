// SPDX-License-Identifier: MIT
#include <algorithm>
#include <fstream>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "touchstone/tools/bench/machine.h"
#include "touchstone/tools/bench/minkowski_bench.h"
#include "touchstone/tools/numbers.h"
#include "touchstone/tools/result_json.h"
#include "touchstone/tools/table.h"
#include "touchstone/tools/touchstone/bench.h"
#include "touchstone/tools/touchstone/subcommands.h"

namespace touchstone {
namespace {

struct MinkowskiArguments {
  bool quick = false, json = false;
  int frames = 0, random = 0;
  std::uint64_t seed = 1;
  std::string figures, svg;
};

Json ToJson(const std::vector<MinkowskiBenchRow>& rows) {
  Json json = Json::array();
  for (const MinkowskiBenchRow& row : rows) {
    json.push_back({{"scene", row.scene},
                    {"builder", ToString(row.builder)},
                    {"rotation_deg", row.rotation_deg},
                    {"median_ms", row.median_ms},
                    {"facets", row.facets},
                    {"mismatches", row.mismatches}});
  }
  return json;
}

void WriteCsv(const std::vector<MinkowskiBenchRow>& rows, const std::string& path) {
  std::ofstream out(path);
  out << "scene,builder,rotation_deg,median_ms,facets,mismatches\n";
  for (const MinkowskiBenchRow& row : rows) {
    out << row.scene << ',' << ToString(row.builder) << ',' << ShortDouble(row.rotation_deg) << ','
        << ShortDouble(row.median_ms) << ',' << row.facets << ',' << row.mismatches << '\n';
  }
}

// A builder a column; rows come four to a scene and rotation.
Table MakeTable(const std::vector<MinkowskiBenchRow>& rows) {
  Table table;
  table.Row({"scene", "degrees", "full", "brute force", "hierarchy", "gap filling", "facets",
             "hierarchy / gap", "full / gap", "mismatches"});
  for (std::size_t i = 0; i + 3 < rows.size(); i += 4) {
    const double gap = std::max(1e-6, rows[i + 3].median_ms);
    std::vector<std::string> cells = {rows[i].scene, ShortDouble(rows[i].rotation_deg)};
    int mismatches = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      cells.push_back(Fixed(rows[i + k].median_ms, 3));
      mismatches += rows[i + k].mismatches;
    }
    cells.push_back(std::to_string(rows[i + 3].facets));
    cells.push_back(Fixed(rows[i + 2].median_ms / gap, 1));
    cells.push_back(Fixed(rows[i].median_ms / gap, 0));
    cells.push_back(std::to_string(mismatches));
    table.Row(cells);
  }
  return table;
}

int RunRandom(const MinkowskiArguments& arguments) {
  const RandomSumsReport report = CompareOnRandomBalls(arguments.random, arguments.seed);
  const int mismatches = report.mismatches[1] + report.mismatches[2] + report.mismatches[3];
  std::cout << "balls            " << report.balls << ", " << report.nonempty
            << " that meet the boundary, " << report.triangles << " triangles\n"
            << "mismatches       brute force " << report.mismatches[1] << ", hierarchy "
            << report.mismatches[2] << ", gap filling " << report.mismatches[3] << '\n'
            << "judged           " << report.judged << " segments, " << report.misjudged
            << " refuted\n";
  return mismatches + report.misjudged == 0 ? kFine : kFindings;
}

int RunMinkowskiBenchCommand(const MinkowskiArguments& arguments) {
  if (arguments.random > 0) return RunRandom(arguments);
  MinkowskiBenchOptions options;
  if (arguments.quick) {
    options.rotations_deg = {0.1, 1.0};
    options.frames = 24;
    options.brute_force_frames = 3;
    options.full_frames = 2;
  }
  if (arguments.frames > 0) options.frames = arguments.frames;
  if (!arguments.figures.empty()) {
    PrepareFolder(arguments.figures);
    options.figure_folder = arguments.figures;
  }
  if (!arguments.svg.empty()) PrepareFolder(arguments.svg);
  if (!arguments.json) options.progress = ShowProgress;
  const std::vector<MinkowskiBenchRow> rows = RunMinkowskiBench(options);
  if (!arguments.svg.empty()) {
    WriteCsv(rows, arguments.svg + "/minkowski.csv");
    PlotFigures(arguments.svg);
  }
  int mismatches = 0;
  for (const MinkowskiBenchRow& row : rows) mismatches += row.mismatches;
  if (arguments.json) {
    std::cout << ToJson(rows).dump(2) << '\n';
  } else {
    std::cout << "median ms of processor time an update; A turned by so many degrees from frame to "
                 "frame\n\n";
    MakeTable(rows).Print(std::cout);
    std::cout << '\n' << ProcessorName() << ", vector code for " << VectorClonesInUse() << '\n';
  }
  return mismatches == 0 ? kFine : kFindings;
}

}  // namespace

void AddBenchMinkowski(CLI::App& bench, int& exit_code) {
  CLI::App* command = bench.add_subcommand(
      "minkowski", "The paper's Table 2: local Minkowski sums by every builder");
  const auto arguments = std::make_shared<MinkowskiArguments>();
  command->add_flag("--quick", arguments->quick, "two rotations and few frames: within a minute");
  command->add_option("--frames", arguments->frames, "so many for the two fast builders");
  command->add_option("--figures", arguments->figures,
                      "folder for the meshes of Figure 12, full and local, as OFF files");
  command->add_option("--svg", arguments->svg,
                      "folder for minkowski.csv and its plot against rotation, minkowski.svg");
  command->add_option("--random", arguments->random,
                      "no timing: compare the builders on so many random balls and poses");
  command->add_option("--seed", arguments->seed, "of --random")->capture_default_str();
  command->add_flag("--json", arguments->json, "print JSON: an array of rows");
  command->callback([arguments, &exit_code] { exit_code = RunMinkowskiBenchCommand(*arguments); });
}

}  // namespace touchstone
