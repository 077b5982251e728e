// SPDX-License-Identifier: MIT
#include "touchstone/tools/suites/random.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <set>
#include <vector>

#include "touchstone/tools/numbers.h"

namespace touchstone {
namespace {

TEST(Random, StreamsAreFixed) {
  // The first numbers of one stream, once and for all.
  Random random("test", 1, 2);
  const std::uint64_t first = random.Bits();
  Random again("test", 1, 2);
  EXPECT_EQ(again.Bits(), first);
  std::set<std::uint64_t> distinct = {first, Random("test", 1, 3).Bits(),
                                      Random("test", 2, 2).Bits(), Random("tesu", 1, 2).Bits(),
                                      Random("test", 2, 1).Bits()};
  EXPECT_EQ(distinct.size(), 5u);
}

TEST(Random, IntegersCoverTheirRangeEvenly) {
  Random random("test", 1, 0);
  std::array<int, 7> counts{};
  for (int i = 0; i < 70000; ++i) ++counts[static_cast<std::size_t>(random.Integer(-3, 3) + 3)];
  // Six standard deviations of a binomial: 6 sqrt(70000 / 7 * 6 / 7) = 556.
  for (const int count : counts) EXPECT_NEAR(count, 10000, 556);
}

TEST(Random, SpherePointsAreOfUnitLengthAndCentred) {
  Random random("test", 1, 0);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int i = 0; i < 10000; ++i) {
    const Eigen::Vector3d x = random.SpherePoint();
    EXPECT_NEAR(x.norm(), 1.0, 4e-16);
    sum += x;
  }
  // Each coordinate's variance is 1/3: six standard deviations of the mean.
  EXPECT_LT(sum.cwiseAbs().maxCoeff() / 10000.0, 6.0 * std::sqrt(1.0 / 3.0 / 10000.0));
}

TEST(Random, RotationsAreOrthonormalUpToRounding) {
  Random random("test", 1, 0);
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Matrix3d r = random.Rotation();
    EXPECT_LT((r.transpose() * r - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), 4e-15);
    EXPECT_GT(r.determinant(), 0.0);
  }
}

TEST(Random, AxisRotationsAreTheTwentyFour) {
  Random random("test", 1, 0);
  std::set<std::vector<double>> seen;
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Matrix3d r = random.AxisRotation();
    EXPECT_EQ(r.determinant(), 1.0);
    EXPECT_EQ(r.transpose() * r, Eigen::Matrix3d::Identity());
    seen.insert(std::vector<double>(r.data(), r.data() + 9));
  }
  EXPECT_EQ(seen.size(), 24u);
}

TEST(Numbers, AreReadWholeOrNotAtAll) {
  EXPECT_EQ(ParseDouble("1.5"), 1.5);
  EXPECT_EQ(ParseDouble("-0x1.8p-3"), -0.1875);
  EXPECT_EQ(ParseDouble("+2e3"), 2000.0);
  EXPECT_TRUE(std::isnan(*ParseDouble("nan")));
  for (const char* word : {"", "-", "1,5", "1.5x", "0x", "--1", "+-1", "1e999", " 1"})
    EXPECT_FALSE(ParseDouble(word)) << word;
}

TEST(Numbers, HexadecimalKeepsEveryBit) {
  Random random("test", 1, 0);
  for (int i = 0; i < 1000; ++i) {
    const double value = (random.Unit() - 0.5) * std::ldexp(1.0, random.Integer(-1000, 1000));
    EXPECT_EQ(ParseDouble(HexDouble(value)), value);
    EXPECT_EQ(ParseDouble(ShortDouble(value)), value);
  }
  EXPECT_EQ(HexDouble(-0.0), "-0x0p+0");
}

}  // namespace
}  // namespace touchstone
