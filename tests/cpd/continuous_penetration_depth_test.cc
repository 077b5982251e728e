// SPDX-License-Identifier: MIT
#include "touchstone/core/cpd/continuous_penetration_depth.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <string>

#include "touchstone/core/cpd/mesh_penetration_depth.h"
#include "touchstone/core/mesh/membership.h"
#include "touchstone/tests/testing/random.h"
#include "touchstone/tools/shapes/shapes.h"

namespace touchstone {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

RelativePose PoseOf(const Matrix3d& rotation, const Vector3d& translation) {
  return *RelativePose::Make(rotation, translation);
}

Matrix3d Turn(double angle, const Vector3d& axis) {
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

// B moved along the translation a little short of it still overlaps, a little further it does not:
// the point is on ∂M. Steps of 1e-6 are far below the facets' size here.
void ExpectOnBoundary(const MeshPair& pair, const ContinuousDepthResult& result) {
  const Vector3d q = result.translation, out = 1e-6 * result.direction;
  EXPECT_EQ(Membership(pair, Vector3d(q - out)).verdict, Verdict::kOverlap);
  EXPECT_NE(Membership(pair, Vector3d(q + out)).verdict, Verdict::kOverlap);
}

TEST(ContinuousPenetrationDepth, AlongAMotion) {
  const TriangleMesh a = MustBuild(Torus(16, 10, 2.0, 0.75)), b = MustBuild(Fish(9, 6));
  const ContactBody body_a(a), body_b(b);
  ContinuousPenetrationDepth cpd(a, b);
  int found = 0;
  Vector3d before = Vector3d::Zero();
  int branch = -1;
  for (int i = 0; i < 60; ++i) {
    const RelativePose pose = PoseOf(Turn(0.3 + 0.002 * i, {1, 2, 3}), {1.8, 0.3, 0.1});
    const ContinuousDepthResult result = cpd.Update(pose);
    ASSERT_TRUE(result.translation.allFinite());
    ASSERT_NE(result.status, ContinuousDepthStatus::kSeparate);
    if (result.status != ContinuousDepthStatus::kFound) continue;
    ++found;
    EXPECT_LT(result.residual, 1e-12);
    const MeshPair pair(a, b, pose);
    ExpectOnBoundary(pair, result);
    const MeshDepthResult depth = MeshPenetrationDepth(pair, body_a, body_b);
    EXPECT_GE(result.translation.norm(), depth.lower_bound - 1e-9);
    EXPECT_LT((result.point_on_a - result.point_on_b - result.translation).norm(), 1e-12);
    // A branch moves by its rate, or it is another one.
    if (result.branch == branch) {
      EXPECT_LT((result.translation - before).norm(), 0.3);
    }
    branch = result.branch;
    before = result.translation;
  }
  EXPECT_GT(found, 50);
}

TEST(ContinuousPenetrationDepth, SeparateThenOverlapping) {
  const TriangleMesh a = MustBuild(Torus(16, 10, 2.0, 0.75)), b = MustBuild(Star(6));
  ContinuousPenetrationDepth cpd(a, b);
  const ContinuousDepthResult apart = cpd.Update(PoseOf(Matrix3d::Identity(), {9, 0, 0}));
  EXPECT_EQ(apart.status, ContinuousDepthStatus::kSeparate);
  EXPECT_EQ(apart.translation, Vector3d(0, 0, 0));
  const ContinuousDepthResult inside = cpd.Update(PoseOf(Turn(0.4, {1, 1, 0}), {2, 0, 0.1}));
  EXPECT_NE(inside.status, ContinuousDepthStatus::kSeparate);
  EXPECT_GT(inside.translation.norm(), 0.0);
  EXPECT_EQ(cpd.Update(PoseOf(Matrix3d::Identity(), {9, 0, 0})).status,
            ContinuousDepthStatus::kSeparate);
}

// Without a turn ∂M stands still, and the solution moves as its rate says.
TEST(ContinuousPenetrationDepth, RateOfTranslation) {
  const TriangleMesh a = MustBuild(Torus(16, 10, 2.0, 0.75)), b = MustBuild(Fish(9, 6));
  testing::Random random(31);
  int compared = 0;
  for (int i = 0; i < 12; ++i) {
    const Matrix3d r = random.Rotation();
    const Vector3d t = 1.7 * random.Direction(), step = 1e-7 * random.Direction();
    ContinuousPenetrationDepth cpd(a, b);
    const ContinuousDepthResult result = cpd.Update(PoseOf(r, t));
    if (result.status != ContinuousDepthStatus::kFound || !result.rate_of_translation) continue;
    const ContinuousDepthResult after = cpd.Update(PoseOf(r, t + step));
    if (after.status != ContinuousDepthStatus::kFound || after.branch != result.branch) continue;
    const Vector3d moved = after.translation - result.translation;
    EXPECT_LT((moved - *result.rate_of_translation * step).norm(),
              1e-3 * step.norm() * (1.0 + result.rate_of_translation->norm()));
    ++compared;
  }
  EXPECT_GT(compared, 4);
}

TEST(ContinuousPenetrationDepth, LimitAndApproximation) {
  const TriangleMesh a = MustBuild(Axes(4)), b = MustBuild(UShape());
  for (int limit = 1; limit <= 3; ++limit) {
    ContinuousPenetrationDepth cpd(a, b, {.iteration_limit = limit});
    for (int i = 0; i < 6; ++i) {
      const ContinuousDepthResult result =
          cpd.Update(PoseOf(Turn(0.37 * i, {1, 2, 0.5}), {0.4, 0.3, 0.2}));
      EXPECT_LE(result.iterations, limit);
      EXPECT_TRUE(result.translation.allFinite());
      if (result.status == ContinuousDepthStatus::kSeparate) continue;
      EXPECT_NEAR(result.direction.norm(), 1.0, 1e-12);
    }
  }
}

TEST(ContinuousPenetrationDepth, EveryOptionOfNormals) {
  const TriangleMesh a = MustBuild(Torus(12, 8, 2.0, 0.75)), b = MustBuild(Fish(9, 6));
  for (const NormalWeights weights :
       {NormalWeights::kAngle, NormalWeights::kArea, NormalWeights::kUniform}) {
    for (const auto kind : {PhongInterpolation::kTangentBasis, PhongInterpolation::kNormals}) {
      ContinuousPenetrationDepth cpd(a, b, {.weights = weights, .interpolation = kind});
      const ContinuousDepthResult result =
          cpd.Update(PoseOf(Turn(0.5, {1, 2, 3}), {1.8, 0.3, 0.1}));
      EXPECT_NE(result.status, ContinuousDepthStatus::kSeparate);
      EXPECT_TRUE(result.translation.allFinite());
    }
  }
}

}  // namespace
}  // namespace touchstone
