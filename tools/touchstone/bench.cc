// SPDX-License-Identifier: MIT
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "touchstone/tools/bench/convex_bench.h"
#include "touchstone/tools/bench/convex_report.h"
#include "touchstone/tools/bench/workload.h"
#include "touchstone/tools/engines/registry.h"
#include "touchstone/tools/numbers.h"
#include "touchstone/tools/touchstone/subcommands.h"

namespace touchstone {
namespace {

constexpr int kLargestSize = 1000000;

struct ConvexArguments {
  std::vector<std::string> engines, shapes, modes;
  std::vector<int> sizes;
  std::vector<double> gaps;
  int orientations = 0, repeats = 0, pairs = 0, motions = 0;
  std::uint64_t seed = 1;
  std::string meshes, csv;
  bool quick = false, json = false;
};

// The engines asked for by name, or all that can run; says on stderr which cannot.
std::vector<EngineDescription> SelectEngines(const std::vector<std::string>& names) {
  std::vector<EngineDescription> selected;
  const std::vector<EngineDescription> all = AllEngines();
  for (const std::string& name : names) {
    const auto found = std::find_if(all.begin(), all.end(),
                                    [&](const EngineDescription& e) { return e.name == name; });
    if (found == all.end())
      throw BadInput{"--engines: there is no engine '" + name +
                     "'; `touchstone engines` lists them"};
    if (!found->unavailable.empty()) throw BadInput{"engine " + name + ": " + found->unavailable};
    selected.push_back(*found);
  }
  if (!names.empty()) return selected;
  for (const EngineDescription& engine : all) {
    if (engine.unavailable.empty()) {
      selected.push_back(engine);
    } else {
      std::cerr << "touchstone: engine " << engine.name << " left out: " << engine.unavailable
                << '\n';
    }
  }
  return selected;
}

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

ConvexBenchOptions MakeOptions(const ConvexArguments& arguments) {
  const bool quick = arguments.quick;
  ConvexBenchOptions options;
  options.engines = SelectEngines(arguments.engines);
  options.shapes =
      OrElse(arguments.shapes,
             quick ? std::vector<std::string>{"ellipsoid-2"}
                   : std::vector<std::string>{"ellipsoid-1", "ellipsoid-2", "ellipsoid-10"});
  for (const std::string& shape : options.shapes) {
    if (!IsBenchShape(shape))
      throw BadInput{"--shapes: '" + shape +
                     "' is none of ellipsoid-ASPECT, prism, slab, grid, mesh"};
    if (shape == "mesh" && arguments.meshes.empty())
      throw BadInput{"--shapes mesh: no folder of meshes given (--meshes DIR)"};
  }
  options.sizes = OrElse(arguments.sizes, quick ? std::vector<int>{20, 100, 1000}
                                                : std::vector<int>{20, 100, 1000, 20000});
  for (const int n : options.sizes) {
    if (n < 4 || n > kLargestSize) throw BadInput{"--sizes: takes numbers from 4 to 1000000"};
  }
  options.gaps = OrElse(arguments.gaps, quick ? std::vector<double>{-5.0, -1e-6, 1e-6, 5.0}
                                              : std::vector<double>{-50.0, -5.0, -1.0, -1e-6, 1e-6,
                                                                    1.0, 5.0, 20.0, 200.0});
  for (const double gap : options.gaps) {
    if (!std::isfinite(gap)) throw BadInput{"--gaps: takes finite numbers"};
  }
  for (const std::string& word :
       OrElse(arguments.modes,
              quick ? std::vector<std::string>{"repeat", "mixed", "warm"}
                    : std::vector<std::string>{"repeat", "mixed", "warm", "warm-1deg"})) {
    options.modes.push_back(ParseMode(word));
  }
  options.orientations = OrElse(arguments.orientations, quick ? 40 : 500, "--orientations");
  options.repeats = OrElse(arguments.repeats, quick ? 60 : 300, "--repeats");
  options.mixed_pairs = OrElse(arguments.pairs, quick ? 512 : 2048, "--pairs");
  options.mixed_vertices = quick ? 1 << 16 : 1 << 18;
  options.motions = OrElse(arguments.motions, quick ? 6 : 24, "--motions");
  options.seed = arguments.seed;
  options.meshes_dir = arguments.meshes;
  return options;
}

void ShowProgress(double fraction) {
  std::cerr << "\r" << static_cast<int>(100.0 * fraction) << "% " << std::flush;
}

int RunConvexCommand(const ConvexArguments& arguments) {
  const ConvexBenchOptions options = MakeOptions(arguments);
  std::ofstream csv;
  if (!arguments.csv.empty()) {
    csv.open(arguments.csv);
    if (!csv) throw BadInput{"--csv: " + arguments.csv + " cannot be written"};
  }
  const bool terminal = isatty(STDERR_FILENO) != 0;
  const std::vector<ConvexBenchRow> rows =
      RunConvexBench(options, terminal ? std::function<void(double)>(ShowProgress) : nullptr);
  if (terminal) std::cerr << "\r\033[K";
  if (csv.is_open()) WriteConvexBenchCsv(csv, rows);
  if (arguments.json) {
    std::cout << ConvexBenchJson(rows).dump(2) << '\n';
  } else {
    PrintConvexBench(std::cout, rows);
  }
  const bool proven_wrong = std::any_of(rows.begin(), rows.end(), [&](const ConvexBenchRow& row) {
    return row.wrong > 0 &&
           std::any_of(options.engines.begin(), options.engines.end(),
                       [&](const auto& e) { return e.name == row.engine && e.proven; });
  });
  return proven_wrong ? kFindings : kFine;
}

void AddConvex(CLI::App& bench, int& exit_code) {
  CLI::App* command =
      bench.add_subcommand("convex", "Boolean overlap of convex bodies, all engines side by side");
  const auto arguments = std::make_shared<ConvexArguments>();
  command->add_flag("--quick", arguments->quick,
                    "within a minute: ellipsoid 2:1:1, n = 20, 100, 1000, four gaps");
  command->add_option("--engines", arguments->engines, "names, separated by commas; all")
      ->delimiter(',');
  command
      ->add_option("--shapes", arguments->shapes,
                   "ellipsoid-ASPECT, prism, slab, grid, mesh, separated by commas")
      ->delimiter(',');
  command->add_option("-n,--sizes", arguments->sizes, "vertices a body, separated by commas")
      ->delimiter(',');
  command->add_option("--gaps", arguments->gaps, "signed travels, separated by commas")
      ->delimiter(',');
  command->add_option("--modes", arguments->modes, "repeat, mixed, warm, warm-1deg")
      ->delimiter(',');
  command->add_option("--orientations", arguments->orientations, "of mode repeat; 500, quick 40");
  command->add_option("--repeats", arguments->repeats, "of each query; 300, quick 60");
  command->add_option("--pairs", arguments->pairs, "of mode mixed; 2048, quick 512");
  command->add_option("--motions", arguments->motions, "of mode warm, 64 frames each; 24, quick 6");
  command->add_option("--seed", arguments->seed, "which stream of bodies and placements")
      ->capture_default_str();
  command->add_option("--meshes", arguments->meshes, "folder of meshes for the shape of that name");
  command->add_option("--csv", arguments->csv, "write the rows to this file, too");
  command->add_flag("--json", arguments->json, "print JSON: an array of rows");
  command->footer("Exit code 1 when a proven engine of ours has a wrong verdict.");
  command->callback([arguments, &exit_code] { exit_code = RunConvexCommand(*arguments); });
}

}  // namespace

void AddBench(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("bench", "Time engines side by side");
  command->require_subcommand(1);
  AddConvex(*command, exit_code);
}

void AddEngines(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("engines", "List the engines that are timed and judged");
  command->callback([&exit_code] {
    for (const EngineDescription& engine : AllEngines()) {
      std::cout << engine.name
                << std::string(engine.name.size() < 20 ? 20 - engine.name.size() : 1, ' ')
                << (engine.unavailable.empty() ? engine.summary
                                               : "unavailable: " + engine.unavailable)
                << '\n';
    }
    exit_code = kFine;
  });
}

}  // namespace touchstone
