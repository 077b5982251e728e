// SPDX-License-Identifier: MIT
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "touchstone/tools/bench/convex_bench.h"
#include "touchstone/tools/bench/convex_profile.h"
#include "touchstone/tools/bench/convex_report.h"
#include "touchstone/tools/bench/figures.h"
#include "touchstone/tools/bench/machine.h"
#include "touchstone/tools/bench/other_program.h"
#include "touchstone/tools/bench/targets.h"
#include "touchstone/tools/bench/workload.h"
#include "touchstone/tools/touchstone/bench.h"
#include "touchstone/tools/touchstone/heap_meter.h"
#include "touchstone/tools/touchstone/subcommands.h"

namespace touchstone {
namespace {

constexpr int kLargestSize = 1000000;

struct ConvexArguments {
  std::vector<std::string> engines, shapes, modes;
  std::vector<int> sizes;
  std::vector<double> gaps;
  int orientations = 0, repeats = 0, pairs = 0, motions = 0;
  double seconds_per_row = 1.0;
  std::uint64_t seed = 1;
  std::string meshes, csv, svg, markdown;
  bool quick = false, profile = false, json = false;
};

BenchMode ParseMode(const std::string& word) {
  for (const BenchMode mode :
       {BenchMode::kRepeat, BenchMode::kMixed, BenchMode::kWarm, BenchMode::kWarmOneDegree}) {
    if (ToString(mode) == word) return mode;
  }
  throw BadInput{"--modes: '" + word + "' is none of repeat, mixed, warm, warm-1deg"};
}

template <class T>
std::vector<T> OrElse(const std::vector<T>& given, std::vector<T> otherwise) {
  return given.empty() ? std::move(otherwise) : given;
}

int OrElse(int given, int otherwise, const char* option) {
  if (given < 0) throw BadInput{std::string(option) + ": takes a number that is not negative"};
  return given == 0 ? otherwise : given;
}

std::vector<std::string> CheckedShapes(const ConvexArguments& arguments,
                                       std::vector<std::string> otherwise) {
  std::vector<std::string> shapes = OrElse(arguments.shapes, std::move(otherwise));
  for (const std::string& shape : shapes) {
    if (!IsBenchShape(shape))
      throw BadInput{"--shapes: '" + shape +
                     "' is none of ellipsoid-ASPECT, prism, slab, bipyramid, grid, parallel, mesh"};
    if (shape == "mesh" && arguments.meshes.empty())
      throw BadInput{"--shapes mesh: no folder of meshes given (--meshes DIR)"};
  }
  return shapes;
}

void AddCells(const std::vector<std::string>& shapes, const std::vector<int>& sizes,
              const std::vector<BenchMode>& modes, std::vector<ConvexBenchCell>* cells) {
  for (const std::string& shape : shapes) {
    for (const int n : sizes) {
      for (const BenchMode mode : modes) cells->push_back({shape, n, mode});
    }
  }
}

// The paper's two figures (n at 2:1:1, the aspect at n = 1000) and what the targets ask for.
std::vector<ConvexBenchCell> WholeProgram(const ConvexArguments& arguments) {
  using enum BenchMode;
  std::vector<ConvexBenchCell> cells;
  AddCells({"ellipsoid-2"}, {20, 100, 1000, 20000}, {kRepeat, kMixed}, &cells);
  AddCells({"ellipsoid-2"}, {100, 1000}, {kWarm, kWarmOneDegree}, &cells);
  AddCells({"ellipsoid-1", "ellipsoid-10"}, {100, 1000}, {kRepeat}, &cells);
  AddCells({"prism", "slab", "grid"}, {100, 1000}, {kRepeat}, &cells);
  if (!arguments.meshes.empty()) AddCells({"mesh"}, {100, 1000}, {kRepeat}, &cells);
  return cells;
}

std::vector<ConvexBenchCell> MakeCells(const ConvexArguments& arguments) {
  if (!arguments.quick && arguments.shapes.empty() && arguments.sizes.empty() &&
      arguments.modes.empty()) {
    return WholeProgram(arguments);
  }
  const std::vector<int> sizes = OrElse(arguments.sizes, {20, 100, 1000});
  for (const int n : sizes) {
    if (n < 4 || n > kLargestSize) throw BadInput{"--sizes: takes numbers from 4 to 1000000"};
  }
  std::vector<BenchMode> modes;
  for (const std::string& word :
       OrElse(arguments.modes, std::vector<std::string>{"repeat", "mixed", "warm"})) {
    modes.push_back(ParseMode(word));
  }
  std::vector<ConvexBenchCell> cells;
  AddCells(CheckedShapes(arguments, {"ellipsoid-2"}), sizes, modes, &cells);
  return cells;
}

ConvexBenchOptions MakeOptions(const ConvexArguments& arguments) {
  const bool quick = arguments.quick;
  ConvexBenchOptions options;
  options.engines = SelectEngines(arguments.engines);
  options.cells = MakeCells(arguments);
  options.gaps = OrElse(arguments.gaps, quick ? std::vector<double>{-5.0, -1e-6, 1e-6, 5.0}
                                              : std::vector<double>{-50.0, -5.0, -1.0, -1e-6, 1e-6,
                                                                    1.0, 5.0, 20.0, 200.0});
  for (const double gap : options.gaps) {
    if (!std::isfinite(gap)) throw BadInput{"--gaps: takes finite numbers"};
  }
  options.orientations = OrElse(arguments.orientations, quick ? 40 : 500, "--orientations");
  options.repeats = OrElse(arguments.repeats, quick ? 60 : 300, "--repeats");
  options.mixed_pairs = OrElse(arguments.pairs, quick ? 512 : 2048, "--pairs");
  options.motions = OrElse(arguments.motions, quick ? 6 : 24, "--motions");
  options.seconds_per_row = quick ? 0.2 : arguments.seconds_per_row;
  if (!(options.seconds_per_row > 0.0))
    throw BadInput{"--seconds-per-row: takes a positive number"};
  options.seed = arguments.seed;
  options.meshes_dir = arguments.meshes;
  return options;
}

std::ofstream OpenForWriting(const std::string& path) {
  std::ofstream file(path);
  if (!file) throw BadInput{path + " cannot be written"};
  return file;
}

// Where the whole program runs, or it was asked for.
bool WantsProfile(const ConvexArguments& arguments) {
  return arguments.profile ||
         (!arguments.quick && arguments.shapes.empty() && arguments.sizes.empty() &&
          arguments.modes.empty() && arguments.engines.empty());
}

ConvexProfile MakeProfile(const ConvexBenchOptions& options,
                          const std::function<void(double)>& report) {
  ConvexProfileOptions profile;
  profile.sizes = {20, 100, 1000};
  profile.gaps = {-5.0, -1e-6, 1e-6, 5.0};
  profile.relative_gaps = {1e-6, 1e-9, 1e-12, 1e-15};
  profile.orientations = options.orientations * 2;
  profile.seed = options.seed;
  profile.heap = MeterHeap;
  return RunConvexProfile(profile, report);
}

// Nothing where touchstone-avx2 was not built, or the processor has no more than it uses.
std::optional<InstructionSets> MakeInstructionSets() {
  const std::string arguments =
      "--quick --modes repeat --engines portal,libccd-mpr,libccd-mpr+support,fcl-libccd,bullet-f64";
  const auto here = ProgramBeside("touchstone"), there = ProgramBeside("touchstone-avx2");
  if (!here || !there || VectorClonesInUse() != "AVX-512") return std::nullopt;
  const auto all = RunConvexBenchOf(*here, arguments), avx2 = RunConvexBenchOf(*there, arguments);
  if (!all || !avx2) return std::nullopt;
  return InstructionSets{*all, *avx2};
}

int RunConvexCommand(const ConvexArguments& arguments) {
  const ConvexBenchOptions options = MakeOptions(arguments);
  std::ofstream csv, tables, summary, targets_file;
  if (!arguments.csv.empty()) csv = OpenForWriting(arguments.csv);
  if (!arguments.markdown.empty()) {
    tables = OpenForWriting(arguments.markdown + "/bench-convex.md");
    summary = OpenForWriting(arguments.markdown + "/bench-summary.md");
    targets_file = OpenForWriting(arguments.markdown + "/bench-targets.md");
  }
  if (!arguments.svg.empty()) PrepareFolder(arguments.svg);
  const bool terminal = isatty(STDERR_FILENO) != 0;
  const std::function<void(double)> report =
      terminal ? std::function<void(double)>(ShowProgress) : nullptr;
  const std::vector<ConvexBenchRow> rows = RunConvexBench(options, report);
  std::optional<ConvexProfile> profile;
  std::optional<InstructionSets> instruction_sets;
  if (WantsProfile(arguments)) {
    profile = MakeProfile(options, report);
    instruction_sets = MakeInstructionSets();
  }
  if (terminal) std::cerr << "\r\033[K";
  const std::vector<Target> targets = CompareWithTargets(
      rows, profile ? &*profile : nullptr, instruction_sets ? &*instruction_sets : nullptr);
  if (csv.is_open()) WriteConvexBenchCsv(csv, rows);
  if (!arguments.svg.empty()) {
    if (!WriteTimeFigures(arguments.svg, rows))
      throw BadInput{arguments.svg + " cannot be written"};
    PlotFigures(arguments.svg);
  }
  if (tables.is_open()) {
    PrintConvexBench(tables, rows, TableStyle::kMarkdown);
    PrintSummary(summary, rows, TableStyle::kMarkdown);
    PrintTargets(targets_file, targets, TableStyle::kMarkdown);
  }
  if (arguments.json) {
    std::cout << ConvexBenchJson(rows).dump(2) << '\n';
  } else {
    PrintConvexBench(std::cout, rows, TableStyle::kText);
    PrintTargets(std::cout, targets, TableStyle::kText);
    std::cout << ProcessorName() << ", vector code for " << VectorClonesInUse() << '\n';
  }
  const bool proven_wrong = std::any_of(rows.begin(), rows.end(), [&](const ConvexBenchRow& row) {
    return row.wrong > 0 &&
           std::any_of(options.engines.begin(), options.engines.end(),
                       [&](const auto& e) { return e.name == row.engine && e.proven; });
  });
  return proven_wrong ? kFindings : kFine;
}

}  // namespace

void AddBenchConvex(CLI::App& bench, int& exit_code) {
  CLI::App* command =
      bench.add_subcommand("convex", "Boolean overlap of convex bodies, all engines side by side");
  const auto arguments = std::make_shared<ConvexArguments>();
  command->add_flag("--quick", arguments->quick,
                    "within a minute: ellipsoid 2:1:1, n = 20, 100, 1000, four gaps");
  command->add_option("--engines", arguments->engines, "names, separated by commas; all")
      ->delimiter(',');
  command
      ->add_option(
          "--shapes", arguments->shapes,
          "ellipsoid-ASPECT, prism, slab, bipyramid, grid, parallel, mesh, separated by commas")
      ->delimiter(',');
  command->add_option("-n,--sizes", arguments->sizes, "vertices a body, separated by commas")
      ->delimiter(',');
  command->add_option("--gaps", arguments->gaps, "signed travels, separated by commas")
      ->delimiter(',');
  command->add_option("--modes", arguments->modes, "repeat, mixed, warm, warm-1deg")
      ->delimiter(',');
  command->add_option("--orientations", arguments->orientations, "of mode repeat; 500, quick 40");
  command->add_option("--repeats", arguments->repeats, "of each query; 300, quick 60");
  command->add_option("--pairs", arguments->pairs,
                      "of mode mixed, in batches of 32; 2048, quick 512");
  command->add_option("--motions", arguments->motions, "of mode warm, 64 frames each; 24, quick 6");
  command
      ->add_option("--seconds-per-row", arguments->seconds_per_row,
                   "an engine slower than that is asked fewer queries; quick 0.2")
      ->capture_default_str();
  command->add_option("--seed", arguments->seed, "which stream of bodies and placements")
      ->capture_default_str();
  command->add_option("--meshes", arguments->meshes, "folder of meshes for the shape of that name");
  command->add_option("--csv", arguments->csv, "write the rows to this file, too");
  command->add_option("--svg", arguments->svg,
                      "folder for plots of time against the gap, by n and by shape (Figures 8, 9)");
  command->add_option("--markdown", arguments->markdown,
                      "folder for the tables: bench-convex.md, bench-summary.md, bench-targets.md");
  command->add_flag("--profile", arguments->profile,
                    "measure percentiles, tiers, memory and build, too (the whole program does)");
  command->add_flag("--json", arguments->json, "print JSON: an array of rows");
  command->footer("Exit code 1 when a proven engine of ours has a wrong verdict.");
  command->callback([arguments, &exit_code] { exit_code = RunConvexCommand(*arguments); });
}

}  // namespace touchstone
