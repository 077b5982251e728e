// SPDX-License-Identifier: GPL-3.0-or-later
#include "touchstone/exact/published_twin.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <map>

#include "touchstone/exact/decide.h"
#include "touchstone/tests/exact/shapes.h"

namespace touchstone::exact {
namespace {

using testing::IsEmpty;

// A body with the mean of its vertices as interior point.
ExactBody WithMean(const Points& points) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& x : points) mean += x;
  mean /= static_cast<double>(points.size());
  const ConvexPolyhedron hull = Hull(points, false);
  return ExactBody(hull, mean, hull.interior_point(1));
}

// Integer tetrahedra with aligned edges: SEARCH-FV and SEARCH-VF end at their maxima, and the arc test's
// strict inequalities hide every way on. Design notes, section 5; seen in doubles, exact here.
TEST(PublishedTwin, NeedlesWithAlignedEdgesAreCalledOverlapping) {
  const ExactBody p = WithMean({{-14, 1, -2}, {39, 0, -2}, {25, 2, -2}, {15, 2, 0}});
  const ExactBody q = WithMean({{-21, 2, 0}, {-38, 3, -1}, {2, 2, 0}, {0, -3, -2}});
  const RelativePose pose = Pose(Eigen::Matrix3d::Identity(), {8, -2, -2});
  const ExactDecision truth = Decide(p, q, pose);
  EXPECT_EQ(truth.verdict, Verdict::kSeparate);
  const TwinResult twin = RunPublishedTwin(p, q, pose, 0, 0, {.trace = true});
  std::printf("g %.17g, 1/s %s; twin %s, ratio %s\n", truth.exit->exit_travel,
              mpq_class(1 / truth.exit->parameter).get_str().c_str(),
              std::string(ToString(twin.result.verdict)).c_str(), twin.ratio.get_str().c_str());
  for (const Finding& f : JudgeTwin(p, q, pose, twin)) {
    std::printf("%s: %s\n", std::string(ToString(f.kind)).c_str(), f.detail.c_str());
  }
}

// What the twin finds, the judge finds in the twin's own result, and nothing else.
TEST(PublishedTwin, JudgeAndJudgeTwinAgree) {
  Random random(51);
  int failures = 0;
  for (int round = 0; round < 200; ++round) {
    const bool grid = round % 2 == 0;
    const auto body = [&] {
      return grid ? GridHull(&random, 8, 4, false) : EllipsoidHull(&random, 16, {10, 1, 1});
    };
    const ExactBody p(body()), q(body());
    const RelativePose pose = grid ? Pose(Eigen::Matrix3d::Identity(), 4 * random.OnSphere())
                                   : Pose(RoundedRotation(&random), 3 * random.OnSphere());
    const TwinResult twin = RunPublishedTwin(p, q, pose, 0, 0, {.trace = true});
    const std::vector<Finding> claims = JudgeTwin(p, q, pose, twin);
    failures += claims.empty() ? 0 : 1;
    // The claims that fail on the twin's run fail on its result, and no others.
    std::map<FindingKind, int> expected, found;
    for (const Finding& f : claims) ++expected[f.kind];
    for (const Finding& f : Judge(p, q, pose, twin.result, {.search = Search::kPublished})) ++found[f.kind];
    EXPECT_EQ(expected, found) << "round " << round;

    const TwinResult early = RunPublishedTwin(p, q, pose, 0, 0, {.early_exit = true, .trace = true});
    EXPECT_EQ(early.result.verdict, twin.result.verdict);
    EXPECT_LE(early.result.trace.size(), twin.result.trace.size());
    if (twin.result.verdict == Verdict::kSeparate) {
      EXPECT_EQ(early.result.termination, Termination::kEarlyExit);
      EXPECT_FALSE(early.result.face.has_value());
      EXPECT_THAT(Judge(p, q, pose, early.result, {.search = Search::kPublished, .early_exit = true}),
                  IsEmpty());
    }
  }
  std::printf("runs that fail a theorem: %d of 200\n", failures);
  EXPECT_GE(failures, 1);
}

// Each face of a tetrahedron neighbours every other, so steepest ascent cannot stick.
TEST(PublishedTwin, TetrahedraNeverFailTheoremsOneAndTwo) {
  Random random(52);
  for (int round = 0; round < 300; ++round) {
    const auto tetrahedron = [&] {
      while (true) {
        const ConvexPolyhedron hull = GridHull(&random, 4, 5, false);
        if (hull.vertex_count() == 4) return hull;
      }
    };
    const ExactBody p(tetrahedron()), q(tetrahedron());
    const RelativePose pose = Pose(Eigen::Matrix3d::Identity(), 6 * random.OnSphere());
    const TwinResult twin = RunPublishedTwin(p, q, pose);
    for (const Finding& f : JudgeTwin(p, q, pose, twin)) {
      EXPECT_EQ(f.detail.find("SEARCH-FV"), std::string::npos);
      EXPECT_EQ(f.detail.find("SEARCH-VF"), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace touchstone::exact
