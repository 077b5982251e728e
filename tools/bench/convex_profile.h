// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_BENCH_CONVEX_PROFILE_H_
#define TOUCHSTONE_TOOLS_BENCH_CONVEX_PROFILE_H_

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "touchstone/tools/bench/heap_use.h"

namespace touchstone {

// What our default query costs besides its median, and what it rests on. Ellipsoids 2:1:1 unless a
// shape is named; the size is the largest coordinate of the bodies.

// How the time of one cold verdict spreads over queries: each is timed alone, the least of several
// times, so that what spreads is the query and not the machine.
struct ColdTail {
  int n = 0;
  double gap = 0.0;
  double median_ns = 0.0, p999_ns = 0.0;
  long queries = 0;
};

// Which arithmetic decided, at a gap of this part of the size, on either side of contact.
struct TierCounts {
  int n = 0;
  double relative_gap = 0.0;
  long queries = 0, bound = 0, scan = 0, exact = 0;
};

struct BodyCost {
  std::string shape;
  int n = 0;
  double bytes_per_vertex = 0.0;  // 0 without a heap meter
  double build_us_per_vertex = 0.0;
};

// Exact penetration depth of an overlapping pair: cold with memory at hand but nothing known, and
// in coherent motion by 0.1 degrees a frame.
struct DepthCost {
  int n = 0;
  double gap = 0.0;
  double cold_ns = 0.0, warm_ns = 0.0;  // medians
};

struct ConvexProfile {
  std::vector<ColdTail> tails;
  std::vector<TierCounts> tiers;
  std::vector<BodyCost> bodies;
  std::vector<DepthCost> depths;
  // Queries that took memory from the heap, of those in `tiers`, by tier; -1 without a heap meter.
  long allocating_in_doubles = -1;
  long allocating_in_exact = -1;
};

struct ConvexProfileOptions {
  std::vector<int> sizes;
  std::vector<double> gaps;
  std::vector<double> relative_gaps;
  int orientations = 1000;
  std::uint64_t seed = 1;
  HeapMeter heap = nullptr;
};

ConvexProfile RunConvexProfile(const ConvexProfileOptions& options,
                               const std::function<void(double)>& report);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_BENCH_CONVEX_PROFILE_H_
