// SPDX-License-Identifier: MIT
#include "touchstone/tools/bench/support_bench.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <span>
#include <utility>

#include "touchstone/core/base/vector_clones.h"
#include "touchstone/core/convex/hierarchical_support.h"
#include "touchstone/core/convex/support.h"
#include "touchstone/tools/bench/workload.h"
#include "touchstone/tools/engines/scan_support.h"
#include "touchstone/tools/suites/random.h"

namespace touchstone {
namespace {

using Clock = std::chrono::steady_clock;
using Eigen::Vector3d;

constexpr double kPi = 3.14159265358979323846;
// Batches last at least so long, so that reading the clock does not count.
constexpr double kLeastBatchNs = 200000.0;
// Rounding of a dot product relative to the body's extent: 3 products, 2 sums, generously.
constexpr double kRounding = 16.0 * std::numeric_limits<double>::epsilon();

volatile long sink;

// As a search has it: inlined where the widest vectors are allowed.
TOUCHSTONE_VECTOR_CLONES
int Look(const SupportTable& table, double x, double y, double z) {
  return table.vertex(table.Look(x, y, z));
}

// Answers all of `directions`; with `dependent`, each direction waits for the answer before.
using Pass = std::function<void(std::span<const Vector3d>, bool dependent, std::vector<int>*)>;

struct Method {
  std::string name;
  Pass pass;
  bool coherent = false;
};

template <class Find>
Pass MakePass(Find find) {
  return [find](std::span<const Vector3d> directions, bool dependent, std::vector<int>* answers) {
    int last = 0;
    long sum = 0;
    for (std::size_t i = 0; i < directions.size(); ++i) {
      Vector3d direction = directions[i];
      // Zero, but only the processor's arithmetic knows.
      if (dependent) direction[0] += 0.0 * last;
      last = find(direction, last);
      sum += last;
      if (answers != nullptr) (*answers)[i] = last;
    }
    sink = sum;
  };
}

std::vector<Method> MakeMethods(const ConvexPolyhedron& body, const ScanSupport& scan,
                                const HierarchicalSupport& hierarchy) {
  std::vector<Method> methods;
  methods.push_back({"scan, scalar", MakePass([&](const Vector3d& d, int) {
                       return SupportVertexByScan(body, d);
                     })});
  methods.push_back(
      {"scan, vector", MakePass([&](const Vector3d& d, int) { return scan.Find(d); })});
  methods.push_back({"table, one look", MakePass([&](const Vector3d& d, int) {
                       return Look(body.support_table(), d[0], d[1], d[2]);
                     })});
  methods.push_back({"table and climb",
                     MakePass([&](const Vector3d& d, int) { return SupportVertex(body, d); })});
  methods.push_back({"climb from vertex 0",
                     MakePass([&](const Vector3d& d, int) { return SupportVertex(body, d, 0); })});
  methods.push_back(
      {"climb from the last, 1 degree apart",
       MakePass([&](const Vector3d& d, int last) { return SupportVertex(body, d, last); }), true});
  methods.push_back({"hierarchy (Dobkin, Kirkpatrick)",
                     MakePass([&](const Vector3d& d, int) { return hierarchy.Find(d); })});
  return methods;
}

std::vector<Vector3d> RandomDirections(Random& random, int count) {
  std::vector<Vector3d> directions;
  for (int i = 0; i < count; ++i) directions.push_back(random.SpherePoint());
  return directions;
}

// Each a degree from the one before, turning about an axis that changes now and then.
std::vector<Vector3d> SlowDirections(Random& random, int count) {
  std::vector<Vector3d> directions = {random.SpherePoint()};
  Vector3d axis = random.SpherePoint();
  while (static_cast<int>(directions.size()) < count) {
    if (random.OneIn(64)) axis = random.SpherePoint();
    const Vector3d& last = directions.back();
    const Vector3d side = axis.cross(last).normalized();
    const double angle = kPi / 180.0;
    directions.push_back((std::cos(angle) * last + std::sin(angle) * side).normalized());
  }
  return directions;
}

double TimePass(const Pass& pass, std::span<const Vector3d> directions, bool dependent) {
  long queries = 0;
  double ns = 0.0;
  const Clock::time_point start = Clock::now();
  do {
    pass(directions, dependent, nullptr);
    queries += static_cast<long>(directions.size());
    ns = std::chrono::duration<double, std::nano>(Clock::now() - start).count();
  } while (ns < kLeastBatchNs);
  return ns / static_cast<double>(queries);
}

double LowerShare(const ConvexPolyhedron& body, const Pass& pass,
                  const std::vector<Vector3d>& directions) {
  std::vector<int> answers(directions.size());
  pass(directions, false, &answers);
  long lower = 0;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const int highest = SupportVertexByScan(body, directions[i]);
    const double loss = directions[i].dot(body.vertex(highest) - body.vertex(answers[i]));
    if (loss > kRounding * body.max_coordinate()) ++lower;
  }
  return static_cast<double>(lower) / static_cast<double>(directions.size());
}

void RunCase(const SupportBenchOptions& options, const SupportBenchCase& test,
             std::vector<SupportBenchRow>* rows) {
  const Workload workload = MakeRepeatWorkload({test.shape, test.n, options.seed, ""}, 0);
  const ConvexPolyhedron& body = workload.bodies[0];
  const ScanSupport scan(body);
  const HierarchicalSupport hierarchy(body);
  Random random("support_bench", options.seed, static_cast<std::uint64_t>(test.n));
  // Scans of large bodies need fewer directions for the same precision.
  const int count = std::clamp(40000000 / body.vertex_count(), 64, options.directions);
  const std::vector<Vector3d> spread = RandomDirections(random, count);
  const std::vector<Vector3d> slow = SlowDirections(random, count);
  const std::vector<Method> methods = MakeMethods(body, scan, hierarchy);
  std::vector<std::vector<double>> independent(methods.size()), dependent(methods.size());
  for (int turn = 0; turn < options.turns; ++turn) {
    for (std::size_t m = 0; m < methods.size(); ++m) {
      const std::vector<Vector3d>& directions = methods[m].coherent ? slow : spread;
      independent[m].push_back(TimePass(methods[m].pass, directions, false));
      dependent[m].push_back(TimePass(methods[m].pass, directions, true));
    }
  }
  for (std::size_t m = 0; m < methods.size(); ++m) {
    rows->push_back({test.shape, body.vertex_count(), methods[m].name,
                     *std::min_element(independent[m].begin(), independent[m].end()),
                     *std::min_element(dependent[m].begin(), dependent[m].end()),
                     LowerShare(body, methods[m].pass, methods[m].coherent ? slow : spread)});
  }
}

}  // namespace

std::vector<SupportBenchRow> RunSupportBench(const SupportBenchOptions& options) {
  std::vector<SupportBenchRow> rows;
  for (const SupportBenchCase& test : options.cases) RunCase(options, test, &rows);
  return rows;
}

}  // namespace touchstone
