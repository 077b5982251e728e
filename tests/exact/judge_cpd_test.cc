// SPDX-License-Identifier: MIT
#include "touchstone/exact/judge_cpd.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "touchstone/core/cpd/continuous_penetration_depth.h"
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

// An answer of CPD as a claim; nothing where it is no projection.
std::optional<exact::PhongClaim> ClaimOf(const ContinuousPenetrationDepth& solver,
                                         const ContinuousDepthOptions& options,
                                         const ContinuousDepthResult& result, double size) {
  const auto patch = solver.patch();
  if (!patch) return std::nullopt;
  exact::PhongClaim claim;
  claim.translation = result.translation;
  claim.rounding = 0x1p-32 * size;
  claim.residual = 1e-8;
  claim.at = patch->at;
  claim.facets = patch->facets;
  claim.names = patch->names;
  claim.triangles = patch->triangles;
  claim.facet_of_triangle = patch->facet_of_triangle;
  claim.normals = options.normal_radius > 0.0 ? exact::PhongNormals::kMean
                                              : static_cast<exact::PhongNormals>(options.weights);
  claim.interpolated = options.interpolation == PhongInterpolation::kNormals;
  claim.mean_radius = result.normal_radius;
  return claim;
}

std::vector<ContinuousDepthOptions> EveryNormal() {
  return {{},
          {.weights = NormalWeights::kArea},
          {.weights = NormalWeights::kUniform},
          {.interpolation = PhongInterpolation::kNormals},
          {.normal_radius = 0.3}};
}

// Calls use(a, b, pose, claim, depth's lower bound) with answers, some of them on kept triangles.
template <class Use>
int ForPhongAnswers(const Use& use) {
  testing::Random random(61);
  int answers = 0;
  for (const Case& each : Cases()) {
    const TriangleMesh a = MustBuild(each.a), b = MustBuild(each.b);
    const ContactBody body_a(a), body_b(b);
    for (const ContinuousDepthOptions& options : EveryNormal()) {
      ContinuousPenetrationDepth solver(a, b, options);
      Eigen::Matrix3d rotation = random.Rotation();
      const Vector3d t = each.reach * random.Direction(), axis = random.Direction();
      for (int i = 0; i < 3; ++i) {
        const RelativePose pose = *RelativePose::Make(rotation, t);
        const ContinuousDepthResult result = solver.Update(pose);
        rotation = Eigen::AngleAxisd(1e-3, axis).toRotationMatrix() * rotation;
        const MeshPair pair(a, b, pose);
        const auto claim = ClaimOf(solver, options, result, 1.0 / pair.scale());
        if (!claim) continue;
        ++answers;
        use(a, b, pose, *claim, MeshPenetrationDepth(pair, body_a, body_b).lower_bound);
      }
    }
  }
  return answers;
}

TEST(JudgePhong, AnswersStand) {
  const int judged =
      ForPhongAnswers([](const TriangleMesh& a, const TriangleMesh& b, const RelativePose& pose,
                         exact::PhongClaim claim, double depth) {
        claim.depth_lower_bound = depth;
        for (const std::string& finding : exact::JudgePhong(a, b, pose, claim)) {
          ADD_FAILURE() << finding << ", normals " << static_cast<int>(claim.normals);
        }
      });
  EXPECT_GT(judged, 20);
}

