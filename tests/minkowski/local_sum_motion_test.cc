// SPDX-License-Identifier: MIT
//
// Local sums along motions: what an update remembers must never show.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "touchstone/tests/minkowski/local_sum_checks.h"
#include "touchstone/tests/testing/random.h"
#include "touchstone/tools/shapes/shapes.h"

namespace touchstone {
namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using testing::Builders;
using testing::PoseOf;

// A point of the boundary along a ray from inside, to put a ball on.
Vector3d ExitPoint(const Builders& builders, const RelativePose& pose, const Vector3d& inside,
                   const Vector3d& direction) {
  const MeshPair pair(builders.a(), builders.b(), pose);
  double low = 0.0, high = 4.0 * builders.size();
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    const Vector3d x = inside + middle * direction;
    (Membership(pair, x).verdict == Verdict::kOverlap ? low : high) = middle;
  }
  return inside + low * direction;
}

TEST(LocalSumMotion, SmallStepsOfBodyAndBall) {
  testing::Random random(51);
  std::size_t compared = 0;
  for (const auto& [name_a, name_b] :
       {std::pair("star", "u"), std::pair("torus", "torus"), std::pair("spoon", "cup"),
        std::pair("cone", "axes"), std::pair("tori", "hollow")}) {
    SCOPED_TRACE(name_a);
    Builders builders(NamedShape(name_a, 80), NamedShape(name_b, 80));
    for (const double step : {1e-6, 1e-3, 0.02, 0.3}) {
      Matrix3d rotation = random.Rotation();
      Vector3d translation = 0.3 * random.Direction();
      const Vector3d way = random.Direction();
      Ball ball{ExitPoint(builders, PoseOf(rotation, translation), Vector3d::Zero(), way),
                0.2 * builders.size()};
      for (int i = 0; i < 12; ++i) {
        SCOPED_TRACE(std::to_string(step) + ' ' + std::to_string(i));
        // Full now and then: it is slow.
        compared += builders.Compare(PoseOf(rotation, translation), ball, i % 4 == 0);
        if (HasFatalFailure()) return;
        rotation = AngleAxisd(step, random.Direction()).toRotationMatrix() * rotation;
        translation += step * random.Direction();
        ball.center += step * random.Direction();
        ball.radius *= 1.0 + 0.1 * step * random.Uniform(-1.0, 1.0);
      }
    }
    EXPECT_GT(builders.gap_filling_reuses(), 0) << "nothing was ever reused";
  }
  EXPECT_GT(compared, 2000u);
}

// Faces and edges align exactly, just miss it, and turn over.
TEST(LocalSumMotion, FeaturesAlignAppearAndVanish) {
  std::size_t compared = 0;
  for (const auto& [name_a, name_b] :
       {std::pair("u", "key"), std::pair("slot", "l"), std::pair("dimpled", "spiked")}) {
    SCOPED_TRACE(name_a);
    Builders builders(NamedShape(name_a, 24), NamedShape(name_b, 24));
    const Ball ball{Vector3d(1.0, 0.5, 1.0), 1.0};
    const double half = 0.5 * std::numbers::pi;
    for (const double angle : {0.0, 1e-15, 1e-9, half, 2.0 * half, 0.0}) {
      for (const Vector3d& axis : {Vector3d::UnitZ().eval(), Vector3d::UnitX().eval()}) {
        SCOPED_TRACE(angle);
        compared +=
            builders.Compare(PoseOf(AngleAxisd(angle, axis).toRotationMatrix()), ball, true);
        if (HasFatalFailure()) return;
      }
    }
  }
  EXPECT_GT(compared, 200u);
}

