// SPDX-License-Identifier: MIT
//
// Skipping changes nothing: scenes under all rules, under each rule missing, under none, and on any
// number of threads say the same in every step, and it is what Collide and Membership say.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "touchstone/core/scene/scene.h"
#include "touchstone/tests/scene/worlds.h"

namespace touchstone::testing {
namespace {

using Eigen::Vector3d;

struct NamedOptions {
  std::string name;
  SceneOptions options;
};

SceneOptions With(void (*change)(SceneRules&), Threads threads = Threads::kOne) {
  SceneOptions options;
  change(options.rules);
  options.threads = threads;
  return options;
}

// Exact signs from the start cost a hundred times as much: asked for apart.
SceneRules NoneInDoubles() {
  SceneRules rules = SceneRules::None();
  rules.doubles_first = true;
  return rules;
}

std::vector<NamedOptions> AllOptions() {
  return {{"none", {NoneInDoubles(), Threads::kOne}},
          {"all", {}},
          {"all, threads", With([](SceneRules&) {}, Threads::kAll)},
          {"sweep", With([](SceneRules& r) { r.broad_phase = BroadPhase::kSweep; })},
          {"all pairs", With([](SceneRules& r) { r.broad_phase = BroadPhase::kAllPairs; })},
          {"no margins", With([](SceneRules& r) { r.margins = false; })},
          {"no rest", With([](SceneRules& r) { r.rest = false; })},
          {"no balls", With([](SceneRules& r) { r.balls = false; })},
          {"no guesses", With([](SceneRules& r) { r.guesses = false; })},
          {"no lazy meshes", With([](SceneRules& r) { r.lazy_meshes = false; })},
          {"not verdict alone", With([](SceneRules& r) { r.verdict_alone = false; })},
          {"margins alone", With([](SceneRules& r) {
             r = NoneInDoubles();
             r.margins = true;
           })},
          {"none, threads", {NoneInDoubles(), Threads::kAll}}};
}

struct Bounds {
  double lower, upper;
};
Bounds BoundsOf(const BoundedValue& x) { return {x.value - x.error, x.value + x.error}; }
template <class Result>
Bounds ClaimedBounds(const Result& result) {
  return {result.lower_bound, result.upper_bound};
}

// The same world in scenes of different rules.
class Worlds {
 public:
  explicit Worlds(const std::vector<NamedOptions>& all) {
    for (const NamedOptions& named : all) {
      names_.push_back(named.name);
      scenes_.emplace_back(named.options);
    }
  }

  template <class Call>
  auto ForAll(Call call) {
    for (std::size_t i = 1; i < scenes_.size(); ++i) call(scenes_[i]);
    return call(scenes_[0]);
  }

  // Steps all and compares them with the first.
  SceneStep Step() {
    const SceneStep first = scenes_[0].Step();
    for (std::size_t i = 1; i < scenes_.size(); ++i) {
      SCOPED_TRACE(names_[i]);
      const SceneStep other = scenes_[i].Step();
      ExpectEqualEvents(first, other);
      ExpectSameNumbers(first.distances, other.distances,
                        [](const DistanceResult& r) { return BoundsOf(r.distance); });
      ExpectSameNumbers(first.mesh_distances, other.mesh_distances,
                        ClaimedBounds<SurfaceDistanceResult>);
      ExpectSameNumbers(first.depths, other.depths,
                        [](const PenetrationResult& r) { return BoundsOf(r.depth); });
      ExpectSameNumbers(first.mesh_depths, other.mesh_depths, ClaimedBounds<MeshDepthResult>);
      ExpectSameNumbers(first.travels, other.travels,
                        [](const DirectionalResult& r) { return BoundsOf(r.enter.travel); });
      ExpectSameNumbers(first.mesh_travels, other.mesh_travels, ClaimedBounds<SurfaceTravelResult>);
      ExpectSameMotion(first.continuous_depths, other.continuous_depths);
      totals_.resize(scenes_.size());
      totals_[i].Add(other.counters);
    }
    return first;
  }

