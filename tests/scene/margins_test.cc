// SPDX-License-Identifier: MIT
//
// The bounds that rules rest on, against what they bound.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "touchstone/core/cd_dual/cd_dual.h"
#include "touchstone/core/proximity/distance.h"
#include "touchstone/core/proximity/penetration_depth.h"
#include "touchstone/core/scene/convex_pair_internal.h"
#include "touchstone/core/scene/mesh_margin_internal.h"
#include "touchstone/core/scene/motion_internal.h"
#include "touchstone/tests/scene/worlds.h"

namespace touchstone::testing {
namespace {

using Eigen::Vector3d;

Vector3d Image(const WorldPose& pose, const Vector3d& x) {
  return pose.rotation * x + pose.translation;
}

TEST(Motion, BoundsEveryPointAndIsZeroForNoMotion) {
  std::printf("seed 31\n");
  Random random(31);
  double tightest = 0.0;
  for (int round = 0; round < 20000; ++round) {
    const double radius = std::pow(10.0, random.Uniform(-3, 3));
    const Vector3d middle = radius * random.Uniform(0, 3) * random.Direction();
    const WorldPose from = RandomPose(random, std::pow(10.0, random.Uniform(-2, 4)));
    const double size = std::pow(10.0, random.Uniform(-12, 0));
    WorldPose to = Nudged(random, from, size, size);
    if (round % 3 == 0) to.translation = from.translation;
    if (round % 3 == 1) to.rotation = from.rotation;
    const double bound = internal::MotionBound(from, to, middle, radius);
    double furthest = 0.0;
    for (int k = 0; k < 20; ++k) {
      const Vector3d x = middle + radius * random.Direction();
      // As differences, so that the comparison does not drown in rounding.
      const Vector3d moved =
          (to.rotation - from.rotation) * x + (to.translation - from.translation);
      furthest = std::max(furthest, moved.norm());
    }
    ASSERT_LE(furthest, bound * (1 + 1e-12));
    if (bound > 0.0) tightest = std::max(tightest, furthest / bound);
    ASSERT_EQ(internal::MotionBound(from, from, middle, radius), 0.0);
  }
  EXPECT_GT(tightest, 0.95);  // measured 1.0
  WorldPose ulp = At({1, 1, 1});
  ulp.translation[2] = std::nextafter(1.0, 2.0);
  EXPECT_GE(internal::MotionBound(At({1, 1, 1}), ulp, Vector3d::Zero(), 1.0), 0x1p-52);
}

TEST(Motion, BoxesHoldTheirParts) {
  std::printf("seed 32\n");
  Random random(32);
  for (const SceneShape& shape : MixedShapes(true)) {
    for (int round = 0; round < 200; ++round) {
      const WorldPose pose = RandomPose(random, std::pow(10.0, random.Uniform(-2, 6)));
      for (int i = 0; i < shape.part_count(); ++i) {
        const ScenePart& part = shape.part(i);
        const Box3 box = internal::PlacedBox(part, pose);
        Vector3d low = Vector3d::Constant(1e300), high = -low;
        for (const Vector3d& v : part.mesh().vertices()) {
          low = low.cwiseMin(Image(pose, v));
          high = high.cwiseMax(Image(pose, v));
        }
        ASSERT_TRUE((box.low.array() <= low.array()).all());
        ASSERT_TRUE((box.high.array() >= high.array()).all());
        ASSERT_LE((box.high - box.low).maxCoeff(), 2.1 * part.outer_radius());
      }
    }
  }
}

// Margins never exceed the distance or the depth, and often come near.
TEST(Margins, AreBelowDistanceAndDepth) {
  std::printf("seed 33\n");
  Random random(33);
  const std::vector<SceneShape> shapes = {HullShape(60, 3), HullShape(10, 4), BoxShape({1, 1, 1}),
                                          BoxShape({0.1, 0.1, 2}), HullShape(300, 5)};
  long separate = 0, overlap = 0, by_guess = 0;
  double best = 0.0;
  for (int round = 0; round < 4000; ++round) {
    const ScenePart& a = shapes[random.Int(0, 4)].part(0);
    const ScenePart& b = shapes[random.Int(0, 4)].part(0);
    WorldPose pose_a = RandomPose(random, 1.5), pose_b = RandomPose(random, 1.5);
    internal::PairState state;
    SceneCounters counters;
    // The second and later looks begin with guesses.
    for (int look = 0; look < 4; ++look) {
      const internal::PlacedPart p = internal::Place(a, pose_a), q = internal::Place(b, pose_b);
      const internal::Margin margin =
          internal::DecideConvex(p, q, {}, round % 2 == 0 ? 1e300 : 0.0, &state, &counters);
      const auto pose = RelativePose::FromWorld(pose_a, pose_b);
      ASSERT_EQ(margin.verdict, Collide(a.convex(), b.convex(), *pose).verdict);
      if (margin.verdict == Verdict::kSeparate) {
        const DistanceResult distance = Distance(a.convex(), b.convex(), *pose);
        ASSERT_LE(margin.value, distance.upper * (1 + 3e-6));
        best = std::max(best, margin.value / distance.upper);
        ++separate;
      } else if (margin.verdict == Verdict::kOverlap) {
        ASSERT_LE(margin.value, PenetrationDepth(a.convex(), b.convex(), *pose).upper * (1 + 3e-6));
        ++overlap;
      }
      pose_a = Nudged(random, pose_a, 0.01, 0.01);
      pose_b = Nudged(random, pose_b, 0.01, 0.01);
    }
    by_guess += counters.by_guess;
  }
  EXPECT_GT(separate, 2000);
  EXPECT_GT(overlap, 2000);
  EXPECT_GT(by_guess, 2000);
  EXPECT_GT(best, 0.99);
}

TEST(Margins, SurfacesOfMeshes) {
  std::printf("seed 34\n");
  Random random(34);
  const SceneShape torus = MeshShape("torus", 120, 1.0), box = BoxShape({0.4, 0.5, 0.6});
  std::vector<std::pair<int, int>> stack;
  long proven = 0;
  double best = 0.0;
  for (int round = 0; round < 300; ++round) {
    const ScenePart& a = torus.part(0);
    const ScenePart& b = round % 2 == 0 ? torus.part(0) : box.part(0);
    const auto pose = RelativePose::FromWorld(RandomPose(random, 3.0), RandomPose(random, 3.0));
    const internal::MeshMargin margin(a, b, *pose);
    long nodes = 0;
    const double apart = margin.SurfacesApart(1e300, &stack, &nodes);
    if (!(apart > 0.0)) continue;
    ++proven;
    // Between vertices and points of faces: never nearer than proven.
    double nearest = 1e300;
    for (const Triangle& f : a.mesh().faces()) {
      for (const Triangle& g : b.mesh().faces()) {
        for (int k = 0; k < 3; ++k) {
          const Vector3d x = a.mesh().vertex(f[k]);
          const Vector3d y = pose->rotation() * b.mesh().vertex(g[k]) + pose->translation();
          const Vector3d z =
              pose->rotation() * (0.5 * (b.mesh().vertex(g[k]) + b.mesh().vertex(g[(k + 1) % 3]))) +
              pose->translation();
          nearest = std::min({nearest, (x - y).norm(), (x - z).norm()});
        }
      }
    }
    ASSERT_LE(apart, nearest * (1 + 1e-12));
    best = std::max(best, apart / nearest);
  }
  EXPECT_GT(proven, 30);
  EXPECT_GT(best, 0.9);
}

}  // namespace
}  // namespace touchstone::testing
