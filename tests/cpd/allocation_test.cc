// SPDX-License-Identifier: MIT
//
// Memberships of a warm frame never touch the heap; nor does a frame of CPD that finds its branch
// on the triangles it kept, nor a depth from a list that is there.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "touchstone/core/cpd/continuous_penetration_depth.h"
#include "touchstone/core/cpd/mesh_penetration_depth.h"
#include "touchstone/core/mesh/membership.h"
#include "touchstone/tests/testing/allocations.h"
#include "touchstone/tools/shapes/paper_scenes.h"

namespace touchstone {
namespace {

using Eigen::Vector3d;

TEST(Allocation, NoneInTheMembershipsOfAWarmFrame) {
  for (const PaperScene& scene : AllPaperScenes()) {
    const TriangleMesh a = MustBuild(scene.a), b = MustBuild(scene.b);
    const double step = scene.AtTurn(0.1) - scene.AtTurn(0.0);
    MeshPair pair(a, b, scene.PoseAt(0.3));
    MembershipCache cache;
    long queries = 0, warm = 0;
    for (int i = 0; i < 10; ++i) {
      pair.Place(scene.PoseAt(0.3 + i * step));
      for (int k = 0; k < 20; ++k) {
        const Vector3d x = (0.08 * k) * kPaperSumRadius * Vector3d(std::sin(k), std::cos(k), 0.3);
        const long before = testing::AllocationCount();
        const MembershipResult result = Membership(pair, x, {Certainty::kFloat}, &cache);
        if (i == 0) continue;  // storage grows to what it takes
        ++queries;
        warm += testing::AllocationCount() == before;
        EXPECT_NE(result.verdict, Verdict::kTouch);
      }
    }
    EXPECT_EQ(warm, queries) << scene.name;
  }
}

TEST(Allocation, NoneInMostWarmFrames) {
  for (const PaperScene& scene : AllPaperScenes()) {
    const TriangleMesh a = MustBuild(scene.a), b = MustBuild(scene.b);
    const ContactBody body_a(a), body_b(b);
    const double step = scene.AtTurn(0.02) - scene.AtTurn(0.0);
    ContinuousPenetrationDepth cpd(a, b);
    MeshPair pair(a, b, scene.PoseAt(0.3));
    MeshDepthCache cache;
    int kept = 0, kept_free = 0, listed = 0, listed_free = 0;
    for (int i = 0; i < 40; ++i) {
      const RelativePose pose = scene.PoseAt(0.3 + i * step);
      long before = testing::AllocationCount();
      const ContinuousDepthResult result = cpd.Update(pose);
      kept += i > 8 && result.iterations == 0;
      kept_free += i > 8 && result.iterations == 0 && testing::AllocationCount() == before;
      pair.Place(pose);
      before = testing::AllocationCount();
      const MeshDepthResult depth = MeshPenetrationDepth(pair, body_a, body_b, {}, &cache);
      listed += i > 8 && depth.node_pairs == 0;
      listed_free += i > 8 && depth.node_pairs == 0 && testing::AllocationCount() == before;
    }
    SCOPED_TRACE(scene.name);
    EXPECT_GT(kept, 15);
    EXPECT_GT(kept_free, kept * 3 / 4);
    EXPECT_GT(listed, 15);
    EXPECT_GT(listed_free, listed * 3 / 4);
  }
}

}  // namespace
}  // namespace touchstone
