// SPDX-License-Identifier: MIT
#include "touchstone/core/base/orientation.h"

#include <gtest/gtest.h>

#include <cfenv>
#include <cmath>
#include <vector>

#include "touchstone/core/base/dyadic.h"
#include "touchstone/tests/testing/random.h"

namespace touchstone {
namespace {

using Eigen::Vector3d;

int SideByDyadic(const std::vector<Vector3d>& v) {
  const DyadicVector o = ToDyadic(v[0]);
  return Determinant(ToDyadic(v[1]) - o, ToDyadic(v[2]) - o, ToDyadic(v[3]) - o).sign();
}

double MaxCoordinate(const std::vector<Vector3d>& vertices) {
  double max = 0.0;
  for (const Vector3d& v : vertices) max = std::max(max, v.cwiseAbs().maxCoeff());
  return max;
}

// Four points within a few units in the last place of one plane, at any legal size.
std::vector<Vector3d> NearlyCoplanar(testing::Random& random) {
  std::vector<Vector3d> v;
  const double scale = std::ldexp(1.0, random.Int(-330, 330));
  for (int i = 0; i < 3; ++i) v.push_back(scale * random.Direction());
  const double s = random.Unit(), t = random.Unit();
  v.push_back(v[0] + s * (v[1] - v[0]) + t * (v[2] - v[0]));
  if (random.Int(0, 3) == 0) v[3] = 0.5 * (v[0] + v[1]);
  return v;
}

TEST(Orientation, AgreesWithBigNumbersInEveryRoundingMode) {
  testing::Random random(1);
  int zeros = 0, decided_in_doubles = 0;
  constexpr int kCount = 20000;
  for (int i = 0; i < kCount; ++i) {
    std::vector<Vector3d> v = NearlyCoplanar(random);
    if (i % 2 == 0) v[3] += 1e-12 * v[0].norm() * random.Direction();
    const int expected = SideByDyadic(v);
    const double max = MaxCoordinate(v);
    if (max < 1e-100 || max > 1e100) continue;
    for (int mode : {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
      std::fesetround(mode);
      const Orientation orientation(v, max);
      const int side = orientation.ExactSide({0, 1, 2}, 3);
      const Estimate estimate = Orientation::TriageSide(orientation.point(0), orientation.point(1),
                                                        orientation.point(2), orientation.point(3));
      std::fesetround(FE_TONEAREST);
      ASSERT_EQ(side, expected);
      if (std::abs(estimate.value) > estimate.error) {
        ASSERT_EQ((estimate.value > 0) - (estimate.value < 0), expected);
        ++decided_in_doubles;
      }
    }
    zeros += expected == 0;
  }
  EXPECT_GT(zeros, 100);
  EXPECT_GT(decided_in_doubles, kCount);  // of 4 kCount: the half moved off the plane by 1e-12
}

TEST(Orientation, TurnAgreesWithBigNumbers) {
  testing::Random random(2);
  for (int i = 0; i < 20000; ++i) {
    std::vector<Vector3d> v = NearlyCoplanar(random);
    const double max = MaxCoordinate(v);
    if (max < 1e-100 || max > 1e100) continue;
    if (i % 2 == 0) v[2] = v[0] + 0.7 * (v[1] - v[0]);  // nearly collinear
    const DyadicVector o = ToDyadic(v[0]);
    const DyadicVector cross = Cross(ToDyadic(v[1]) - o, ToDyadic(v[2]) - o);
    const Orientation orientation(v, max);
    for (int axis = 0; axis < 3; ++axis) {
      ASSERT_EQ(orientation.ExactTurn(0, 1, 2, axis), cross[axis].sign());
    }
  }
}

// Coordinates so unequal that their scaled copies underflow.
TEST(Orientation, TinyCoordinatesBesideLargeOnes) {
  const std::vector<Vector3d> v = {
      {0, 0, 0}, {1e100, 0, 0}, {0, 1e-300, 0}, {0, 0, 1e-300}, {1e100, 1e-300, -1e-320}};
  const Orientation orientation(v, 1e100);
  EXPECT_EQ(orientation.ExactSide({0, 1, 2}, 3), 1);
  EXPECT_EQ(orientation.ExactSide({0, 1, 2}, 4), -1);
  EXPECT_EQ(orientation.ExactTurn(0, 1, 2, 2), 1);
  EXPECT_EQ(orientation.ExactTurn(0, 2, 3, 0), 1);
}

}  // namespace
}  // namespace touchstone
