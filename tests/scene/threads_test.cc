// SPDX-License-Identifier: MIT
//
// Any number of threads says what one says, to the last bit, in worlds of enough pairs that every
// loop of a step is shared. Under the thread sanitizer (CMake preset tsan) these are the races that
// could be.
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <mutex>
#include <set>
#include <thread>
#include <vector>

#ifdef TOUCHSTONE_TEST_HAS_TBB
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>
#endif

#include "touchstone/core/base/parallel.h"
#include "touchstone/core/scene/scene.h"
#include "touchstone/tests/scene/worlds.h"

namespace touchstone::testing {
namespace {

// As many as there are processors, or more: so many as told.
template <class Call>
void WithThreads(int count, const Call& call) {
#ifdef TOUCHSTONE_TEST_HAS_TBB
  using oneapi::tbb::global_control;
  const global_control most(global_control::max_allowed_parallelism, count);
  oneapi::tbb::task_arena(count).execute(call);
#else
  static_cast<void>(count);
  call();
#endif
}

// Each range waits for another thread to come, for a while.
TEST(Threads, MoreThanOneWork) {
  if (!HasThreads()) GTEST_SKIP() << "built without oneTBB";
  std::mutex mutex;
  std::set<std::thread::id> seen;
  std::atomic<int> count = 0;
  WithThreads(3, [&] {
    ForRanges(64, 1, Threads::kAll, [&](std::size_t, std::size_t) {
      {
        const std::lock_guard lock(mutex);
        seen.insert(std::this_thread::get_id());
        count = static_cast<int>(seen.size());
      }
      const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(2);
      while (count < 2 && std::chrono::steady_clock::now() < until) std::this_thread::yield();
    });
  });
  EXPECT_GE(seen.size(), 2u);
}

// A number of each kind as one line of doubles.
template <class Number>
std::array<double, 4> LineOf(const Number& number, double value, const Eigen::Vector3d& v) {
  const double parts = 1e3 * number.bodies.a.slot + number.bodies.b.slot + 1e-2 * number.part_a +
                       1e-4 * number.part_b;
  return {parts, value, v[0] + 1e3 * v[1], v[2]};
}

// All that a step tells.
struct Told {
  std::vector<SceneEvent> events;
  std::vector<std::array<double, 4>> numbers;
  std::array<long, 8> counts;
  friend bool operator==(const Told&, const Told&) = default;
};

Told ToldBy(const SceneStep& step) {
  Told told{{step.events.begin(), step.events.end()}, {}, {}};
  const auto add = [&](const auto& numbers, const auto& value, const auto& vector) {
    for (const auto& n : numbers) {
      told.numbers.push_back(LineOf(n, value(n.result), vector(n.result)));
    }
  };
  add(
      step.distances, [](const auto& r) { return r.distance.value; },
      [](const auto& r) { return r.direction; });
  add(
      step.mesh_distances, [](const auto& r) { return r.distance; },
      [](const auto& r) { return r.direction; });
  add(
      step.depths, [](const auto& r) { return r.depth.value; },
      [](const auto& r) { return r.translation; });
  add(
      step.mesh_depths, [](const auto& r) { return r.upper_bound; },
      [](const auto& r) { return r.translation; });
  add(
      step.continuous_depths, [](const auto& r) { return r.translation.norm(); },
      [](const auto& r) { return r.translation; });
  add(
      step.travels, [](const auto& r) { return r.enter.travel.value; },
      [](const auto&) -> Eigen::Vector3d { return Eigen::Vector3d::Zero(); });
  add(
      step.mesh_travels, [](const auto& r) { return r.travel; },
      [](const auto& r) { return r.normal; });
  const SceneCounters& c = step.counters;
  told.counts = {c.pairs,    c.by_rest, c.by_margin,    c.looked_at,
                 c.by_guess, c.queries, c.meshes_apart, c.numbers_kept};
  return told;
}

struct Crowd {
  std::vector<SceneShape> shapes;  // not asked anything before: what they make on demand is made
                                   // by whoever comes first
  std::vector<WorldPose> poses;
  std::vector<Subscriptions> wanted;
};

// So dense that a body has some sixty neighbours. Some bodies want numbers.
Crowd MakeCrowd(std::uint64_t seed, bool with_meshes) {
  Random random(seed);
  Crowd crowd;
  const std::vector<SceneShape> shapes = MixedShapes(with_meshes);
  const int count = with_meshes ? 90 : 420;
  const double extent = with_meshes ? 2.6 : 4.0;
  for (int i = 0; i < count; ++i) {
    crowd.shapes.push_back(shapes[i % shapes.size()]);
    crowd.poses.push_back(RandomPose(random, extent));
    Subscriptions& wanted = crowd.wanted.emplace_back();
    if (i % 9 == 0) wanted.distance = 0.1;
    if (i % 17 == 0 && !with_meshes) wanted.depth = true;
    if (i % 23 == 0) wanted.travel = Subscriptions::Travel{{0.3, -0.2, 1.0}, 0.5};
  }
  return crowd;
}

// The crowd at rest, nudged, in part and altogether, and some of it replaced.
std::vector<Told> Walk(const Crowd& crowd, const SceneOptions& options, int steps,
                       std::uint64_t seed) {
  Random random(seed);
  Scene scene(options);
  std::vector<BodyHandle> bodies;
  for (std::size_t i = 0; i < crowd.shapes.size(); ++i) {
    bodies.push_back(*scene.Add(crowd.shapes[i], crowd.poses[i], crowd.wanted[i]));
  }
  std::vector<Told> told = {ToldBy(scene.Step())};
  for (int step = 1; step < steps; ++step) {
    for (BodyHandle& body : bodies) {
      const WorldPose pose = Nudged(random, scene.pose(body), 0.02, 0.02);
      if (random.Int(0, 3) < step % 4) {
        EXPECT_TRUE(scene.Move(body, pose).ok());
      }
      if (random.Int(0, 99) != 0) continue;
      const SceneShape shape = scene.shape(body);
      EXPECT_TRUE(scene.Remove(body).ok());
      body = *scene.Add(shape, pose);
    }
    told.push_back(ToldBy(scene.Step()));
  }
  return told;
}

void ExpectSameForAnyThreads(bool with_meshes, int steps, std::size_t least_pairs,
                             std::size_t least_numbers) {
  std::printf("seed 41\n");
  SceneOptions one, all;
  all.threads = Threads::kAll;
  std::vector<Told> expected = Walk(MakeCrowd(41, with_meshes), one, steps, 42);
  std::size_t numbers = 0, events = 0;
  for (const Told& told : expected) numbers += told.numbers.size(), events += told.events.size();
  std::printf("%ld pairs, %zu events, %zu numbers\n", expected[0].counts[0], events, numbers);
  EXPECT_GT(expected[0].counts[0], static_cast<long>(least_pairs));
  EXPECT_GT(numbers, least_numbers);
  for (const int threads : {1, 2, 3, 8}) {
    std::vector<Told> told;
    WithThreads(threads, [&] { told = Walk(MakeCrowd(41, with_meshes), all, steps, 42); });
    EXPECT_TRUE(told == expected) << threads << " threads";
  }
}

// More than two chunks of the scan for pairs that are due.
TEST(Threads, ConvexBodies) { ExpectSameForAnyThreads(false, 8, 2 * 4096, 500); }
TEST(Threads, MeshesToo) { ExpectSameForAnyThreads(true, 5, 500, 100); }

}  // namespace
}  // namespace touchstone::testing
