// SPDX-License-Identifier: GPL-3.0-or-later
#include "touchstone/exact/decide.h"

#include <gtest/gtest.h>

#include <cmath>

#include "touchstone/exact/convert.h"
#include "touchstone/exact/support.h"
#include "touchstone/tests/exact/shapes.h"

namespace touchstone::exact {
namespace {

TEST(Decide, BoxesOneUlpApartTouchingAndOverlapping) {
  const ExactBody box(Box({-1, -1, -1}, {1, 1, 1}));
  const auto decide = [&](double x) {
    return Decide(box, box, Pose(Eigen::Matrix3d::Identity(), {x, 0.25, 0.5}));
  };
  EXPECT_EQ(decide(2).verdict, Verdict::kTouch);
  EXPECT_EQ(decide(2).exit->face_class, FaceClass::kFaceFace);
  EXPECT_EQ(decide(2).exit->parameter, 1);
  EXPECT_EQ(decide(2).exit->exit_travel, 0.0);
  EXPECT_EQ(decide(std::nextafter(2, 3)).verdict, Verdict::kSeparate);
  EXPECT_EQ(decide(std::nextafter(2, 1)).verdict, Verdict::kOverlap);
  EXPECT_EQ(decide(0).verdict, Verdict::kOverlap);
}

TEST(Decide, ValuesOfBoxesAlongAnAxis) {
  const ExactBody box(Box({-1, -1, -1}, {1, 1, 1}), {0, 0, 0}, {0, 0, 0.5});
  const ExactDecision decision = Decide(box, box, Pose(Eigen::Matrix3d::Identity(), {5, 0, 0}));
  EXPECT_EQ(decision.verdict, Verdict::kSeparate);
  EXPECT_EQ(decision.interior_distance, 5.0);
  EXPECT_EQ(decision.interior_distance_squared, 25);
  EXPECT_EQ(decision.exit->parameter, mpq_class(2, 5));
  EXPECT_EQ(decision.exit->exit_travel, 3.0);
  EXPECT_EQ(decision.exit->signed_distance, 0.3);
  EXPECT_EQ(decision.exit->exit_point, Eigen::Vector3d(-3, 0, 0));
  EXPECT_EQ(decision.exit->normal_cosine, 1.0);
}

TEST(Decide, CoincidentInteriorPoints) {
  const ExactBody box(Box({-1, -1, -1}, {1, 1, 1}));
  const ExactDecision decision = Decide(box, box, RelativePose());
  EXPECT_EQ(decision.verdict, Verdict::kOverlap);
  EXPECT_FALSE(decision.exit.has_value());
}

// Every scale that a body may have: the same integers up to a power of two.
TEST(Decide, ScalesByPowersOfTwo) {
  Random random(5);
  for (const int e : {-330, -100, 0, 100, 330}) {
    const double scale = std::ldexp(1.0, e);
    const ConvexPolyhedron body = GridHull(&random, 8, 4, true);
    Points points;
    for (const Eigen::Vector3d& v : body.vertices()) points.push_back(scale * v);
    const ConvexPolyhedron scaled = Hull(points);
    const Eigen::Matrix3d r = RoundedRotation(&random);
    const Eigen::Vector3d t = 4 * random.OnSphere();
    const ExactBody plain(body, body.interior_point(0), body.interior_point(1));
    const ExactBody large(scaled, scale * body.interior_point(0), scale * body.interior_point(1));
    const ExactDecision a = Decide(plain, plain, Pose(r, t));
    const ExactDecision b = Decide(large, large, Pose(r, scale * t));
    EXPECT_EQ(a.verdict, b.verdict);
    EXPECT_EQ(a.exit->parameter, b.exit->parameter);
    EXPECT_EQ(scale * a.exit->exit_travel, b.exit->exit_travel);
  }
}

// The triangle returned is a proof of its own: it supports M and the ray crosses it.
TEST(Decide, ReturnsAFacetThatTheRayCrosses) {
  Random random(6);
  for (int round = 0; round < 300; ++round) {
    const bool grid = round % 2 == 0;
    const ExactBody p(grid ? GridHull(&random, 12, 3, round % 4 == 0)
                           : EllipsoidHull(&random, 30, {2, 1, 1}));
    const ExactBody q(grid ? GridHull(&random, 12, 3, round % 4 == 0)
                           : EllipsoidHull(&random, 30, {2, 1, 1}));
    const Eigen::Matrix3d r = grid ? CubeRotation(&random) : RoundedRotation(&random);
    const Eigen::Vector3d t(random.Integer(-4, 4), random.Integer(-4, 4), random.Integer(-4, 4));
    const PlacedPair pair(p.data(), q.data(), Pose(r, t), 0, 0);
    const ExactDecision decision = Decide(p, q, Pose(r, t));
    if (!decision.exit.has_value()) continue;
    std::array<IntegerVector, 3> a;
    for (int i = 0; i < 3; ++i) a[i] = pair.FromC(decision.exit->triangle[i]);
    const IntegerVector n = Cross(a[1] - a[0], a[2] - a[0]);
    EXPECT_EQ(ToRational(RatioOf(pair, n)), 1 / decision.exit->parameter);
    for (int i = 0; i < 3; ++i) {
      EXPECT_GE(sgn(Determinant(pair.v(), a[i], a[(i + 1) % 3])), 0);
      EXPECT_EQ(Dot(n, a[i]), Dot(n, pair.FromC(SupportingPair(pair, n))));
    }
  }
}

// Both bodies moved by one world pose: the same question.
TEST(Decide, WorldPosesWithOneRotationGiveTheRelativeAnswer) {
  Random random(7);
  for (int round = 0; round < 50; ++round) {
    const ExactBody p(GridHull(&random, 8, 4, true)), q(GridHull(&random, 8, 4, true));
    const Eigen::Matrix3d r = RoundedRotation(&random);
    const Eigen::Vector3d t(random.Integer(-6, 6), random.Integer(-6, 6), random.Integer(-6, 6));
    // Rp = Rq = r and tp = 0: x_p = x_q + r^-1 tq, so with t = 0 the pose is the identity exactly.
    const RelativePose world =
        RelativePose::FromWorld({r, Eigen::Vector3d::Zero()}, {r, Eigen::Vector3d::Zero()}).value();
    const ExactDecision a = Decide(p, q, world), b = Decide(p, q, RelativePose());
    ASSERT_EQ(a.exit.has_value(), b.exit.has_value());
    EXPECT_EQ(a.verdict, b.verdict);
    if (a.exit.has_value()) {
      EXPECT_EQ(a.exit->parameter, b.exit->parameter);
      EXPECT_EQ(a.exit->exit_travel, b.exit->exit_travel);
      EXPECT_EQ(a.exit->face_class, b.exit->face_class);
    }
    // World rotations by the cube's own: exact in doubles, so the plain pose says the same.
    const Eigen::Matrix3d rp = CubeRotation(&random), rq = CubeRotation(&random);
    const ExactDecision c = Decide(p, q, RelativePose::FromWorld({rp, t}, {rq, -t}).value());
    const ExactDecision d = Decide(p, q, Pose(rp.transpose() * rq, rp.transpose() * (-2 * t)));
    EXPECT_EQ(c.verdict, d.verdict);
    ASSERT_EQ(c.exit.has_value(), d.exit.has_value());
    if (c.exit.has_value()) {
      EXPECT_EQ(c.exit->parameter, d.exit->parameter);
    }
  }
}

}  // namespace
}  // namespace touchstone::exact
