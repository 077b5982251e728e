// SPDX-License-Identifier: MIT
#include <unistd.h>

#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "touchstone/tools/bench/figures.h"
#include "touchstone/tools/touchstone/bench.h"
#include "touchstone/tools/touchstone/subcommands.h"

namespace touchstone {
namespace {

struct FiguresArguments {
  std::string directory;
  std::vector<std::string> engines;
  bool quick = false;
  int orientations = 0;
  std::uint64_t seed = 1;
};

int RunFiguresCommand(const FiguresArguments& arguments) {
  FiguresOptions options;
  options.directory = arguments.directory;
  options.engines = SelectEngines(arguments.engines);
  options.seed = arguments.seed;
  if (arguments.quick) {
    options.orientations = 20;
    options.repeats = 15;
    options.seconds_per_row = 0.1;
  }
  if (arguments.orientations < 0)
    throw BadInput{"--orientations: takes a number that is not negative"};
  if (arguments.orientations > 0) options.orientations = arguments.orientations;
  PrepareFolder(arguments.directory);
  const bool terminal = isatty(STDERR_FILENO) != 0;
  if (!MakeFigures(options, terminal ? ShowProgress : nullptr))
    throw BadInput{arguments.directory + ": the files cannot be written"};
  PlotFigures(arguments.directory);
  return kFine;
}

}  // namespace

void AddBenchFigures(CLI::App& bench, int& exit_code) {
  CLI::App* command = bench.add_subcommand(
      "figures", "The paper's Figures 8 to 10, and run time against error: CSV and SVG");
  const auto arguments = std::make_shared<FiguresArguments>();
  command->add_option("directory", arguments->directory, "where the files go")->required();
  command->add_option("--engines", arguments->engines, "names, separated by commas; all")
      ->delimiter(',');
  command->add_flag("--quick", arguments->quick, "20 orientations: the shape of things");
  command->add_option("--orientations", arguments->orientations, "500, quick 20");
  command->add_option("--seed", arguments->seed, "which stream of bodies and placements")
      ->capture_default_str();
  command->callback([arguments, &exit_code] { exit_code = RunFiguresCommand(*arguments); });
}

}  // namespace touchstone
