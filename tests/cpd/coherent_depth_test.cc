// SPDX-License-Identifier: MIT
//
// Depths from a cache: what was found before may help, and changes no answer.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cstdint>

#include "touchstone/core/cpd/mesh_penetration_depth.h"
#include "touchstone/tests/cpd/depth_bodies.h"
#include "touchstone/tests/testing/poses.h"
#include "touchstone/tests/testing/random.h"
#include "touchstone/tools/shapes/paper_scenes.h"
#include "touchstone/tools/shapes/shapes.h"

namespace touchstone {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using testing::DepthBodies;
using testing::PoseOf;

// A list of features in the way, made along a slow motion, must hold all that later frames meet.
TEST(CoherentDepth, ListsOfSlowMotionsMissNothing) {
  const DepthBodies bodies(Torus(12, 8, 2.0, 0.75), Fish(9, 6));
  for (const double step : {0.0005, 0.002, 0.005}) {
    MeshDepthCache cache;
    int by_list = 0;
    for (int i = 0; i < 40; ++i) {
      const Matrix3d r =
          Eigen::AngleAxisd(step * i, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
      const RelativePose pose = PoseOf(r, {1.6, 0.3 + 0.4 * step * i, 0.1});
      const MeshDepthResult warm = bodies.Depth(pose, {}, &cache);
      by_list += warm.node_pairs == 0;
      EXPECT_NEAR(warm.upper_bound, bodies.Depth(pose).upper_bound, 1e-8) << step << ' ' << i;
    }
    EXPECT_GT(by_list, 25);
  }
}

// A motion that goes on is met by lists made ahead of it; one that turns back, halts, or shakes is
// not where they were made for. Another pair in between leaves one half made.
TEST(CoherentDepth, ListsMadeAheadMissNothing) {
  const std::uint64_t seed = 29;
  SCOPED_TRACE(seed);
  testing::Random random(seed);
  const DepthBodies others(Axes(4), Cone(40, 1.5, 4.0));
  const char* const kNames[] = {"torus", "fish", "star", "spiked", "cup", "key"};
  int by_list = 0, in_parts = 0;
  for (int round = 0; round < 12; ++round) {
    const DepthBodies bodies(NamedShape(kNames[random.Int(0, 5)], 120),
                             NamedShape(kNames[random.Int(0, 5)], 90));
    MeshDepthCache cache;
    const Vector3d axis = random.Direction(), way = random.Direction();
    const Matrix3d from = random.Rotation();
    const Vector3d start = 0.3 * random.Direction();
    const double step = 0.0004 * (1 << random.Int(0, 3));
    double at = 0.0, pace = step;
    for (int i = 0; i < 80; ++i) {
      if (i % 20 == 19) pace = step * random.Int(-2, 2);
      at += pace;
      const bool shakes = round % 3 == 2 && i % 5 == 4;
      const Vector3d shake = shakes ? Vector3d(2.0 * step * random.Direction()) : Vector3d::Zero();
      const Matrix3d turn = Eigen::AngleAxisd(at, axis).toRotationMatrix();
      const RelativePose pose = PoseOf(turn * from, start + at * way + shake);
      if (round % 4 == 3 && i % 16 == 15) others.Depth(pose, {}, &cache);
      const MeshDepthResult warm = bodies.Depth(pose, {}, &cache), cold = bodies.Depth(pose);
      by_list += warm.node_pairs == 0;
      in_parts += warm.node_pairs > 0 && 2 * warm.node_pairs < cold.node_pairs;
      EXPECT_NEAR(warm.upper_bound, cold.upper_bound, 1e-8) << round << ' ' << i;
      EXPECT_NEAR(warm.lower_bound, cold.lower_bound, 1e-8) << round << ' ' << i;
    }
  }
  EXPECT_GT(by_list, 500) << in_parts;
  EXPECT_GT(in_parts, 60) << by_list;
}

TEST(CoherentDepth, PoisonedCacheChangesNoAnswer) {
  const DepthBodies bodies(Torus(12, 8, 2.0, 0.75), Star(5));
  const DepthBodies others(Axes(4), Cone(40, 1.5, 4.0));
  testing::Random random(23);
  MeshDepthCache cache;
  for (int i = 0; i < 10; ++i) {
    others.Depth(PoseOf(random.Rotation(), random.Direction()), {}, &cache);
    const RelativePose pose = PoseOf(random.Rotation(), 1.8 * random.Direction());
    const MeshDepthResult cold = bodies.Depth(pose);
    const MeshDepthResult poisoned = bodies.Depth(pose, {}, &cache);
    EXPECT_NEAR(cold.upper_bound, poisoned.upper_bound, 1e-8);
  }
}

}  // namespace
}  // namespace touchstone
