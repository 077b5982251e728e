// SPDX-License-Identifier: MIT
#include "touchstone/tools/touchstone/bench.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <system_error>

#include "touchstone/tools/engines/registry.h"
#include "touchstone/tools/touchstone/cpd.h"
#include "touchstone/tools/touchstone/subcommands.h"

namespace touchstone {

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
      if (!engine.single_precision && !engine.quadratic) selected.push_back(engine);
    } else {
      std::cerr << "touchstone: engine " << engine.name << " left out: " << engine.unavailable
                << '\n';
    }
  }
  return selected;
}

void PrepareFolder(const std::string& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (!std::filesystem::is_directory(path))
    throw BadInput{path + " is not a folder and cannot be made one"};
}

void PlotFigures(const std::string& directory) {
  const std::string command =
      "/usr/bin/python3 '" TOUCHSTONE_PLOT_SCRIPT "' '" + directory + "' >/dev/null 2>&1";
  if (std::system(command.c_str()) != 0) {
    throw BadInput{directory + ": no plots, for /usr/bin/python3 with matplotlib did not run " +
                   TOUCHSTONE_PLOT_SCRIPT + "; the CSV files are there"};
  }
}

void ShowProgress(double fraction) {
  std::cerr << "\r" << static_cast<int>(100.0 * fraction) << "% " << std::flush;
}

void AddBench(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("bench", "Time engines side by side");
  command->require_subcommand(1);
  AddBenchBoundary(*command, exit_code);
  AddBenchConvex(*command, exit_code);
  AddBenchCpd(*command, exit_code);
  AddBenchFigures(*command, exit_code);
  AddBenchMinkowski(*command, exit_code);
  AddBenchScene(*command, exit_code);
  AddBenchSupport(*command, exit_code);
}

}  // namespace touchstone
