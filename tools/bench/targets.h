// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_BENCH_TARGETS_H_
#define TOUCHSTONE_TOOLS_BENCH_TARGETS_H_

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "touchstone/tools/bench/convex_bench.h"
#include "touchstone/tools/bench/convex_profile.h"

namespace touchstone {

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
// medians within a cell; "best other" is the fastest of libccd MPR (with a scan and with our
// support), FCL on libccd and Bullet, of those without a wrong verdict in these rows.
std::vector<Target> CompareWithTargets(std::span<const ConvexBenchRow> rows,
                                       const ConvexProfile* profile,
                                       const InstructionSets* instruction_sets);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_BENCH_TARGETS_H_
