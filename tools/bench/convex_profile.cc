// SPDX-License-Identifier: MIT
#include "touchstone/tools/bench/convex_profile.h"

#include <algorithm>
#include <chrono>
#include <limits>

#include "touchstone/core/cd_dual/cd_dual.h"
#include "touchstone/core/proximity/penetration_depth.h"
#include "touchstone/tools/bench/times.h"
#include "touchstone/tools/bench/workload.h"

namespace touchstone {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kTimesEach = 7;
constexpr int kBuilds = 5;
const CollideOptions kVerdictOnly{.early_exit = true};
// Keeps the compiler from leaving out a query whose answer is not used.
volatile int sink;

double NsSince(Clock::time_point start) {
  return std::chrono::duration<double, std::nano>(Clock::now() - start).count();
}

// What reading the clock twice costs, to be taken off a time so short.
double ClockNs() {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 1000; ++i) least = std::min(least, NsSince(Clock::now()));
  return least;
}

ColdTail MeasureTail(const Workload& workload, int n, double gap, double clock_ns) {
  std::vector<double> times;
  for (const BenchLine& line : workload.lines) {
    const RelativePose pose = PoseAtTravel(line.line, gap);
    const ConvexPolyhedron& p = workload.bodies[line.p];
    const ConvexPolyhedron& q = workload.bodies[line.q];
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < kTimesEach; ++i) {
      const Clock::time_point start = Clock::now();
      sink = static_cast<int>(Collide(p, q, pose, kVerdictOnly).verdict);
      least = std::min(least, NsSince(start));
    }
    times.push_back(std::max(0.0, least - clock_ns));
  }
  return {n, gap, Quantile(times, 0.5), Quantile(times, 0.999), static_cast<long>(times.size())};
}

void CountTiers(const Workload& workload, double relative_gap, HeapMeter heap, TierCounts* counts,
                ConvexProfile* profile) {
  for (const BenchLine& line : workload.lines) {
    for (const double side : {-1.0, 1.0}) {
      const RelativePose pose = PoseAtTravel(line.line, side * relative_gap * line.line.size);
      const long before = heap != nullptr ? heap().allocations : 0;
      const CollideResult result =
          Collide(workload.bodies[line.p], workload.bodies[line.q], pose, kVerdictOnly);
      const bool allocated = heap != nullptr && heap().allocations != before;
      const bool exact = result.tier == Tier::kExact;
      ++counts->queries;
      counts->bound += result.tier == Tier::kBound ? 1 : 0;
      counts->scan += result.tier == Tier::kScan ? 1 : 0;
      counts->exact += exact ? 1 : 0;
      if (allocated) ++(exact ? profile->allocating_in_exact : profile->allocating_in_doubles);
    }
  }
}

BodyCost MeasureBody(const std::string& shape, int n, std::uint64_t seed, HeapMeter heap) {
  const Workload workload = MakeRepeatWorkload({shape, n, seed, ""}, 0);
  const ConvexPolyhedron& body = workload.bodies[0];
  std::vector<std::vector<int>> faces;
  for (int f = 0; f < body.face_count(); ++f)
    faces.emplace_back(body.face(f).begin(), body.face(f).end());
  BodyCost cost{shape, n, 0.0, std::numeric_limits<double>::infinity()};
  for (int i = 0; i < kBuilds; ++i) {
    const long before = heap != nullptr ? heap().bytes : 0;
    const Clock::time_point start = Clock::now();
    const StatusOr<ConvexPolyhedron> built = ConvexPolyhedron::Build(body.vertices(), faces);
    const double us = NsSince(start) / 1000.0;
    const long bytes = heap != nullptr ? heap().bytes - before : 0;
    cost.bytes_per_vertex = static_cast<double>(bytes) / body.vertex_count();
    cost.build_us_per_vertex = std::min(cost.build_us_per_vertex, us / body.vertex_count());
  }
  return cost;
}

DepthCost MeasureDepth(int n, double gap, std::uint64_t seed, double clock_ns) {
  constexpr int kMotions = 12, kFrames = 32;
  const Workload workload = MakeWarmWorkload({"ellipsoid-2", n, seed, ""}, kMotions, kFrames, 0.1);
  PenetrationCache cold_cache, warm_cache;
  const auto time = [&](const BenchLine& line, PenetrationCache* cache) {
    const RelativePose pose = PoseAtTravel(line.line, gap);
    const Clock::time_point start = Clock::now();
    sink = static_cast<int>(
        PenetrationDepth(workload.bodies[line.p], workload.bodies[line.q], pose, {}, cache)
            .verdict);
    return NsSince(start) - clock_ns;
  };
  std::vector<double> cold, warm;
  for (std::size_t i = 0; i < workload.lines.size(); ++i) {
    const bool first = i % kFrames == 0;
    if (first) warm_cache.Clear();
    const double ns = time(workload.lines[i], &warm_cache);
    if (!first) warm.push_back(ns);
    cold_cache.Clear();
    cold.push_back(time(workload.lines[i], &cold_cache));
  }
  return {n, gap, Quantile(cold, 0.5), Quantile(warm, 0.5)};
}

}  // namespace

ConvexProfile RunConvexProfile(const ConvexProfileOptions& options,
                               const std::function<void(double)>& report) {
  ConvexProfile profile;
  if (options.heap != nullptr) profile.allocating_in_doubles = profile.allocating_in_exact = 0;
  const double clock_ns = ClockNs();
  double done = 0.0;
  for (const int n : options.sizes) {
    if (report) report(done++ / static_cast<double>(options.sizes.size()));
    const Workload workload =
        MakeRepeatWorkload({"ellipsoid-2", n, options.seed, ""}, options.orientations);
    for (const double gap : options.gaps)
      profile.tails.push_back(MeasureTail(workload, n, gap, clock_ns));
    for (const double relative_gap : options.relative_gaps) {
      TierCounts& counts = profile.tiers.emplace_back();
      counts.n = n;
      counts.relative_gap = relative_gap;
      CountTiers(workload, relative_gap, options.heap, &counts, &profile);
    }
    for (const char* shape : {"ellipsoid-2", "prism", "grid"})
      profile.bodies.push_back(MeasureBody(shape, n, options.seed, options.heap));
  }
  for (const double gap : {-50.0, -5.0, -1e-6})
    profile.depths.push_back(MeasureDepth(100, gap, options.seed, clock_ns));
  return profile;
}

}  // namespace touchstone
