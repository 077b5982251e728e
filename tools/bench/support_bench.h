// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_BENCH_SUPPORT_BENCH_H_
#define TOUCHSTONE_TOOLS_BENCH_SUPPORT_BENCH_H_

#include <cstdint>
#include <string>
#include <vector>

namespace touchstone {

struct SupportBenchCase {
  std::string shape;  // of bench/workload.h
  int n = 0;
};

struct SupportBenchOptions {
  std::vector<SupportBenchCase> cases;
  int directions = 4096;  // more than a branch predictor learns
  int turns = 15;         // each method is timed so often, in turn; the least counts
  std::uint64_t seed = 1;
};

// The time of one support query by one method.
struct SupportBenchRow {
  std::string shape;
  int n = 0;  // vertices
  std::string method;
  double independent_ns = 0.0;  // directions known beforehand
  double dependent_ns = 0.0;    // each direction waits for the answer before
  double lower = 0.0;  // share of answers lower than the highest vertex by more than rounding
};

// Random directions, but for "climb from the last, 1 degree apart", whose directions turn slowly.
std::vector<SupportBenchRow> RunSupportBench(const SupportBenchOptions& options);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_BENCH_SUPPORT_BENCH_H_
