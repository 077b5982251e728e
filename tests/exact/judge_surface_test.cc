// SPDX-License-Identifier: MIT
#include "touchstone/exact/judge_surface.h"

#include <gtest/gtest.h>

#include "touchstone/core/mesh/membership.h"
#include "touchstone/core/mesh/surface_distance.h"
#include "touchstone/core/mesh/surface_travel.h"
#include "touchstone/tests/testing/random.h"
#include "touchstone/tools/shapes/shapes.h"

namespace touchstone {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

struct Case {
  TriangleMesh a, b;
  RelativePose pose;
};

// Separate pairs, some placed by two poses in the world, some on the grid.
std::vector<Case> Cases() {
  const std::vector<TriangleMesh> meshes = {MustBuild(Torus(8, 5, 2.0, 0.75)), MustBuild(UShape()),
                                            MustBuild(Star(4)), MustBuild(Key())};
  testing::Random random(61);
  std::vector<Case> cases;
  while (cases.size() < 24) {
    const TriangleMesh& a = meshes[random.Int(0, 3)];
    const TriangleMesh& b = meshes[random.Int(0, 3)];
    const Vector3d at = random.Uniform(1.5, 5.0) * random.Direction();
    const int kind = static_cast<int>(cases.size()) % 3;
    const RelativePose pose =
        kind == 0   ? *RelativePose::Make(random.Rotation(), at)
        : kind == 1 ? *RelativePose::FromWorld({random.Rotation(), 10.0 * random.Direction()},
                                               {random.Rotation(), 10.0 * random.Direction()})
                    : *RelativePose::Make(Matrix3d::Identity(), Vector3d(at.array().round()));
    if (Membership(MeshPair(a, b, pose), Vector3d(Vector3d::Zero())).verdict !=
        Verdict::kSeparate) {
      continue;
    }
    cases.push_back({a, b, pose});
  }
  return cases;
}

TEST(JudgeSurface, AnswersStandAndFaultsAreFound) {
  testing::Random random(62);
  int hits = 0, misses = 0;
  for (const Case& c : Cases()) {
    const MeshPair pair(c.a, c.b, c.pose);
    const SurfaceDistanceResult r = SurfaceDistance(pair);
    const exact::SurfaceDistanceClaim distance{r.lower_bound, r.upper_bound, r.face_a, r.face_b};
    for (const std::string& line : exact::JudgeSurfaceDistance(c.a, c.b, c.pose, distance)) {
      ADD_FAILURE() << line;
    }
    const auto is_found = [&](exact::SurfaceDistanceClaim claim) {
      return !exact::JudgeSurfaceDistance(c.a, c.b, c.pose, claim).empty();
    };
    const double off = 1e-9 * r.distance;
    EXPECT_TRUE(is_found({r.lower_bound - 2 * off, r.upper_bound - off, r.face_a, r.face_b}));
    EXPECT_TRUE(is_found({0.0, 0.0, -1, -1}));
    EXPECT_TRUE(is_found({r.upper_bound, r.lower_bound, r.face_a, r.face_b}) ||
                r.upper_bound == r.lower_bound);
    // A face that is further away, named.
    const Vector3d s = -c.pose.translation() + 0.5 * random.Direction();
    const SurfaceTravelResult t = SurfaceTravel(pair, s, 2.0);
    const exact::SurfaceTravelClaim travel{
        s, 2.0, t.is_hit, t.lower_bound, t.upper_bound, t.face_a, t.face_b};
    for (const std::string& line : exact::JudgeSurfaceTravel(c.a, c.b, c.pose, travel)) {
      ADD_FAILURE() << line;
    }
    (t.is_hit ? hits : misses) += 1;
    const auto travel_is_found = [&](bool is_hit, double lower, double upper) {
      return !exact::JudgeSurfaceTravel(c.a, c.b, c.pose,
                                        {s, 2.0, is_hit, lower, upper, t.face_a, t.face_b})
                  .empty();
    };
    if (!t.is_hit) {
      EXPECT_TRUE(travel_is_found(true, 0.5, 0.6));
      continue;
    }
    EXPECT_TRUE(travel_is_found(true, 0.5 * t.lower_bound, 0.9 * t.lower_bound));
    EXPECT_TRUE(travel_is_found(true, 1.01 * t.upper_bound, 1.02 * t.upper_bound));
  }
  EXPECT_GT(hits, 10);
}

// The lower bound raised: found where the boxes of the nearest faces come near enough.
TEST(JudgeSurface, ARaisedLowerBoundIsFound) {
  for (const Case& c : Cases()) {
    const SurfaceDistanceResult r = SurfaceDistance(MeshPair(c.a, c.b, c.pose));
    exact::SurfaceJudgeOptions options;
    options.face_samples = 1 << 20;
    EXPECT_FALSE(exact::JudgeSurfaceDistance(
                     c.a, c.b, c.pose,
                     {(1 + 1e-6) * r.upper_bound, (1 + 2e-6) * r.upper_bound, r.face_a, r.face_b},
                     options)
                     .empty());
  }
}

}  // namespace
}  // namespace touchstone
