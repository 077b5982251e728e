// SPDX-License-Identifier: MIT
#include "touchstone/exact/judge_cpd.h"

#include <gtest/gtest.h>

#include "touchstone/core/cpd/mesh_penetration_depth.h"
#include "touchstone/tests/testing/random.h"
#include "touchstone/tools/shapes/shapes.h"

namespace touchstone {
namespace {

using Eigen::Vector3d;

exact::MeshDepthClaim ClaimOf(const MeshDepthResult& result) {
  return {result.translation, result.lower_bound, result.upper_bound,
          result.is_exact || result.by_boundary};
}

struct Case {
  Shape a, b;
  double reach;
};

std::vector<Case> Cases() {
  return {{Torus(8, 5, 2.0, 0.75), Star(4), 1.8},
          {Axes(4), LShape(), 1.5},
          {Dimpled(6), Spiked(6), 0.8},
          {UShape(), Key(), 1.5}};
}

TEST(JudgeMeshDepth, AnswersStand) {
  testing::Random random(41);
  int judged = 0;
  for (const Case& each : Cases()) {
    const TriangleMesh a = MustBuild(each.a), b = MustBuild(each.b);
    const ContactBody body_a(a), body_b(b);
    for (int i = 0; i < 6; ++i) {
      const RelativePose pose =
          *RelativePose::Make(random.Rotation(), each.reach * random.Direction());
      const MeshDepthResult result = MeshPenetrationDepth(MeshPair(a, b, pose), body_a, body_b);
      if (result.status == MeshDepthStatus::kSeparate) continue;
      ++judged;
      const auto findings = exact::JudgeMeshDepth(
          a, b, pose, ClaimOf(result), {.seed = 7, .facet_samples = 25, .ball_samples = 8});
      for (const std::string& finding : findings) ADD_FAILURE() << finding;
    }
  }
  EXPECT_GT(judged, 8);
}

// Faults planted: the answer shorter, the lower bound raised, NaN.
TEST(JudgeMeshDepth, FindsPlantedFaults) {
  const TriangleMesh a = MustBuild(Torus(8, 5, 2.0, 0.75)), b = MustBuild(Star(4));
  const ContactBody body_a(a), body_b(b);
  testing::Random random(43);
  int judged = 0;
  for (int i = 0; i < 8; ++i) {
    const RelativePose pose = *RelativePose::Make(random.Rotation(), 1.8 * random.Direction());
    const MeshDepthResult result = MeshPenetrationDepth(MeshPair(a, b, pose), body_a, body_b);
    if (result.status == MeshDepthStatus::kSeparate || result.upper_bound < 0.05) continue;
    ++judged;
    exact::MeshDepthClaim shorter = ClaimOf(result);
    shorter.translation *= 0.999;
    EXPECT_FALSE(exact::JudgeMeshDepth(a, b, pose, shorter).empty());
    exact::MeshDepthClaim raised = ClaimOf(result);
    raised.translation *= 1.2;
    raised.lower_bound = 1.2 * result.upper_bound;
    raised.upper_bound = raised.lower_bound * 1.001;
    EXPECT_FALSE(
        exact::JudgeMeshDepth(a, b, pose, raised, {.facet_samples = 200, .ball_samples = 60})
            .empty());
    exact::MeshDepthClaim nan = ClaimOf(result);
    nan.lower_bound = 0.0 / 0.0;
    EXPECT_FALSE(exact::JudgeMeshDepth(a, b, pose, nan).empty());
  }
  EXPECT_GT(judged, 2);
}

// Against whole boundaries by Nef polyhedra: answers stand, and faults of 1e-6 do not.
TEST(JudgeMeshDepth, ByNef) {
  const TriangleMesh a = MustBuild(UShape()), b = MustBuild(Key());
  const ContactBody body_a(a), body_b(b);
  testing::Random random(47);
  int judged = 0;
  for (int i = 0; i < 6 && judged < 2; ++i) {
    const RelativePose pose = *RelativePose::Make(random.Rotation(), 1.2 * random.Direction());
    const MeshDepthResult result = MeshPenetrationDepth(MeshPair(a, b, pose), body_a, body_b);
    if (result.status == MeshDepthStatus::kSeparate) continue;
    ++judged;
    exact::MeshDepthClaim claim = ClaimOf(result);
    for (const auto& finding : exact::JudgeMeshDepthByNef(a, b, pose, claim)) {
      ADD_FAILURE() << finding;
    }
    claim.lower_bound = claim.upper_bound = result.upper_bound * (1.0 + 1e-6);
    EXPECT_FALSE(exact::JudgeMeshDepthByNef(a, b, pose, claim).empty());
    claim.lower_bound = claim.upper_bound = result.upper_bound * (1.0 - 1e-6);
    EXPECT_FALSE(exact::JudgeMeshDepthByNef(a, b, pose, claim).empty());
  }
  EXPECT_GT(judged, 0);
}

}  // namespace
}  // namespace touchstone
