// SPDX-License-Identifier: MIT
//
// A million steps: memory stops growing, and so do allocations.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <vector>

#include "touchstone/core/scene/scene.h"
#include "touchstone/tests/scene/worlds.h"
#include "touchstone/tests/testing/allocations.h"

namespace touchstone::testing {
namespace {

// Eight hulls that wander through each other, one of which is removed and added again at times.
TEST(Soak, AMillionStepsWithoutGrowth) {
  std::printf("seed 11\n");
  Random random(11);
  Scene scene;
  std::vector<SceneShape> shapes;
  for (int i = 0; i < 8; ++i) shapes.push_back(HullShape(20, i));
  std::vector<WorldPose> starts;
  std::vector<BodyHandle> bodies;
  for (int i = 0; i < 8; ++i) {
    starts.push_back(RandomPose(random, 2.0));
    bodies.push_back(*scene.Add(shapes[i], starts[i]));
  }
  // A tour that repeats, so that what a lap needs is known after the first few.
  std::vector<std::vector<WorldPose>> tour(1000);
  for (auto& poses : tour) {
    for (int i = 0; i < 8; ++i) {
      const WorldPose& last = &poses == &tour[0] ? starts[i] : (&poses)[-1][i];
      poses.push_back(Nudged(random, last, 0.02, 0.02));
      for (int axis = 0; axis < 3; ++axis) {
        double& x = poses.back().translation[axis];
        x = std::clamp(x, -2.0, 2.0);
      }
    }
  }
  std::size_t bytes = 0;
  long allocated = 0, events = 0;
  constexpr int kSteps = 1000000, kSettled = 20000;
  for (int step = 0; step < kSteps; ++step) {
    const std::vector<WorldPose>& poses = tour[step % tour.size()];
    // One body a step, and all of them now and then.
    for (int i = 0; i < 8; ++i) {
      if (step % 8 != i && step % 64 != 0) continue;
      ASSERT_TRUE(scene.Move(bodies[i], poses[i]).ok());
    }
    if (step % 1000 == 999) {
      ASSERT_TRUE(scene.Remove(bodies[3]).ok());
      bodies[3] = *scene.Add(shapes[3], poses[3]);
    }
    events += static_cast<long>(scene.Step().events.size());
    if (step == kSettled) {
      bytes = scene.memory().total();
      allocated = AllocationCount();
    }
  }
  EXPECT_GT(events, kSteps);
  EXPECT_LE(scene.memory().total(), bytes);
  // The shape's holder, the broad phase and exact signs may allocate where a body comes and goes.
  std::printf("%zu bytes held, %ld allocations in the last %d steps\n", scene.memory().total(),
              AllocationCount() - allocated, kSteps - kSettled);
  EXPECT_LT(AllocationCount() - allocated, (kSteps - kSettled) / 100);
}

}  // namespace
}  // namespace touchstone::testing
