// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_BENCH_CONVEX_BENCH_H_
#define TOUCHSTONE_TOOLS_BENCH_CONVEX_BENCH_H_

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "touchstone/tools/engines/engine.h"

namespace touchstone {

enum class BenchMode {
  kRepeat,         // the same placed pair over and over: data and branches are learnt
  kMixed,          // a different pair every query, among more bodies than a cache holds
  kWarm,           // coherent motion by 0.1 degrees a frame, with the engine's own cache
  kWarmOneDegree,  // the same by 1 degree
};

std::string_view ToString(BenchMode mode);

// Which bodies are asked in which mode, at every gap.
struct ConvexBenchCell {
  std::string shape;
  int n = 0;  // vertices a body
  BenchMode mode = BenchMode::kRepeat;
};

struct ConvexBenchOptions {
  std::vector<EngineDescription> engines;  // each run at its best tolerance
  std::vector<ConvexBenchCell> cells;
  std::vector<double> gaps;
  int orientations = 500;  // kRepeat
  int repeats = 300;
  int mixed_pairs = 2048;
  // In all bodies of a mixed workload together: with all engines' copies several times what a
  // cache of 32 MB holds. Four times as many change nothing.
  int mixed_vertices = 1 << 16;
  int motions = 24;  // kWarm
  int frames = 64;
  // An engine that has taken so long for one gap of a cell is asked no more there: its row then
  // counts fewer queries.
  double seconds_per_row = 2.0;
  std::uint64_t seed = 1;
  std::string meshes_dir;
};

struct ConvexBenchRow {
  std::string engine, shape;
  int n = 0;
  double gap = 0.0;
  BenchMode mode = BenchMode::kRepeat;
  double median_ns = 0.0;
  long queries = 0;  // different placed pairs, each judged exactly
  long wrong = 0;    // by the engine's own convention for touch
  long undecided = 0;
};

// Times the engines on the same doubles in one thread. Engines take turns within a cell (shape, n,
// mode, gap): at each orientation, batch of pairs or motion, each runs a short batch, three times
// over, so that a busy machine disturbs all alike; a sample is the middle one of the three, and
// median_ns the median of the samples. Verdicts come from the exact half, outside the times.
// `report`, when given, is told the share of the cells done.
std::vector<ConvexBenchRow> RunConvexBench(const ConvexBenchOptions& options,
                                           const std::function<void(double)>& report);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_BENCH_CONVEX_BENCH_H_