// Fans of slivers round one vertex in one plane, walls of many coplanar faces, and bodies that turn
// about an axis that keeps such planes parallel: facets lie in one plane all along, and overlap
// there.
TEST(LocalSumMotion, CoplanarNeighboursAndFans) {
  testing::Random random(59);
  std::size_t compared = 0;
  const std::pair<Shape, Shape> pairs[] = {{Cone(8, 2.0, 3.0), Cone(6, 1.0, 2.0)},
                                           {Cone(7, 2.0, 1.0), Spiked(5)}};
  const double half_turn = std::numbers::pi;
  for (const auto& [a, b] : pairs) {
    Builders builders(a, b);
    for (const double flip : {0.0, half_turn}) {
      const Vector3d way = (Vector3d(0, 0, flip > 0.0 ? 1 : -1) + 0.1 * random.Direction());
      Ball ball{Vector3d::Zero(), 0.2 * builders.size()};
      for (const double angle :
           {0.0, 1e-12, 1e-3, 0.25 * half_turn, half_turn, half_turn + 1e-9, 0.0}) {
        SCOPED_TRACE(std::to_string(flip) + ' ' + std::to_string(angle));
        const Matrix3d rotation =
            (AngleAxisd(angle, Vector3d::UnitZ()) * AngleAxisd(flip, Vector3d::UnitX()))
                .toRotationMatrix();
        const RelativePose pose = PoseOf(rotation, Vector3d(0.25, 0.125, 0.0));
        if (angle == 0.0) ball.center = ExitPoint(builders, pose, Vector3d(0.3, 0.2, 0.1), way);
        compared += builders.Compare(pose, ball, true);
        if (HasFatalFailure()) return;
      }
    }
  }
  EXPECT_GT(compared, 150u) << "measured: 196";
}

