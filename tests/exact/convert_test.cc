// SPDX-License-Identifier: GPL-3.0-or-later
#include "touchstone/exact/convert.h"

#include <gtest/gtest.h>

#include <cmath>

#include "touchstone/tests/exact/shapes.h"

namespace touchstone::exact {
namespace {

mpq_class Exact(double value) { return mpq_class(value); }

TEST(Integer, SplitsAndRestoresEveryKindOfDouble) {
  for (const double value :
       {1.0, -3.0, 0.1, 5e-324, -2.2e-308, 1e100, 1.7976931348623157e308, 6.0}) {
    const SplitDouble split = Split(value);
    EXPECT_EQ(std::ldexp(static_cast<double>(split.mantissa), split.exponent), value);
    EXPECT_NE(split.mantissa % 2, 0);
  }
  EXPECT_EQ(Split(0.0).mantissa, 0);
  EXPECT_EQ(Split(-0.0).mantissa, 0);
}

TEST(Integer, DirectionKeepsComponentsWithinTwoUnits) {
  const IntegerVector v = {Integer("123456789012345678901234567890"), Integer(-7), Integer(0)};
  long exponent = 0;
  const Eigen::Vector3d d = ToDirection(v, &exponent);
  EXPECT_GE(std::abs(d.x()), 0.5);
  EXPECT_LT(std::abs(d.x()), 1.0);
  EXPECT_EQ(std::ldexp(d.y(), static_cast<int>(exponent)), -7.0);
  EXPECT_EQ(d.z(), 0.0);
}

// Every difference of a placed pair equals the same sum in plain fractions.
TEST(PlacedPair, PlacesVerticesExactly) {
  Random random(11);
  for (int round = 0; round < 20; ++round) {
    const ExactBody p(EllipsoidHull(&random, 8, {1, 2, 3})),
        q(EllipsoidHull(&random, 8, {3, 1, 1e-3}));
    const Eigen::Matrix3d r = RoundedRotation(&random);
    const Eigen::Vector3d t(random.Real(-1, 1), random.Real(-1e9, 1e9), random.Real(-1e-9, 1e-9));
    const PlacedPair pair(p.data(), q.data(), Pose(r, t), 0, 1);
    // One unit of the integers, from a number known both ways.
    const auto exact = [&](int a, int b, int k) {
      mpq_class value = Exact(p.body().vertices()[a][k]) - Exact(t[k]);
      for (int j = 0; j < 3; ++j) value -= Exact(r(k, j)) * Exact(q.body().vertices()[b][j]);
      return value;
    };
    const mpq_class unit = exact(0, 0, 1) / mpq_class(pair.Difference({0, 0})[1]);
    for (int a = 0; a < 4; ++a) {
      for (int k = 0; k < 3; ++k) {
        EXPECT_EQ(mpq_class(pair.Difference({a, a + 1})[k]) * unit, exact(a, a + 1, k));
      }
    }
    EXPECT_NEAR(pair.ToLength(Real(pair.c()[1])).ToDouble(), pair.c_double()[1],
                1e-12 * std::abs(pair.c_double()[1]));
  }
}

// x_p = Rp^-1 (Rq x_q + tq - tp): applying Rp to a difference must give the world difference.
TEST(PlacedPair, PlacesWorldPosesExactly) {
  Random random(12);
  for (int round = 0; round < 20; ++round) {
    const ExactBody p(EllipsoidHull(&random, 6, {1, 2, 3})),
        q(EllipsoidHull(&random, 6, {3, 1, 1}));
    const WorldPose wp{RoundedRotation(&random), 10 * random.OnSphere()};
    const WorldPose wq{RoundedRotation(&random), 10 * random.OnSphere()};
    const PlacedPair pair(p.data(), q.data(), RelativePose::FromWorld(wp, wq).value(), 0, 0);
    const IntegerVector d = pair.Difference({1, 2});
    std::array<mpq_class, 3> scaled, world;
    for (int k = 0; k < 3; ++k) {
      world[k] = Exact(wp.translation[k]) - Exact(wq.translation[k]);
      for (int j = 0; j < 3; ++j) {
        scaled[k] += Exact(wp.rotation(k, j)) * mpq_class(d[j]);
        world[k] += Exact(wp.rotation(k, j)) * Exact(p.body().vertices()[1][j]) -
                    Exact(wq.rotation(k, j)) * Exact(q.body().vertices()[2][j]);
      }
    }
    EXPECT_EQ(scaled[0] * world[1], scaled[1] * world[0]);
    EXPECT_EQ(scaled[1] * world[2], scaled[2] * world[1]);
    EXPECT_GT(sgn(scaled[0]) * sgn(world[0]), 0);
    EXPECT_NEAR(pair.ToLength(Real(d[0])).ToDouble(),
                (scaled[0] == 0 ? 0.0 : mpq_class(world[0] / scaled[0] * d[0]).get_d()), 1e-12);
  }
}

TEST(ExactBody, NumbersEdgesByFirstAppearance) {
  const ExactBody box(Box({0, 0, 0}, {1, 1, 1}));
  ASSERT_EQ(box.edge_count(), 12);
  const std::span<const int> first = box.body().face(0);
  EXPECT_EQ(box.edge(0), std::pair(first[0], first[1]));
  EXPECT_EQ(box.edge(3), std::pair(first[3], first[0]));
}

TEST(ExactBody, ProvesInteriorPoints) {
  const ConvexPolyhedron box = Box({0, 0, 0}, {1, 1, 1});
  EXPECT_TRUE(ExactBody(box).InteriorPointIsInterior(0));
  EXPECT_TRUE(ExactBody(box).InteriorPointIsInterior(1));
  EXPECT_FALSE(ExactBody(box, {0.5, 0.5, 1.0}, {0.5, 0.5, 0.5}).InteriorPointIsInterior(0));
  EXPECT_TRUE(ExactBody(box, {0.5, 0.5, 1 - 0x1p-53}, {0, 0, 0}).InteriorPointIsInterior(0));
  EXPECT_FALSE(ExactBody(box, {0.5, 0.5, 0.5}, {0, 0, 0}).InteriorPointIsInterior(1));
}

}  // namespace
}  // namespace touchstone::exact
