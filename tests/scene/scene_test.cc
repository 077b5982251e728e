// SPDX-License-Identifier: MIT
#include "touchstone/core/scene/scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "touchstone/tests/scene/worlds.h"
#include "touchstone/tests/testing/shapes.h"

namespace touchstone::testing {
namespace {

using Eigen::Vector3d;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// "begin 0 1 touch, ..." of a step.
std::string Told(const SceneStep& step) {
  std::string told;
  for (const SceneEvent& event : step.events) {
    told += (told.empty() ? "" : ", ") + std::string(ToString(event.kind)) + ' ' +
            std::to_string(event.bodies.a.slot) + ' ' + std::to_string(event.bodies.b.slot) + ' ' +
            std::string(ToString(event.verdict));
  }
  return told;
}

const SceneShape& Cube() {
  static const SceneShape kCube = BoxShape({1, 1, 1});
  return kCube;
}

TEST(SceneBodies, NoneAndOne) {
  Scene scene;
  EXPECT_EQ(Told(scene.Step()), "");
  EXPECT_EQ(scene.body_count(), 0);
  const BodyHandle body = *scene.Add(Cube(), At({1, 2, 3}));
  EXPECT_EQ(Told(scene.Step()), "");
  EXPECT_EQ(scene.body_count(), 1);
  EXPECT_TRUE(scene.Has(body));
  EXPECT_TRUE(scene.Remove(body).ok());
  EXPECT_EQ(Told(scene.Step()), "");
  EXPECT_EQ(scene.body_count(), 0);
  EXPECT_FALSE(scene.Has(body));
}

TEST(SceneEvents, BeginPersistEnd) {
  Scene scene;
  const BodyHandle a = *scene.Add(Cube(), At({0, 0, 0}));
  const BodyHandle b = *scene.Add(Cube(), At({5, 0, 0}));
  EXPECT_EQ(Told(scene.Step()), "");
  EXPECT_TRUE(scene.Move(b, At({2, 0, 0})).ok());
  EXPECT_EQ(Told(scene.Step()), "begin 0 1 touch");
  EXPECT_EQ(scene.verdict(a, b), Verdict::kTouch);
  EXPECT_EQ(scene.verdict(b, a), Verdict::kTouch);
  EXPECT_EQ(Told(scene.Step()), "persist 0 1 touch");
  EXPECT_EQ(Told(scene.Step()), "persist 0 1 touch");
  EXPECT_TRUE(scene.Move(a, At({0.5, 0, 0})).ok());
  EXPECT_EQ(Told(scene.Step()), "persist 0 1 overlap");
  EXPECT_TRUE(scene.Move(a, At({std::nextafter(0.0, -1.0), 0, 0})).ok());
  EXPECT_EQ(Told(scene.Step()), "end 0 1 separate");
  EXPECT_EQ(Told(scene.Step()), "");
  EXPECT_EQ(scene.verdict(a, b), Verdict::kSeparate);
}

TEST(SceneEvents, RemovalDuringContactEndsIt) {
  Scene scene;
  const BodyHandle a = *scene.Add(Cube(), At({0, 0, 0}));
  const BodyHandle b = *scene.Add(Cube(), At({1, 0, 0}));
  EXPECT_EQ(Told(scene.Step()), "begin 0 1 overlap");
  EXPECT_TRUE(scene.Remove(b).ok());
  // Its slot is not given away before the end was told.
  const BodyHandle c = *scene.Add(Cube(), At({-1, 0, 0}));
  EXPECT_EQ(c.slot, 2u);
  const SceneStep step = scene.Step();
  EXPECT_EQ(Told(step), "end 0 1 separate, begin 0 2 overlap");
  EXPECT_EQ(step.events[0].bodies, (BodyPair{a, b}));
  const BodyHandle d = *scene.Add(Cube(), At({50, 0, 0}));
  EXPECT_EQ(d.slot, b.slot);
  EXPECT_NE(d.generation, b.generation);
  EXPECT_FALSE(scene.Has(b));
  EXPECT_FALSE(scene.Move(b, At({0, 0, 0})).ok());
  EXPECT_FALSE(scene.Remove(b).ok());
  EXPECT_EQ(scene.Move(b, At({0, 0, 0})).code, StatusCode::kBadIndex);
  EXPECT_EQ(Told(scene.Step()), "persist 0 2 overlap");
}

TEST(SceneEvents, ComeAndGoneBetweenSteps) {
  Scene scene;
  scene.Add(Cube(), At({0, 0, 0}));
  const BodyHandle b = *scene.Add(Cube(), At({1, 0, 0}));
  EXPECT_TRUE(scene.Remove(b).ok());
  EXPECT_EQ(Told(scene.Step()), "");
}

TEST(ScenePoses, BadOnesAreRefusedAndChangeNothing) {
  Scene scene;
  const BodyHandle a = *scene.Add(Cube(), At({0, 0, 0}));
  const BodyHandle b = *scene.Add(Cube(), At({1.5, 0, 0}));
  const std::string before = Told(scene.Step());
  EXPECT_EQ(before, "begin 0 1 overlap");
  const WorldPose good = scene.pose(b);
  std::vector<std::pair<WorldPose, StatusCode>> bad;
  for (const double value : {kNaN, kInfinity, -kInfinity}) {
    for (int k = 0; k < 12; ++k) {
      WorldPose pose = good;
      (k < 9 ? pose.rotation(k / 3, k % 3) : pose.translation[k - 9]) = value;
      bad.emplace_back(pose, StatusCode::kNonFinite);
    }
  }
  WorldPose pose = good;
  pose.translation[1] = 1e300;
  bad.emplace_back(pose, StatusCode::kOutOfRange);
  pose.translation[1] = -3e99;
  bad.emplace_back(pose, StatusCode::kOutOfRange);
  pose = good;
  pose.rotation(0, 0) = -1.0;
  bad.emplace_back(pose, StatusCode::kBadRotation);
  pose.rotation = 1.001 * good.rotation;
  bad.emplace_back(pose, StatusCode::kBadRotation);
  pose.rotation = good.rotation;
  pose.rotation(0, 1) = 1.0;
  bad.emplace_back(pose, StatusCode::kBadRotation);
  for (const auto& [refused, code] : bad) {
    EXPECT_EQ(scene.Move(b, refused).code, code);
    EXPECT_EQ(scene.Add(Cube(), refused).status().code, code);
    EXPECT_EQ(scene.pose(b).translation, good.translation);
    EXPECT_EQ(scene.pose(b).rotation, good.rotation);
  }
  EXPECT_EQ(scene.body_count(), 2);
  const SceneStep step = scene.Step();
  EXPECT_EQ(Told(step), "persist 0 1 overlap");
  EXPECT_EQ(step.counters.bodies_moved, 0);
  EXPECT_EQ(scene.verdict(a, b), Verdict::kOverlap);
}

TEST(ScenePoses, TheSamePoseIsNoMotion) {
  Scene scene;
  const BodyHandle a = *scene.Add(Cube(), At({0, 0, 0}));
  scene.Add(Cube(), At({1, 0, 0}));
  scene.Step();
  EXPECT_TRUE(scene.Move(a, At({0, 0, 0})).ok());
  const SceneStep step = scene.Step();
  EXPECT_EQ(step.counters.bodies_moved, 0);
  EXPECT_EQ(step.counters.looked_at, 0);
  EXPECT_EQ(Told(step), "persist 0 1 overlap");
}

TEST(SceneFilters, GroupsMasksAndIgnoredPairs) {
  Scene scene;
  const BodyHandle a = *scene.Add(Cube(), At({0, 0, 0}), {}, {1, 2});
  const BodyHandle b = *scene.Add(Cube(), At({0.5, 0, 0}), {}, {2, 1});
  const BodyHandle c = *scene.Add(Cube(), At({0, 0.5, 0}), {}, {1, 1});
  EXPECT_EQ(Told(scene.Step()), "begin 0 1 overlap");
  EXPECT_TRUE(scene.SetFilter(a, {1, 3}).ok());
  EXPECT_EQ(Told(scene.Step()), "persist 0 1 overlap, begin 0 2 overlap");
  EXPECT_TRUE(scene.SetIgnored(c, a, true).ok());
  EXPECT_EQ(Told(scene.Step()), "persist 0 1 overlap, end 0 2 separate");
  EXPECT_TRUE(scene.SetFilter(b, {0, 0}).ok());
  EXPECT_EQ(Told(scene.Step()), "end 0 1 separate");
  EXPECT_TRUE(scene.SetIgnored(a, c, false).ok());
  EXPECT_TRUE(scene.SetFilter(b, {}).ok());
  EXPECT_EQ(Told(scene.Step()), "begin 0 1 overlap, begin 0 2 overlap, begin 1 2 overlap");
  EXPECT_TRUE(scene.SetFilter(c, {1, 0}).ok());
  EXPECT_EQ(Told(scene.Step()), "persist 0 1 overlap, end 0 2 separate, end 1 2 separate");
  EXPECT_FALSE(scene.SetIgnored(a, a, true).ok());
}

TEST(SceneSubscriptions, OnlyWhatWasAskedFor) {
  Scene scene;
  Subscriptions nothing;
  nothing.verdict = false;
  const BodyHandle a = *scene.Add(Cube(), At({0, 0, 0}), nothing);
  const BodyHandle b = *scene.Add(Cube(), At({1, 0, 0}), nothing);
  SceneStep step = scene.Step();
  EXPECT_EQ(Told(step), "");
  EXPECT_EQ(step.counters.pairs, 0);
  Subscriptions depth;
  depth.verdict = false;
  depth.depth = true;
  EXPECT_TRUE(scene.Subscribe(a, depth).ok());
  step = scene.Step();
  EXPECT_EQ(Told(step), "");
  ASSERT_EQ(step.depths.size(), 1u);
  EXPECT_NEAR(step.depths[0].result.depth.value, 1.0, 1e-14);
  step = scene.Step();
  ASSERT_EQ(step.depths.size(), 1u);
  EXPECT_EQ(step.counters.depths, 0);  // kept: nothing moved
  EXPECT_TRUE(scene.SubscribePair(b, a, {}).ok());
  EXPECT_EQ(Told(scene.Step()), "begin 0 1 overlap");
  EXPECT_TRUE(scene.SubscribePair(a, b, nothing).ok());
  EXPECT_EQ(Told(scene.Step()), "end 0 1 separate");
  EXPECT_TRUE(scene.Subscribe(a, nothing).ok());
  step = scene.Step();
  EXPECT_EQ(step.counters.pairs, 0);
  EXPECT_TRUE(step.depths.empty());
}

TEST(SceneSubscriptions, DistanceBelowTheMargin) {
  Scene scene;
  Subscriptions near;
  near.distance = 1.0;
  scene.Add(Cube(), At({0, 0, 0}), near);
  const BodyHandle b = *scene.Add(Cube(), At({3, 0, 0}));
  SceneStep step = scene.Step();
  ASSERT_EQ(step.distances.size(), 1u);  // exactly the margin
  EXPECT_EQ(step.distances[0].result.distance.value, 1.0);
  EXPECT_TRUE(scene.Move(b, At({3.0000001, 0, 0})).ok());
  EXPECT_TRUE(scene.Step().distances.empty());
  EXPECT_TRUE(scene.Move(b, At({2.5, 0, 0})).ok());
  step = scene.Step();
  ASSERT_EQ(step.distances.size(), 1u);
  EXPECT_EQ(step.distances[0].result.distance.value, 0.5);
  EXPECT_TRUE(scene.Move(b, At({1, 0, 0})).ok());
  step = scene.Step();
  ASSERT_EQ(step.distances.size(), 1u);
  EXPECT_EQ(step.distances[0].result.kind, DistanceKind::kMeet);
}

TEST(SceneSubscriptions, TravelOfTheSubscribedBody) {
  Scene scene;
  Subscriptions travels;
  travels.travel = Subscriptions::Travel{{1, 0, 0}, 4.0};
  const BodyHandle a = *scene.Add(Cube(), At({0, 0, 0}), travels);
  const BodyHandle b = *scene.Add(Cube(), At({5, 0, 0}));
  SceneStep step = scene.Step();
  ASSERT_EQ(step.travels.size(), 1u);
  EXPECT_EQ(step.travels[0].result.enter.travel.value, 3.0);
  EXPECT_EQ(step.travels[0].result.leave.travel.value, 7.0);
  // Behind it, and out of reach.
  EXPECT_TRUE(scene.Move(b, At({-5, 0, 0})).ok());
  EXPECT_TRUE(scene.Step().travels.empty());
  EXPECT_TRUE(scene.Move(b, At({6.5, 0, 0})).ok());
  EXPECT_TRUE(scene.Step().travels.empty());
  // Of a pair it is the second body of the call that travels.
  Subscriptions pair;
  pair.travel = Subscriptions::Travel{{-1, 0, 0}, 100.0};
  EXPECT_TRUE(scene.SubscribePair(a, b, pair).ok());
  step = scene.Step();
  ASSERT_EQ(step.travels.size(), 1u);
  EXPECT_EQ(step.travels[0].result.enter.travel.value, 4.5);
  EXPECT_TRUE(scene.SubscribePair(b, a, pair).ok());
  EXPECT_TRUE(scene.Step().travels.empty());
}

TEST(SceneSubscriptions, DistanceAndTravelOfMeshes) {
  Scene scene;
  Subscriptions wanted;
  wanted.distance = 2.0;
  wanted.travel = Subscriptions::Travel{{-1, 0, 0}, 2.5};
  // [0, 3] x [0, 1] x [0, 3] without [1, 2] x [0, 1] x [1, 3], beside a convex body and a compound.
  scene.Add(Cube(), At({-1, 0.5, 0.5}));
  const BodyHandle u = *scene.Add(MeshShape("u", 0, 1.0), At({2, 0, 0}), wanted);
  SceneStep step = scene.Step();
  ASSERT_EQ(step.mesh_distances.size(), 1u);  // exactly the margin
  EXPECT_EQ(step.mesh_distances[0].result.distance, 2.0);
  EXPECT_LE(step.mesh_distances[0].result.lower_bound, 2.0);
  ASSERT_EQ(step.mesh_travels.size(), 1u);
  EXPECT_EQ(step.mesh_travels[0].result.travel, 2.0);
  EXPECT_TRUE(step.distances.empty() && step.travels.empty());
  EXPECT_TRUE(scene.Move(u, At({2.75, 0, 0})).ok());
  step = scene.Step();
  EXPECT_TRUE(step.mesh_distances.empty());
  EXPECT_TRUE(step.mesh_travels.empty());
  EXPECT_TRUE(scene.Move(u, At({0, 0, 0})).ok());
  step = scene.Step();
  EXPECT_EQ(Told(step), "begin 0 1 touch");
  ASSERT_EQ(step.mesh_distances.size(), 1u);
  EXPECT_EQ(step.mesh_distances[0].result.upper_bound, 0.0);
  ASSERT_EQ(step.mesh_travels.size(), 1u);
  EXPECT_EQ(step.mesh_travels[0].result.upper_bound, 0.0);
  EXPECT_EQ(step.mesh_travels[0].result.face_a, -1);
  EXPECT_TRUE(scene.Move(u, At({2, 0, 0})).ok());
  scene.Add(CrossShape(), At({3.5, 0.5, 5.0}));
  step = scene.Step();
  // Of three parts of the compound those that are near enough.
  ASSERT_EQ(step.mesh_distances.size(), 4u);
  EXPECT_EQ(step.mesh_distances[0].bodies.a.slot, 0u);
  EXPECT_EQ(step.mesh_distances[1].part_b, 0);
  EXPECT_EQ(step.mesh_distances[3].part_b, 2);
}

TEST(SceneSubscriptions, ContinuousDepthFollowsTheMotion) {
  Scene scene;
  Subscriptions cpd;
  cpd.verdict = false;
  cpd.cpd = true;
  const SceneShape torus = MeshShape("torus", 120, 0.5);
  const BodyHandle a = *scene.Add(torus, At({0, 0, 0}), cpd);
  const BodyHandle b = *scene.Add(torus, At({0.3, 0.1, 0.2}), cpd);
  SceneStep step = scene.Step();
  EXPECT_EQ(Told(step), "");
  ASSERT_EQ(step.continuous_depths.size(), 1u);
  ContinuousDepthResult last = step.continuous_depths[0].result;
  EXPECT_EQ(last.status, ContinuousDepthStatus::kFound);
  EXPECT_EQ(last.branch, 1);
  EXPECT_EQ(step.counters.continuous_depths, 1);
  // Nothing moves: kept.
  step = scene.Step();
  ASSERT_EQ(step.continuous_depths.size(), 1u);
  EXPECT_EQ(step.counters.continuous_depths, 0);
  EXPECT_EQ(step.continuous_depths[0].result.translation, last.translation);
  // It moves as little as the body does, on one branch.
  for (int i = 1; i <= 10; ++i) {
    EXPECT_TRUE(scene.Move(b, At({0.3 + 0.002 * i, 0.1, 0.2})).ok());
    step = scene.Step();
    ASSERT_EQ(step.continuous_depths.size(), 1u);
    const ContinuousDepthResult& now = step.continuous_depths[0].result;
    EXPECT_EQ(now.branch, 1);
    EXPECT_LT((now.translation - last.translation).norm(), 0.03);
    last = now;
  }
  // Apart, and back: the branches begin anew, as in a scene that knows nothing of before.
  EXPECT_TRUE(scene.Move(b, At({0, 0, 0.9})).ok());
  EXPECT_TRUE(scene.Step().continuous_depths.empty());
  EXPECT_TRUE(scene.Move(b, At({0.32, 0.1, 0.2})).ok());
  step = scene.Step();
  ASSERT_EQ(step.continuous_depths.size(), 1u);
  EXPECT_EQ(step.continuous_depths[0].result.branch, 1);
  Scene other;
  other.Add(torus, At({0, 0, 0}), cpd);
  other.Add(torus, At({0.32, 0.1, 0.2}));
  EXPECT_EQ(other.Step().continuous_depths[0].result.translation,
            step.continuous_depths[0].result.translation);
  // Of convex bodies, too: no shorter than the least way out, which it is where nothing went
  // before.
  Scene convex;
  convex.Add(Cube(), At({0, 0, 0}), cpd);
  convex.Add(Cube(), At({1.5, 0.25, 0.5}));
  step = convex.Step();
  ASSERT_EQ(step.continuous_depths.size(), 1u);
  EXPECT_GE(step.continuous_depths[0].result.translation.norm(), 0.5 - 1e-12);
  EXPECT_LT(step.continuous_depths[0].result.translation.norm(), 0.55);
  EXPECT_TRUE(scene.Remove(a).ok());
  EXPECT_TRUE(scene.Step().continuous_depths.empty());
}

TEST(SceneSubscriptions, BadOnesAreRefused) {
  Scene scene;
  const BodyHandle a = *scene.Add(Cube(), At({0, 0, 0}));
  Subscriptions bad;
  for (const double value : {kNaN, -1.0, kInfinity}) {
    bad = {};
    bad.distance = value;
    EXPECT_EQ(scene.Subscribe(a, bad).code, StatusCode::kOutOfRange);
    EXPECT_FALSE(scene.Add(Cube(), At({0, 0, 0}), bad).ok());
    bad = {};
    bad.travel = Subscriptions::Travel{{value, 0, 0}, 1.0};
    if (value != -1.0) {
      EXPECT_EQ(scene.Subscribe(a, bad).code, StatusCode::kOutOfRange);
    }
    bad.travel = Subscriptions::Travel{{1, 0, 0}, value};
    EXPECT_EQ(scene.Subscribe(a, bad).code, StatusCode::kOutOfRange);
  }
  EXPECT_FALSE(scene.SubscribePair(a, a, {}).ok());
  EXPECT_FALSE(scene.SubscribePair(a, {7, 0}, {}).ok());
  EXPECT_EQ(scene.body_count(), 1);
}

TEST(SceneCompounds, TheirPartsDecide) {
  Scene scene;
  const BodyHandle cross = *scene.Add(CrossShape(), At({0, 0, 0}));
  const BodyHandle cube = *scene.Add(BoxShape({0.5, 0.5, 0.5}), At({0.75, 0.75, 0.75}));
  // Between the bars: it touches all three along edges.
  EXPECT_EQ(Told(scene.Step()), "begin 0 1 touch");
  EXPECT_TRUE(scene.Move(cube, At({0.8, 0.8, 0.8})).ok());
  EXPECT_EQ(Told(scene.Step()), "end 0 1 separate");
  EXPECT_TRUE(scene.Move(cube, At({0.8, 0.7, 0.7})).ok());
  EXPECT_EQ(Told(scene.Step()), "begin 0 1 overlap");
  EXPECT_EQ(scene.verdict(cross, cube), Verdict::kOverlap);
}

TEST(SceneMeshes, HolesSlotsAndCavities) {
  Scene scene;
  const SceneShape slot = MeshShape("slot", 0, 1.0), key = MeshShape("key", 0, 1.0);
  const SceneShape hollow = MeshShape("hollow", 0, 1.0);
  const BodyHandle a = *scene.Add(slot, At({0, 0, 0}));
  // [2, 3] x [0, 3] x [1, 3] fits the key's width exactly, as a mesh and as a convex body.
  const BodyHandle b = *scene.Add(key, At({2, 1, 1}));
  EXPECT_EQ(Told(scene.Step()), "begin 0 1 touch");
  EXPECT_TRUE(scene.Remove(b).ok());
  const BodyHandle c = *scene.Add(BoxShape({0.5, 0.5, 2}), At({2.5, 1.5, 3}));
  EXPECT_EQ(Told(scene.Step()), "end 0 1 separate, begin 0 2 touch");
  EXPECT_TRUE(scene.Move(c, At({2.5, 1.5, 2.75})).ok());
  EXPECT_EQ(Told(scene.Step()), "persist 0 2 overlap");
  EXPECT_TRUE(scene.Remove(a).ok());
  EXPECT_TRUE(scene.Remove(c).ok());
  // Inside the cavity, inside the wall of nothing: apart, and no surface crosses.
  const BodyHandle shell = *scene.Add(hollow, At({0, 0, 0}));
  const WorldPose in_cavity = At(0.5 * (Vector3d(0, 0, 0) + Vector3d(0, 0, 0)));
  const BodyHandle seed = *scene.Add(BoxShape({0.01, 0.01, 0.01}), in_cavity);
  scene.Step();
  EXPECT_EQ(scene.verdict(shell, seed),
            VerdictOf(hollow, scene.pose(shell), scene.shape(seed), in_cavity));
}

TEST(SceneMeshes, InterlockedToriAreSeparateWithoutBeingPlaced) {
  const SceneShape torus = MeshShape("torus", 800, 1.0);
  Scene scene;
  const BodyHandle a = *scene.Add(torus, At({0, 0, 0}));
  WorldPose linked = At({2, 0, 0});
  linked.rotation << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  const BodyHandle b = *scene.Add(torus, linked);
  SceneStep step = scene.Step();
  EXPECT_EQ(Told(step), "");
  EXPECT_EQ(step.counters.meshes_placed, 0);
  EXPECT_EQ(step.counters.meshes_apart, 1);
  linked.translation[0] = 1.99;
  EXPECT_TRUE(scene.Move(b, linked).ok());
  step = scene.Step();
  EXPECT_EQ(step.counters.by_margin, 1);
  linked.translation[0] = 0.5;
  EXPECT_TRUE(scene.Move(b, linked).ok());
  EXPECT_EQ(Told(scene.Step()), "begin 0 1 overlap");
  linked.translation[0] = 0.501;
  EXPECT_TRUE(scene.Move(b, linked).ok());
  step = scene.Step();
  EXPECT_EQ(Told(step), "persist 0 1 overlap");
  EXPECT_EQ(step.counters.meshes_placed, 0);  // the same two faces still cross
  EXPECT_EQ(scene.verdict(a, b), Verdict::kOverlap);
}

// A small mesh deep inside a big one, then gone from it in one step: surfaces far apart both times.
TEST(SceneMeshes, ContainmentSurvivesSmallMotionsOnly) {
  Scene scene;
  const SceneShape big = MeshShape("box", 12, 10.0);
  const BodyHandle a = *scene.Add(MeshShape("torus", 100, 0.5), At({0, 0, 0}));
  scene.Add(big, At({0, 0, 0}));
  EXPECT_EQ(Told(scene.Step()), "begin 0 1 overlap");
  EXPECT_TRUE(scene.Move(a, At({0.2, 0, 0})).ok());
  const SceneStep step = scene.Step();
  EXPECT_EQ(Told(step), "persist 0 1 overlap");
  EXPECT_EQ(step.counters.by_margin, 1);
  EXPECT_TRUE(scene.Move(a, At({30, 0, 0})).ok());
  EXPECT_EQ(Told(scene.Step()), "end 0 1 separate");
  EXPECT_TRUE(scene.Move(a, At({3, 3, 3})).ok());
  EXPECT_EQ(Told(scene.Step()), "begin 0 1 overlap");
}

TEST(SceneExtremes, EnormousAndTinyTogether) {
  for (const BroadPhase kind : {BroadPhase::kTree, BroadPhase::kSweep, BroadPhase::kAllPairs}) {
    SceneOptions options;
    options.rules.broad_phase = kind;
    Scene scene(options);
    const auto scaled = [](double size) { return BoxShape({size, size, size}); };
    const BodyHandle giant = *scene.Add(scaled(1e99), At({0, 0, 1e99}));
    const BodyHandle cube = *scene.Add(scaled(1.0), At({0, 0, -1.0}));
    const BodyHandle mite = *scene.Add(scaled(1e-99), At({0, 0, 1e-99}));
    const BodyHandle far = *scene.Add(scaled(1e-99), At({0, 0, -2.4e99}));
    scene.Step();
    for (int round = 0; round < 3; ++round) {
      SCOPED_TRACE(round);
      for (const BodyHandle a : scene.bodies()) {
        for (const BodyHandle b : scene.bodies()) {
          if (a.slot >= b.slot) continue;
          EXPECT_EQ(scene.verdict(a, b),
                    VerdictOf(scene.shape(a), scene.pose(a), scene.shape(b), scene.pose(b)))
              << a.slot << ' ' << b.slot;
        }
      }
      EXPECT_TRUE(scene.Move(mite, At({0, 0, -1e-99})).ok());
      EXPECT_TRUE(scene.Move(far, At({2.4e99, 2.4e99, -2.4e99})).ok());
      EXPECT_TRUE(scene.Move(cube, At({0, 0, round == 0 ? -1.0000001 : -1.0})).ok());
      scene.Step();
    }
    EXPECT_EQ(scene.verdict(giant, cube), Verdict::kTouch);
  }
}

TEST(SceneExtremes, AllOverlappingAndSharedShapes) {
  Scene scene;
  std::vector<BodyHandle> bodies;
  for (int i = 0; i < 40; ++i) {
    const SceneShape& shape = i % 2 == 0 ? Cube() : CrossShape();
    bodies.push_back(*scene.Add(shape, At({0.001 * i, 0, 0})));
  }
  SceneStep step = scene.Step();
  EXPECT_EQ(step.events.size(), 40u * 39u / 2u);
  for (std::size_t k = 1; k < step.events.size(); ++k) {
    EXPECT_LT(step.events[k - 1].bodies, step.events[k].bodies);
  }
  for (const BodyHandle body : bodies) {
    WorldPose pose = scene.pose(body);
    pose.translation[1] += 0.01;
    EXPECT_TRUE(scene.Move(body, pose).ok());
  }
  step = scene.Step();
  EXPECT_EQ(step.events.size(), 40u * 39u / 2u);
  for (const SceneEvent& event : step.events) EXPECT_EQ(event.kind, EventKind::kPersist);
}

// What a step costs when few move, and none.
TEST(SceneRest, WorkFollowsMotion) {
  Scene scene;
  std::vector<BodyHandle> bodies;
  for (int i = 0; i < 400; ++i) {
    bodies.push_back(*scene.Add(Cube(), At({1.9 * (i % 20), 1.9 * (i / 20), 0})));
  }
  SceneStep step = scene.Step();
  EXPECT_GT(step.counters.looked_at, 1000);
  step = scene.Step();
  EXPECT_EQ(step.counters.looked_at, 0);
  EXPECT_EQ(step.counters.by_rest, step.counters.pairs);
  WorldPose pose = scene.pose(bodies[210]);
  pose.translation[2] += 0.001;
  EXPECT_TRUE(scene.Move(bodies[210], pose).ok());
  step = scene.Step();
  EXPECT_LE(step.counters.looked_at, 8);
  EXPECT_EQ(step.counters.bodies_moved, 1);
}

// Every part of a convex body's surface is needed where it meets a mesh: vertices within edges, and
// within faces.
TEST(SceneShapes, ConvexSurfacesAsTriangles) {
  for (const Mesh& mesh : {CubeWithSplitEdges(3), SubdividedCube(2, false), Prism(30, 1.0),
                           Bipyramid(12, 2.0), ParaboloidLens(4)}) {
    const SceneShape shape = SceneShape::Convex(MustBuild(mesh));
    const TriangleMesh& surface = shape.part(0).mesh();
    EXPECT_EQ(surface.vertex_count(), static_cast<int>(mesh.vertices.size()));
    EXPECT_EQ(surface.face_count(), 2 * surface.vertex_count() - 4);
    EXPECT_EQ(surface.FindValidationError().ToString(), Status{}.ToString());
  }
}

}  // namespace
}  // namespace touchstone::testing
