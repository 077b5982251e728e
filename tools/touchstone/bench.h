// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_TOUCHSTONE_BENCH_H_
#define TOUCHSTONE_TOOLS_TOUCHSTONE_BENCH_H_

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "touchstone/tools/engines/engine.h"

namespace touchstone {

// The engines of these names, or all in double precision that can run; says on stderr which cannot.
// Throws BadInput for a name that there is not, or that cannot run.
std::vector<EngineDescription> SelectEngines(const std::vector<std::string>& names);

// Makes the folder where there is none. Throws BadInput when it cannot.
void PrepareFolder(const std::string& path);
// Draws the CSV files in a folder by tools/bench/plot.py. Throws BadInput where Python or
// matplotlib is missing: the CSV files are there all the same.
void PlotFigures(const std::string& directory);
// On a terminal's standard error.
void ShowProgress(double fraction);

// What can be timed: one subcommand of `bench` a file.
void AddBenchBoundary(CLI::App& bench, int& exit_code);
void AddBenchConvex(CLI::App& bench, int& exit_code);
void AddBenchFigures(CLI::App& bench, int& exit_code);
void AddBenchMinkowski(CLI::App& bench, int& exit_code);
void AddBenchScene(CLI::App& bench, int& exit_code);
void AddBenchSupport(CLI::App& bench, int& exit_code);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_TOUCHSTONE_BENCH_H_
