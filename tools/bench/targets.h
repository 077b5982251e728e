// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_BENCH_TARGETS_H_
#define TOUCHSTONE_TOOLS_BENCH_TARGETS_H_

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "touchstone/tools/bench/convex_bench.h"
#include "touchstone/tools/bench/convex_profile.h"

namespace touchstone {

// Our engine that the targets are about.
inline constexpr std::string_view kDefaultEngine = "portal";

struct RowKey {
  std::string_view engine, shape;
  int n = 0;
  double gap = 0.0;
  BenchMode mode = BenchMode::kRepeat;
};
// The row, or null where nothing was timed.
const ConvexBenchRow* FindRow(std::span<const ConvexBenchRow> rows, const RowKey& key);

// The fastest there of libccd MPR (with a scan and with our support), FCL on libccd and Bullet, of
// those without a wrong verdict anywhere in these rows; or null.
const ConvexBenchRow* FindBestOther(std::span<const ConvexBenchRow> rows, std::string_view shape,
                                    int n, double gap, BenchMode mode);

// A number that the project set itself, and what this run measured.
struct Target {
  std::string measure, target, measured;
  bool met = false;
};

// The same queries timed by this program and by the one whose vector code stops at AVX2.
struct InstructionSets {
  std::vector<ConvexBenchRow> all, avx2;
};

// The targets that the rows allow to compute, and the others where they are given. Ratios are of
// medians within a cell.
std::vector<Target> CompareWithTargets(std::span<const ConvexBenchRow> rows,
                                       const ConvexProfile* profile,
                                       const InstructionSets* instruction_sets);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_BENCH_TARGETS_H_
