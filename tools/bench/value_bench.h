// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_BENCH_VALUE_BENCH_H_
#define TOUCHSTONE_TOOLS_BENCH_VALUE_BENCH_H_

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "touchstone/tools/engines/engine.h"

namespace touchstone {

struct ValueBenchOptions {
  std::vector<EngineDescription> engines;  // each at all of its tolerances
  std::string shape = "ellipsoid-2";
  int n = 100;
  std::vector<double> sizes;  // of the gap: distances at +size, depths at -size, travels at both
  int orientations = 100;
  std::uint64_t seed = 1;
};

// How long an engine takes for a value, and how far the value is from the exact one.
struct ValueBenchRow {
  std::string engine;
  double tolerance = 0.0;
  bool has_tolerance = false;
  Quantity quantity = Quantity::kDistance;
  double gap = 0.0;
  double median_ns = 0.0;
  long queries = 0;
  long absent = 0;      // the engine gave none, or took the pair for one of the other kind
  long not_finite = 0;  // NaN or infinite
  // |value - exact| / |exact| over the finite ones; the exact value is rounded to a double, so that
  // 1.1e-16 is as good as none.
  double median_error = 0.0, greatest_error = 0.0;
};

// The exact values come from exact/: distance and exit travel at any size, depth by looking at all
// facets of M.
std::vector<ValueBenchRow> RunValueBench(const ValueBenchOptions& options,
                                         const std::function<void(double)>& report);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_BENCH_VALUE_BENCH_H_
