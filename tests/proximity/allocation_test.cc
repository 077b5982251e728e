// SPDX-License-Identifier: MIT
//
// Collide never touches the heap in doubles; proximity queries do not once the caller's cache has
// grown to what they need.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "touchstone/core/cd_dual/cd_dual.h"
#include "touchstone/core/proximity/distance.h"
#include "touchstone/core/proximity/penetration_depth.h"
#include "touchstone/tests/proximity/brute_force.h"
#include "touchstone/tests/testing/allocations.h"
#include "touchstone/tests/testing/random.h"
#include "touchstone/tests/testing/shapes.h"

namespace touchstone::testing {
namespace {

TEST(Allocation, NoneInACollisionQuery) {
  for (const int n : {8, 20, 300}) {
    const ConvexPolyhedron p = MustBuild(RoundBody(n, {2, 1, 1}, 53));
    const ConvexPolyhedron q = MustBuild(RoundBody(n, {1, 1.5, 0.7}, 54));
    long queries = 0;
    for (int step = 0; step < 60; ++step) {
      const RelativePose pose =
          MustPose(Eigen::AngleAxisd(0.1 * step, Eigen::Vector3d::UnitX()).toRotationMatrix(),
                   {0.07 * step, 0.3, -0.2});
      CollideCache cache;
      for (const bool early_exit : {true, false}) {
        for (CollideCache* held : {static_cast<CollideCache*>(nullptr), &cache}) {
          const long before = AllocationCount();
          const CollideResult result = Collide(p, q, pose, {.early_exit = early_exit}, held);
          ++queries;
          EXPECT_EQ(AllocationCount(), before) << result.exact_signs << " exact signs";
        }
      }
    }
    EXPECT_GT(queries, 200);
  }
}

TEST(Allocation, NoneWhereExactSignsDecide) {
  const ConvexPolyhedron p = MustBuild(Box({1, 1, 1})), q = MustBuild(RoundBody(40, {1, 1, 1}, 55));
  Random random(56);
  long decided = 0;
  for (int i = 0; i < 200; ++i) {
    // Box on box, a face, an edge or a corner in common.
    const double x = 0.25 * random.Int(-8, 8), y = 0.25 * random.Int(-8, 8);
    const RelativePose on_top = MustPose(Eigen::Matrix3d::Identity(), {x, y, 2.0});
    // A round body at what doubles cannot tell from contact.
    const Eigen::Matrix3d turn = random.Rotation();
    const CollideResult far = Collide(p, q, MustPose(turn, {3.5, x, y}));
    ASSERT_TRUE(far.exit_travel);
    const Eigen::Vector3d near =
        Eigen::Vector3d(3.5, x, y) - far.exit_travel->value * far.interior_difference.normalized();
    for (const bool early_exit : {true, false}) {
      const long before = AllocationCount();
      const CollideResult boxes = Collide(p, p, on_top, {.early_exit = early_exit});
      const CollideResult round = Collide(p, q, MustPose(turn, near), {.early_exit = early_exit});
      EXPECT_EQ(AllocationCount(), before);
      decided += (boxes.exact_signs > 0) + (round.exact_signs > 0);
    }
  }
  EXPECT_GT(decided, 200);
}

TEST(Allocation, NoneInAQueryAfterTheFirst) {
  const ConvexPolyhedron p = MustBuild(RoundBody(100, {2, 1, 1}, 51));
  const ConvexPolyhedron q = MustBuild(RoundBody(100, {1, 1.5, 0.7}, 52));
  PenetrationCache penetration;
  DistanceCache distance;
  const auto query = [&](int frame, bool cold) {
    const double angle = 0.01 * frame;
    const RelativePose pose =
        MustPose((Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ())).toRotationMatrix(),
                 {0.5 + 0.001 * frame, 0.25, 0.125});
    const RelativePose apart = MustPose(pose.rotation(), {4, 1, 0.5});
    if (cold) penetration.Clear();
    const PenetrationResult in = PenetrationDepth(p, q, pose, {}, &penetration);
    const DistanceResult out = Distance(p, q, apart, {}, &distance);
    EXPECT_EQ(in.verdict, Verdict::kOverlap);
    EXPECT_EQ(out.kind, DistanceKind::kSeparate);
    EXPECT_EQ(in.exact_signs + out.exact_signs, 0) << "big numbers may allocate";
  };
  for (const bool first : {true, false}) {
    for (const bool cold : {true, false}) {
      const long before = AllocationCount();
      for (int frame = 0; frame < 200; ++frame) query(frame, cold);
      if (!first) {
        EXPECT_EQ(AllocationCount(), before) << (cold ? "cold" : "warm");
      }
    }
  }
}

}  // namespace
}  // namespace touchstone::testing