// Where the next pose is as far as can be, and the one after it near the first again.
TEST(LocalSumMotion, HalfTurnsThereAndBack) {
  testing::Random random(60);
  std::size_t compared = 0;
  for (const auto& [name_a, name_b] :
       {std::pair("torus", "u"), std::pair("spoon", "star"), std::pair("tori", "l")}) {
    SCOPED_TRACE(name_a);
    Builders builders(NamedShape(name_a, 60), NamedShape(name_b, 36));
    const Matrix3d first = random.Rotation();
    const Vector3d axis = random.Direction();
    const Ball ball{ExitPoint(builders, PoseOf(first), Vector3d::Zero(), random.Direction()),
                    0.25 * builders.size()};
    for (int i = 0; i < 12; ++i) {
      SCOPED_TRACE(i);
      const double angle = (i % 2) * std::numbers::pi + 1e-4 * i;
      const Matrix3d rotation = AngleAxisd(angle, axis).toRotationMatrix() * first;
      compared += builders.Compare(PoseOf(rotation), ball, true);
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GT(compared, 500u);
}

TEST(LocalSumMotion, BallLeavesAndReturns) {
  testing::Random random(52);
  Builders builders(NamedShape("star", 40), NamedShape("l", 36));
  const RelativePose pose = PoseOf(random.Rotation());
  const Vector3d exit = ExitPoint(builders, pose, Vector3d::Zero(), random.Direction());
  for (int i = 0; i < 30; ++i) {
    const double away = i % 3 == 1 ? 100.0 : 1e-3 * i;
    const std::size_t count =
        builders.Compare(pose, {exit + Vector3d(away, 0, 0), 0.5}, i % 3 == 0);
    if (HasFatalFailure()) return;
    EXPECT_EQ(count > 0, i % 3 != 1);
  }
}

// The ball first lies in a pocket of the complement without any of ∂M, then grows round the whole
// closed component, which borders nothing that was known: the invariant of the paper's
// Observation 2 holds without it.
TEST(LocalSumMotion, InnerComponentAppearsWhole) {
  Builders builders(HollowBox(), Box({0, 0, 0}, {0.5, 0.5, 0.5}));
  testing::Random random(53);
  const Vector3d middle(1.75, 1.5, 1.25);  // of the cavity [1, 3] x [1, 2.5] x [1, 2] less the box
  for (int i = 0; i < 24; ++i) {
    const double angle = 1e-3 * i;
    const RelativePose pose = PoseOf(AngleAxisd(angle, Vector3d(0.6, 0.0, 0.8)).toRotationMatrix());
    const bool is_large = i % 4 != 0;
    const std::size_t count = builders.Compare(pose, {middle, is_large ? 1.2 : 0.02}, true);
    if (HasFatalFailure()) return;
    const LocalSum& sum = builders.sum(3).sum();
    if (!is_large) {
      EXPECT_EQ(count, 0u);
      continue;
    }
    ASSERT_GT(count, 10u);
    for (const auto& sides : sum.neighbors) {
      for (const int other : sides) EXPECT_GE(other, 0) << "the component is closed";
    }
  }
}

TEST(LocalSumMotion, RadiusZeroAndMoreThanTheSum) {
  testing::Random random(54);
  Builders builders(NamedShape("u", 60), NamedShape("star", 20));
  const RelativePose pose = PoseOf(random.Rotation());
  ASSERT_GT(builders.Compare(pose, {Vector3d::Zero(), 50.0}, true), 50u);
  const LocalSum whole = builders.sum(0).sum();
  ASSERT_GT(builders.Compare(pose, {Vector3d(1e99, 0, 0), 1e100}, true), 50u);
  EXPECT_EQ(builders.Compare(pose, {Vector3d(1e100, 0, 0), 1e99}, true), 0u);
  for (std::size_t v = 0; v < whole.vertices.size(); v += 7) {
    const std::size_t count = builders.Compare(pose, {whole.vertices[v], 0.0}, true);
    if (HasFatalFailure()) return;
    EXPECT_GE(count, 3u) << "the triangles round a vertex";
    const auto& [a, b, c] = whole.triangles[v % whole.triangles.size()];
    const Vector3d inside = (whole.vertices[a] + whole.vertices[b] + whole.vertices[c]) / 3.0;
    EXPECT_GE(builders.Compare(pose, {inside, 0.0}, true), 1u);
  }
}

TEST(LocalSumMotion, BadBallsAreRefusedAndForgotten) {
  Builders builders(NamedShape("l", 0), NamedShape("key", 0));
  const RelativePose pose = PoseOf(Matrix3d::Identity());
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const std::size_t count = builders.Compare(pose, {Vector3d::Zero(), 1.0}, true);
  for (const auto& [ball, code] :
       {std::pair(Ball{Vector3d(0, kNan, 0), 1.0}, StatusCode::kNonFinite),
        std::pair(Ball{Vector3d(0, 0, -kInfinity), 1.0}, StatusCode::kNonFinite),
        std::pair(Ball{Vector3d::Zero(), kNan}, StatusCode::kNonFinite),
        std::pair(Ball{Vector3d::Zero(), kInfinity}, StatusCode::kNonFinite),
        std::pair(Ball{Vector3d::Zero(), -1e-300}, StatusCode::kOutOfRange),
        std::pair(Ball{Vector3d(2e100, 0, 0), 1.0}, StatusCode::kOutOfRange)}) {
    for (int k = 0; k < 4; ++k) {
      const LocalSum& sum = builders.sum(k).Update(pose, ball);
      EXPECT_EQ(sum.status.code, code);
      EXPECT_TRUE(sum.triangles.empty() && sum.facets.empty() && sum.vertices.empty());
    }
    EXPECT_EQ(builders.Compare(pose, {Vector3d::Zero(), 1.0}, true), count);
    if (HasFatalFailure()) return;
  }
}

TEST(LocalSumMotion, NoDriftAfterTenThousandUpdates) {
  testing::Random random(55);
  const TriangleMesh a = MustBuild(NamedShape("l", 0)), b = MustBuild(NamedShape("key", 0));
  LocalMinkowskiSum filling(a, b, {LocalBuilder::kGapFilling});
  Matrix3d rotation = random.Rotation();
  Ball ball{Vector3d(0.5, 0.5, 0.5), 1.0};
  int compared = 0;
  for (int i = 0; i < 10000; ++i) {
    rotation = AngleAxisd(2e-3, random.Direction()).toRotationMatrix() * rotation;
    // Kept orthonormal: a product of ten thousand is not.
    rotation = Eigen::Quaterniond(rotation).normalized().toRotationMatrix();
    ball.center += 1e-2 * (Vector3d(0.5, 0.5, 0.5) - ball.center) + 5e-3 * random.Direction();
    const LocalSum& sum = filling.Update(PoseOf(rotation), ball);
    if (i % 1000 != 999) continue;
    LocalMinkowskiSum fresh(a, b, {LocalBuilder::kFull});
    ASSERT_NO_FATAL_FAILURE(testing::ExpectSame(fresh.Update(PoseOf(rotation), ball), sum, 1e-8));
    compared += !sum.triangles.empty();
  }
  EXPECT_GT(compared, 7);
}

TEST(LocalSumMotion, ChangesTellTheLastUpdateFromThis) {
  testing::Random random(56);
  LocalMinkowskiSum sum(MustBuild(NamedShape("star", 0)), MustBuild(NamedShape("u", 0)),
                        {LocalBuilder::kGapFilling});
  Matrix3d rotation = random.Rotation();
  std::vector<SumFacet> before;
  int kept = 0, dropped = 0, added = 0;
  for (int i = 0; i < 40; ++i) {
    const LocalSum& now = sum.Update(PoseOf(rotation), {Vector3d(1, 0, 0), 2.0});
    std::vector<SumFacet> expected;
    for (std::size_t f = 0; f < now.facets.size(); ++f) {
      const bool was = std::binary_search(before.begin(), before.end(), now.facets[f]);
      EXPECT_EQ(now.changes[f], was ? FacetChange::kKept : FacetChange::kNew);
      (was ? kept : added) += 1;
    }
    std::set_difference(before.begin(), before.end(), now.facets.begin(), now.facets.end(),
                        std::back_inserter(expected));
    EXPECT_EQ(now.dropped, expected);
    dropped += static_cast<int>(expected.size());
    before = now.facets;
    rotation = AngleAxisd(0.05, random.Direction()).toRotationMatrix() * rotation;
  }
  EXPECT_GT(kept, 100);
  EXPECT_GT(dropped, 10);
  EXPECT_GT(added, 10);
}

TEST(LocalSumMotion, RandomBallsAndPoses) {
  testing::Random random(57);
  std::size_t compared = 0;
  const char* const names[] = {"box", "l", "u", "star", "torus", "cone", "hollow", "axes", "fish"};
  for (int i = 0; i < 12; ++i) {
    const std::string name_a = names[random.Int(0, 8)], name_b = names[random.Int(0, 8)];
    SCOPED_TRACE(name_a + ' ' + name_b);
    Builders builders(NamedShape(name_a, 40), NamedShape(name_b, 40));
    for (int k = 0; k < 12; ++k) {
      const RelativePose pose = PoseOf(random.Rotation(), random.Direction());
      const Ball ball{builders.size() * random.Uniform(0.0, 1.0) * random.Direction(),
                      builders.size() * random.Uniform(0.0, 0.4)};
      compared += builders.Compare(pose, ball, true);
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GT(compared, 1500u);
}

TEST(LocalSumMotion, ScalesByPowersOfTwo) {
  testing::Random random(58);
  const Shape a = NamedShape("star", 0), b = NamedShape("u", 0);
  const Matrix3d rotation = random.Rotation();
  const Ball ball{Vector3d(1, 1, 0), 1.5};
  LocalMinkowskiSum plain(MustBuild(a), MustBuild(b), {LocalBuilder::kGapFilling});
  const LocalSum& expected = plain.Update(PoseOf(rotation), ball);
  ASSERT_GT(expected.triangles.size(), 10u);
  for (const double scale : {0x1p-320, 0x1p-3, 0x1p320}) {
    for (int k = 0; k < 4; ++k) {
      LocalMinkowskiSum sum(MustBuild(Moved(a, scale, Vector3d::Zero())),
                            MustBuild(Moved(b, scale, Vector3d::Zero())),
                            {static_cast<LocalBuilder>(k)});
      const LocalSum& scaled =
          sum.Update(PoseOf(rotation), {scale * ball.center, scale * ball.radius});
      ASSERT_EQ(scaled.triangles, expected.triangles) << scale << ' ' << k;
      for (std::size_t v = 0; v < expected.vertices.size(); ++v) {
        EXPECT_EQ(scaled.vertices[v], scale * expected.vertices[v]);
        EXPECT_LT((scaled.vertex_normals[v] - expected.vertex_normals[v]).norm(), 1e-12);
      }
    }
  }
}

}  // namespace
}  // namespace touchstone