  Scene& scene(std::size_t i) { return scenes_[i]; }
  const SceneCounters& totals(std::size_t i) const { return totals_[i]; }

 private:
  static void ExpectEqualEvents(const SceneStep& first, const SceneStep& other) {
    ASSERT_EQ(first.events.size(), other.events.size());
    for (std::size_t k = 0; k < first.events.size(); ++k) {
      ASSERT_EQ(first.events[k], other.events[k])
          << first.events[k].bodies.a.slot << ' ' << first.events[k].bodies.b.slot << ' '
          << ToString(first.events[k].kind) << ' ' << ToString(other.events[k].kind) << ' '
          << ToString(first.events[k].verdict) << ' ' << ToString(other.events[k].verdict);
    }
  }

  template <class Number>
  static void ExpectSameQuestions(std::span<const Number> first, std::span<const Number> other) {
    ASSERT_EQ(first.size(), other.size());
    for (std::size_t k = 0; k < first.size(); ++k) {
      ASSERT_EQ(first[k].bodies, other[k].bodies);
      ASSERT_EQ(first[k].part_a, other[k].part_a);
      ASSERT_EQ(first[k].part_b, other[k].part_b);
    }
  }

  // The same questions answered, and answers whose bounds agree.
  template <class Number, class BoundsOfResult>
  static void ExpectSameNumbers(std::span<const Number> first, std::span<const Number> other,
                                BoundsOfResult bounds_of) {
    ASSERT_NO_FATAL_FAILURE(ExpectSameQuestions(first, other));
    for (std::size_t k = 0; k < first.size(); ++k) {
      const Bounds x = bounds_of(first[k].result), y = bounds_of(other[k].result);
      ASSERT_LE(x.lower, y.upper);
      ASSERT_LE(y.lower, x.upper);
    }
  }

  // Continuous depths follow the motion alone: the same to the last bit.
  static void ExpectSameMotion(std::span<const SceneNumber<ContinuousDepthResult>> first,
                               std::span<const SceneNumber<ContinuousDepthResult>> other) {
    ASSERT_NO_FATAL_FAILURE(ExpectSameQuestions(first, other));
    for (std::size_t k = 0; k < first.size(); ++k) {
      ASSERT_EQ(first[k].result.translation, other[k].result.translation);
      ASSERT_EQ(first[k].result.status, other[k].result.status);
      ASSERT_EQ(first[k].result.branch, other[k].result.branch);
    }
  }

