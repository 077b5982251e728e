// SPDX-License-Identifier: MIT
#include "touchstone/core/cd_dual/cache.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <vector>

#include "touchstone/core/cd_dual/batch.h"
#include "touchstone/core/cd_dual/cd_dual.h"
#include "touchstone/tests/cd_dual/placements.h"
#include "touchstone/tests/testing/shapes.h"

namespace touchstone::testing {
namespace {

// Poses along a motion: Q turns by `degrees` a frame and swings through P and out again.
std::vector<RelativePose> Motion(Random* random, double degrees, double reach, int frames) {
  const Eigen::Vector3d axis = random->Direction(), line = random->Direction();
  const Eigen::Matrix3d start = random->Rotation();
  std::vector<RelativePose> poses;
  for (int f = 0; f < frames; ++f) {
    const double angle = f * degrees * M_PI / 180.0;
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, axis).toRotationMatrix() * start;
    poses.push_back(MustPose(turn, reach * std::cos(4.0 * angle + 0.3) * line));
  }
  return poses;
}

void ExpectSame(const CollideResult& warm, const CollideResult& cold) {
  EXPECT_EQ(warm.verdict, cold.verdict);
  EXPECT_EQ(warm.face.has_value(), cold.face.has_value());
  if (!warm.exit_travel || !cold.exit_travel) return;
  if (warm.interior_p != cold.interior_p || warm.interior_q != cold.interior_q) return;
  EXPECT_LE(std::abs(warm.exit_travel->value - cold.exit_travel->value),
            warm.exit_travel->error + cold.exit_travel->error);
  EXPECT_LE(std::abs(warm.signed_distance->value - cold.signed_distance->value),
            warm.signed_distance->error + cold.signed_distance->error);
}

TEST(CollideCache, WarmAnswersAreTheColdOnes) {
  Random random(1);
  long warm = 0, asked = 0;
  for (const int n : {8, 20, 100, 600}) {
    const ConvexPolyhedron p = MustBuild(RoundBody(n, {2, 1, 1}, n));
    const ConvexPolyhedron q = MustBuild(RoundBody(n, {1, 1, 2}, n + 1));
    for (const double degrees : {0.01, 0.1, 1.0, 30.0}) {
      for (const bool early_exit : {true, false}) {
        CollideCache cache;
        for (const RelativePose& pose : Motion(&random, degrees, 4.0, 100)) {
          const CollideOptions options{.early_exit = early_exit};
          const CollideResult result = Collide(p, q, pose, options, &cache);
          ExpectSame(result, Collide(p, q, pose, options));
          warm += result.phase == Phase::kCache;
          ++asked;
        }
      }
    }
  }
  EXPECT_GT(warm, asked / 4);
}

// Boxes in contact, with exact ties at every frame.
TEST(CollideCache, TouchesStayTouches) {
  const ConvexPolyhedron box = MustBuild(Box({1, 1, 1}));
  CollideCache cache;
  for (int f = -20; f <= 20; ++f) {
    for (const double gap : {2.0, std::nextafter(2.0, 3.0), std::nextafter(2.0, 1.0), 2.5, 1.5}) {
      const RelativePose pose = MustPose(Eigen::Matrix3d::Identity(), {f / 16.0, gap, f / 32.0});
      for (const bool early_exit : {true, false}) {
        const CollideResult result = Collide(box, box, pose, {.early_exit = early_exit}, &cache);
        EXPECT_EQ(result.verdict, gap > 2.0   ? Verdict::kSeparate
                                  : gap < 2.0 ? Verdict::kOverlap
                                              : Verdict::kTouch);
      }
    }
  }
}

// A cache of another pair, of nonsense, of numbers that are none: slower, never wrong.
TEST(CollideCache, NothingInItIsTrusted) {
  Random random(3);
  const double kNan = std::numeric_limits<double>::quiet_NaN();
  const ConvexPolyhedron large = MustBuild(RoundBody(400, {3, 1, 1}, 9));
  CollideCache stranger;
  Collide(large, large, MustPose(random.Rotation(), {1, 0, 0}), {.early_exit = true}, &stranger);
  long judged = 0;
  for (const Placement& x : SmallPlacements(/*seed=*/4, 200)) {
    for (int kind = 0; kind < 6; ++kind) {
      CollideCache cache = stranger;
      cache.has_direction = kind % 2 == 0;
      cache.has_triangle = kind != 0;
      if (kind == 2) cache.direction = {kNan, 0, 1};
      if (kind == 3) cache.triangle = {{{-5, 1 << 30}, {0, 0}, {0, 0}}};
      if (kind == 4) cache.direction = random.Direction();
      if (kind == 4) cache.support = {0, 0};
      if (kind == 5) {
        cache.triangle = {{{0, 0}, {1, 0}, {0, 1}}};
        cache.interior_p = 77;
        cache.interior_q = -3;
      }
      for (const bool early_exit : {true, false}) {
        const CollideOptions options{.early_exit = early_exit};
        ExpectSame(Collide(x.p, x.q, x.pose, options, &cache), Collide(x.p, x.q, x.pose, options));
        ++judged;
      }
    }
  }
  EXPECT_GE(judged, 2400);
}

TEST(CollideBatch, IsTheSameBitForBitHoweverItIsRun) {
  const std::vector<Placement> placements = SmallPlacements(/*seed=*/6, 500);
  std::vector<PlacedPairRef> pairs;
  for (const Placement& x : placements) pairs.push_back({&x.p, &x.q, &x.pose});
  for (const bool early_exit : {true, false}) {
    const CollideOptions options{.early_exit = early_exit};
    std::vector<CollideResult> serial(pairs.size()), parallel(pairs.size());
    CollideBatch(pairs, options, serial);
    CollideBatch(pairs, options, parallel, Threads::kAll);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const CollideResult single = Collide(*pairs[i].p, *pairs[i].q, *pairs[i].pose, options);
      for (const CollideResult* batch : {&serial[i], &parallel[i]}) {
        ASSERT_EQ(batch->verdict, single.verdict);
        ASSERT_EQ(batch->tier, single.tier);
        ASSERT_EQ(batch->phase, single.phase);
        ASSERT_EQ(batch->certificate.kind, single.certificate.kind);
        ASSERT_EQ(batch->certificate.direction, single.certificate.direction);
        ASSERT_EQ(batch->certificate.points, single.certificate.points);
        ASSERT_EQ(batch->interior_difference, single.interior_difference);
        ASSERT_EQ(batch->exit_travel.has_value(), single.exit_travel.has_value());
        if (!single.exit_travel) continue;
        ASSERT_EQ(batch->exit_travel->value, single.exit_travel->value);
        ASSERT_EQ(batch->exit_travel->error, single.exit_travel->error);
        ASSERT_EQ(*batch->exit_point, *single.exit_point);
      }
    }
  }
  CollideBatch({}, {}, {});  // none is a number of pairs, too
}

}  // namespace
}  // namespace touchstone::testing
