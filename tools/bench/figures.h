// SPDX-License-Identifier: MIT
//
// The numbers behind the figures, as CSV files in one folder; plot.py draws them.
#ifndef TOUCHSTONE_TOOLS_BENCH_FIGURES_H_
#define TOUCHSTONE_TOOLS_BENCH_FIGURES_H_

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "touchstone/tools/bench/convex_bench.h"

namespace touchstone {

struct FiguresOptions {
  std::string directory;
  std::vector<EngineDescription> engines;
  int orientations = 500;
  int repeats = 300;
  double seconds_per_row = 0.5;
  std::uint64_t seed = 1;
};

// figure8.csv and figure9.csv: the rows of mode repeat on ellipsoids 2:1:1 by n, and at n = 1000 by
// shape. Files without rows are not written. Returns whether all could be written.
bool WriteTimeFigures(const std::string& directory, std::span<const ConvexBenchRow> rows);

// Measures and writes figure8.csv, figure9.csv, figure10.csv (the published search by stage) and
// error-verdicts.csv (every engine at each of its tolerances, n = 100, from contact outward, bodies
// in general position and exactly parallel) and error-values.csv (exit travel, distance and depth
// against the exact ones). Returns whether all could be written.
bool MakeFigures(const FiguresOptions& options, const std::function<void(double)>& report);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_BENCH_FIGURES_H_
