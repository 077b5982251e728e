// SPDX-License-Identifier: MIT
//
// Proximity queries do not touch the heap once the caller's cache has grown to what they need.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cstdlib>
#include <new>

#include "touchstone/core/proximity/distance.h"
#include "touchstone/core/proximity/penetration_depth.h"
#include "touchstone/tests/proximity/brute_force.h"
#include "touchstone/tests/testing/shapes.h"

namespace {
long allocations = 0;
}

void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace touchstone::testing {
namespace {

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
      allocations = 0;
      for (int frame = 0; frame < 200; ++frame) query(frame, cold);
      if (!first) {
        EXPECT_EQ(allocations, 0) << (cold ? "cold" : "warm");
      }
    }
  }
}

}  // namespace
}  // namespace touchstone::testing