  std::vector<std::string> names_;
  std::vector<Scene> scenes_;
  std::vector<SceneCounters> totals_;
};

struct Walk {
  double extent;  // of the world
  double step, angle;
  int one_in_rests, one_in_teleports, one_in_swaps;
};

// Bodies that nudge, rest, teleport, come and go; every verdict also held against Collide and
// Membership now and then.
void RunWalk(const std::vector<NamedOptions>& options, const std::vector<SceneShape>& shapes,
             int body_count, int steps, const Walk& walk, std::uint64_t seed) {
  std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
  Random random(seed);
  Worlds worlds(options);
  std::vector<BodyHandle> bodies;
  const auto add = [&] {
    const SceneShape& shape = shapes[random.Int(0, static_cast<int>(shapes.size()) - 1)];
    const WorldPose pose = RandomPose(random, walk.extent);
    bodies.push_back(worlds.ForAll([&](Scene& scene) { return *scene.Add(shape, pose); }));
  };
  for (int i = 0; i < body_count; ++i) add();
  long begins = 0, ends = 0, persists = 0;
  for (int step = 0; step < steps; ++step) {
    const bool all_rest = random.Int(0, 19) == 0;
    for (const BodyHandle body : bodies) {
      if (all_rest || random.Int(1, walk.one_in_rests) == 1) continue;
      const WorldPose& pose = worlds.scene(0).pose(body);
      WorldPose next = random.Int(1, walk.one_in_teleports) == 1
                           ? RandomPose(random, walk.extent)
                           : Nudged(random, pose, walk.step, walk.angle);
      for (int axis = 0; axis < 3; ++axis) {
        next.translation[axis] = std::clamp(next.translation[axis], -walk.extent, walk.extent);
      }
      worlds.ForAll([&](Scene& scene) {
        EXPECT_TRUE(scene.Move(body, next).ok());
        return 0;
      });
    }
    if (random.Int(1, walk.one_in_swaps) == 1) {
      const int gone = random.Int(0, static_cast<int>(bodies.size()) - 1);
      worlds.ForAll([&](Scene& scene) {
        EXPECT_TRUE(scene.Remove(bodies[gone]).ok());
        return 0;
      });
      bodies.erase(bodies.begin() + gone);
      add();
    }
    const SceneStep found = worlds.Step();
    if (::testing::Test::HasFatalFailure()) FAIL() << "step " << step;
    for (const SceneEvent& event : found.events) {
      begins += event.kind == EventKind::kBegin;
      ends += event.kind == EventKind::kEnd;
      persists += event.kind == EventKind::kPersist;
    }
    if (step % 50 != 0) continue;
    const Scene& scene = worlds.scene(0);
    for (const BodyHandle a : bodies) {
      for (const BodyHandle b : bodies) {
        if (a.slot >= b.slot) continue;
        ASSERT_EQ(scene.verdict(a, b),
                  VerdictOf(scene.shape(a), scene.pose(a), scene.shape(b), scene.pose(b)));
      }
    }
  }
  EXPECT_GT(begins, steps / 50);
  EXPECT_GT(ends, steps / 50);
  EXPECT_GT(persists, steps / 10);
  for (std::size_t i = 1; i < options.size(); ++i) {
    const SceneCounters& c = worlds.totals(i);
    std::printf(
        "%-18s looked %8ld rest %8ld margin %8ld box %7ld balls %7ld guess %7ld queries %7ld"
        " exact %6ld apart %5ld placed %5ld\n",
        options[i].name.c_str(), c.looked_at, c.by_rest, c.by_margin, c.by_box, c.by_balls,
        c.by_guess, c.queries, c.exact_queries, c.meshes_apart, c.meshes_placed);
  }
}

TEST(Rules, TenThousandStepsOfConvexBodies) {
  const std::vector<NamedOptions> all = AllOptions();
  RunWalk({all[0], all[1]}, MixedShapes(false), 12, 10000, {3.0, 0.02, 0.02, 4, 400, 200}, 1);
}

TEST(Rules, EachOneOffIsIdentical) {
  RunWalk(AllOptions(), MixedShapes(false), 10, 1000, {3.0, 0.03, 0.03, 4, 100, 60}, 2);
}

TEST(Rules, EachOneOffIsIdenticalWithMeshes) {
  RunWalk(AllOptions(), MixedShapes(true), 9, 150, {2.5, 0.03, 0.03, 4, 60, 40}, 3);
}

TEST(Rules, FastBodies) {
  RunWalk(AllOptions(), MixedShapes(false), 12, 300, {5.0, 2.0, 3.0, 6, 20, 20}, 4);
}

TEST(Rules, ExactFromTheStart) {
  const std::vector<NamedOptions> all = AllOptions();
  RunWalk({{"none", {SceneRules::None(), Threads::kOne}}, all[1]}, MixedShapes(false), 6, 150,
          {2.0, 0.05, 0.05, 4, 50, 40}, 5);
}

// Cubes on a lattice, moved by whole and half steps: touches of faces, edges and vertices in every
// step, exactly, and poses that come back.
TEST(Rules, TouchesOnALattice) {
  std::printf("seed 6\n");
  Random random(6);
  Worlds worlds(AllOptions());
  const std::vector<SceneShape> shapes = {BoxShape({1, 1, 1}), BoxShape({0.5, 0.5, 2}),
                                          CrossShape(), MeshShape("u", 0, 1.0)};
  std::vector<BodyHandle> bodies;
  const auto place = [&] {
    return At({0.5 * random.Int(-8, 8), 0.5 * random.Int(-8, 8), 0.5 * random.Int(-4, 4)});
  };
  for (int i = 0; i < 14; ++i) {
    const SceneShape& shape = shapes[i % shapes.size()];
    const WorldPose pose = place();
    bodies.push_back(worlds.ForAll([&](Scene& scene) { return *scene.Add(shape, pose); }));
  }
  long touches = 0;
  for (int step = 0; step < 100; ++step) {
    for (const BodyHandle body : bodies) {
      if (random.Int(0, 2) != 0) continue;
      WorldPose pose = worlds.scene(0).pose(body);
      if (random.Int(0, 9) == 0) {
        pose = place();
      } else {
        pose.translation[random.Int(0, 2)] += random.Int(0, 1) == 0 ? 0.5 : -0.5;
      }
      // One ulp off the touch, at times.
      if (random.Int(0, 5) == 0) {
        pose.translation[0] = std::nextafter(pose.translation[0], random.Uniform(-9, 9));
      }
      worlds.ForAll([&](Scene& scene) { return scene.Move(body, pose).ok(); });
    }
    const SceneStep found = worlds.Step();
    if (HasFatalFailure()) FAIL() << "step " << step;
    for (const SceneEvent& event : found.events) touches += event.verdict == Verdict::kTouch;
  }
  EXPECT_GT(touches, 250);  // measured 315
}

// A pair whose numbers are wanted from afar, and no verdict.
void SubscribeFarPair(Worlds& worlds, BodyHandle a, BodyHandle b) {
  Subscriptions pair;
  pair.verdict = false;
  pair.distance = 100.0;
  pair.travel = Subscriptions::Travel{{1, 0, 0}, 50.0};
  worlds.ForAll([&](Scene& scene) { return scene.SubscribePair(a, b, pair).ok(); });
}

// Three of four bodies a little, one of sixty to anywhere within `extent`.
void MoveMost(Random& random, Worlds& worlds, const std::vector<BodyHandle>& bodies,
              double extent) {
  for (const BodyHandle body : bodies) {
    if (random.Int(0, 3) == 0) continue;
    const WorldPose pose = random.Int(0, 60) == 0
                               ? RandomPose(random, extent)
                               : Nudged(random, worlds.scene(0).pose(body), 0.03, 0.03);
    worlds.ForAll([&](Scene& scene) { return scene.Move(body, pose).ok(); });
  }
}

// Distances, depths and travels beside verdicts, by body and by pair.
TEST(Rules, NumbersStayWithinTheirBounds) {
  std::printf("seed 7\n");
  Random random(7);
  std::vector<NamedOptions> options = AllOptions();
  Worlds worlds(options);
  const std::vector<SceneShape> shapes = MixedShapes(false);
  std::vector<BodyHandle> bodies;
  for (int i = 0; i < 10; ++i) {
    Subscriptions wanted;
    wanted.verdict = i % 3 != 0;
    if (i % 2 == 0) wanted.distance = 0.4;
    if (i % 4 == 1) wanted.depth = true;
    if (i % 5 == 2) wanted.travel = Subscriptions::Travel{{0.3, -0.2, 1.0}, 1.5};
    const WorldPose pose = RandomPose(random, 3.0);
    const SceneShape& shape = shapes[i % shapes.size()];
    bodies.push_back(worlds.ForAll([&](Scene& scene) { return *scene.Add(shape, pose, wanted); }));
  }
  SubscribeFarPair(worlds, bodies[7], bodies[3]);
  std::size_t distances = 0, depths = 0, travels = 0;
  for (int step = 0; step < 250; ++step) {
    MoveMost(random, worlds, bodies, 3.0);
    const SceneStep found = worlds.Step();
    if (HasFatalFailure()) FAIL() << "step " << step;
    distances += found.distances.size();
    depths += found.depths.size();
    travels += found.travels.size();
  }
  EXPECT_GT(distances, 500u);
  EXPECT_GT(depths, 100u);
  EXPECT_GT(travels, 250u);
}

// Distances and travels of meshes, compounds among them, by body and by pair.
TEST(Rules, DistancesAndTravelsOfMeshes) {
  std::printf("seed 9\n");
  Random random(9);
  Worlds worlds(AllOptions());
  const std::vector<SceneShape> shapes = {MeshShape("torus", 120, 0.5), CrossShape(),
                                          MeshShape("u", 0, 0.5), HullShape(20, 3),
                                          MeshShape("tori", 120, 0.3)};
  std::vector<BodyHandle> bodies;
  for (int i = 0; i < 10; ++i) {
    Subscriptions wanted;
    wanted.verdict = i % 3 != 0;
    if (i % 2 == 0) wanted.distance = 0.5;
    if (i % 5 == 2) wanted.travel = Subscriptions::Travel{{0.3, -0.2, 1.0}, 1.5};
    const WorldPose pose = RandomPose(random, 2.5);
    const SceneShape& shape = shapes[i % shapes.size()];
    bodies.push_back(worlds.ForAll([&](Scene& scene) { return *scene.Add(shape, pose, wanted); }));
  }
  SubscribeFarPair(worlds, bodies[7], bodies[3]);
  std::size_t distances = 0, travels = 0;
  for (int step = 0; step < 60; ++step) {
    MoveMost(random, worlds, bodies, 2.5);
    const SceneStep found = worlds.Step();
    if (HasFatalFailure()) FAIL() << "step " << step;
    distances += found.mesh_distances.size();
    travels += found.mesh_travels.size();
  }
  EXPECT_GT(distances, 300u);
  EXPECT_GT(travels, 60u);                                                  // measured 94
  EXPECT_GT(worlds.totals(1).numbers_kept, worlds.totals(5).numbers_kept);  // by margins
}

TEST(Rules, DepthsOfMeshes) {
  std::printf("seed 8\n");
  Random random(8);
  const std::vector<NamedOptions> all = AllOptions();
  Worlds worlds({all[0], all[1], all[2]});
  const std::vector<SceneShape> shapes = {MeshShape("torus", 120, 0.5), MeshShape("u", 0, 0.5),
                                          BoxShape({0.5, 0.5, 0.5})};
  std::vector<BodyHandle> bodies;
  for (int i = 0; i < 6; ++i) {
    Subscriptions depth;
    depth.depth = true;
    depth.cpd = i == 0;
    const WorldPose pose = RandomPose(random, 0.6);
    bodies.push_back(
        worlds.ForAll([&](Scene& scene) { return *scene.Add(shapes[i % 3], pose, depth); }));
  }
  std::size_t depths = 0, continuous = 0, continued = 0;
  for (int step = 0; step < 30; ++step) {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      if (random.Int(0, 2) == 0) continue;
      // The first goes away at times, and comes back: to a cold start, wherever the pair was kept.
      WorldPose pose = Nudged(random, worlds.scene(0).pose(bodies[i]), 0.02, 0.02);
      if (i == 0 && step % 10 == 8) pose.translation[0] += 5.0;
      if (i == 0 && step % 10 == 9 && pose.translation[0] > 2.5) pose.translation[0] -= 5.0;
      worlds.ForAll([&](Scene& scene) { return scene.Move(bodies[i], pose).ok(); });
    }
    const SceneStep found = worlds.Step();
    if (HasFatalFailure()) FAIL() << "step " << step;
    depths += found.mesh_depths.size();
    continuous += found.continuous_depths.size();
    for (const auto& number : found.continuous_depths) {
      continued += number.result.branch >= 1 && !number.result.branch_ended;
      // Never shorter than the least way out.
      const auto same =
          std::find_if(found.mesh_depths.begin(), found.mesh_depths.end(), [&](const auto& depth) {
            return depth.bodies == number.bodies && depth.part_b == number.part_b;
          });
      if (same == found.mesh_depths.end()) continue;  // of convex parts
      ASSERT_GE(number.result.translation.norm(), (1 - 1e-9) * same->result.lower_bound);
    }
  }
  EXPECT_GT(depths, 40u);
  EXPECT_GT(continuous, 20u);
  EXPECT_GT(continued, 10u);
}

}  // namespace
}  // namespace touchstone::testing