// Faults planted, one at a time: each is found, and named.
TEST(JudgePhong, FindsPlantedFaults) {
  const int judged = ForPhongAnswers([](const TriangleMesh& a, const TriangleMesh& b,
                                        const RelativePose& pose, const exact::PhongClaim& claim,
                                        double depth) {
    const auto expect = [&](const exact::PhongClaim& wrong, const std::string& what) {
      const auto findings = exact::JudgePhong(a, b, pose, wrong);
      const bool is_named = std::any_of(findings.begin(), findings.end(), [&](const auto& finding) {
        return finding.find(what) != std::string::npos;
      });
      EXPECT_TRUE(is_named) << what << ", normals " << static_cast<int>(claim.normals);
    };
    exact::PhongClaim wrong = claim;
    wrong.translation *= 1.0 - 1e-6;
    expect(wrong, "not the point");
    wrong = claim;
    wrong.translation[0] = 0.0 / 0.0;
    expect(wrong, "not the point");
    // Another point of the triangle, said to be the solution.
    wrong = claim;
    wrong.at = 0.5 * claim.at + Vector3d::Constant(0.5 / 3.0);
    wrong.rounding = 1e9;
    if ((wrong.at - claim.at).norm() > 1e-3) expect(wrong, "residual");
    wrong = claim;
    wrong.residual = 0.0;
    expect(wrong, "residual");
    wrong = claim;
    wrong.depth_lower_bound = 1.0001 * claim.translation.norm();
    expect(wrong, "shorter than the depth");
    wrong.depth_lower_bound = -1.0;
    expect(wrong, "no length");
    wrong = claim;
    wrong.at = Vector3d(-0.1, 0.5, 0.6);
    expect(wrong, "below zero");
    // A triangle left out; facing inward; off its facet; of no facet at all.
    wrong = claim;
    wrong.triangles.resize(1);
    wrong.facet_of_triangle.resize(1);
    expect(wrong, "missing");
    wrong = claim;
    std::swap(wrong.triangles[0][0], wrong.triangles[0][1]);
    expect(wrong, "faces inward");
    wrong = claim;
    wrong.facet_of_triangle[0] = -1;
    expect(wrong, "no facet");
    wrong = claim;
    wrong.triangles[0][0] = 1 << 20;
    expect(wrong, "no corner");
    EXPECT_GE(claim.translation.norm(), depth * (1.0 - 1e-9));
  });
  EXPECT_GT(judged, 20);
}

// A buried facet's triangle is none of ∂M, whatever else is right of it.
TEST(JudgePhong, FindsBuriedPoints) {
  // Two boxes of which M is a box of width 4; with a dent in A, M's old top is outside of it.
  const TriangleMesh l = MustBuild(LShape()),
                     box = MustBuild(Box({-0.25, -0.25, -0.25}, {0.25, 0.25, 0.25}));
  ContinuousPenetrationDepth solver(l, box);
  testing::Random random(67);
  int judged = 0;
  for (int i = 0; i < 20; ++i) {
    const RelativePose pose = *RelativePose::Make(random.Rotation(), 1.2 * random.Direction());
    const ContinuousDepthResult result = solver.Update(pose);
    const double size = 1.0 / MeshPair(l, box, pose).scale();
    auto claim = ClaimOf(solver, {}, result, size);
    if (!claim) continue;
    // The same names at a pose half a box away: the point moves with them and is on ∂M no more, or
    // its facet's features touch no more, or M ends elsewhere.
    const RelativePose other = *RelativePose::Make(
        Eigen::AngleAxisd(1.5, random.Direction()).toRotationMatrix() * pose.rotation(),
        pose.translation());
    EXPECT_FALSE(exact::JudgePhong(l, box, other, *claim).empty());
    ++judged;
  }
  EXPECT_GT(judged, 3);
}

TEST(JudgePhong, NearestOfLocalSolutions) {
  testing::Random random(71);
  int judged = 0, passed_over = 0;
  for (const Case& each : Cases()) {
    const TriangleMesh a = MustBuild(each.a), b = MustBuild(each.b);
    ContinuousPenetrationDepth solver(a, b, {.track_branch = false});
    for (int i = 0; i < 6; ++i) {
      const RelativePose pose =
          *RelativePose::Make(random.Rotation(), each.reach * random.Direction());
      const ContinuousDepthResult result = solver.Update(pose);
      if (result.status != ContinuousDepthStatus::kFound) continue;
      const LocalSum& sum = solver.local_sum();
      ++judged;
      const double length = result.translation.norm();
      for (const std::string& finding :
           exact::FindNearerPhong(sum.vertices, sum.triangles, sum.triangle_normals, length)) {
        ADD_FAILURE() << finding;
      }
      // Told a length beyond it, the judge finds the answer itself, or another.
      passed_over += exact::FindNearerPhong(sum.vertices, sum.triangles, sum.triangle_normals,
                                            length * (1.0 + 1e-4))
                         .empty();
    }
  }
  EXPECT_GT(judged, 8);
  EXPECT_LT(passed_over, judged / 4 + 1);
}

}  // namespace
}  // namespace touchstone
