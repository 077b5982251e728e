// SPDX-License-Identifier: MIT
#include "touchstone/core/base/dyadic.h"

#include <gtest/gtest.h>

#include <bit>
#include <cfenv>
#include <cmath>
#include <limits>
#include <vector>

#include "touchstone/tests/testing/random.h"

namespace touchstone {
namespace {

using Limits = std::numeric_limits<double>;
constexpr double kInfinity = Limits::infinity();

// Doubles of every exponent, denormals and both signs among them.
double AnyDouble(testing::Random& random) {
  while (true) {
    const double x = std::bit_cast<double>(random.Bits());
    if (std::isfinite(x)) return x;
  }
}

std::vector<double> SpecialDoubles() {
  return {0.0,
          -0.0,
          1.0,
          -1.0,
          0.1,
          1e-100,
          1e100,
          1e300,
          Limits::max(),
          -Limits::max(),
          Limits::min(),
          -Limits::min(),
          Limits::denorm_min(),
          -Limits::denorm_min(),
          3 * Limits::denorm_min(),
          std::nextafter(Limits::min(), 0.0),
          1 + Limits::epsilon()};
}

TEST(Dyadic, EveryDoubleComesBackUnchanged) {
  testing::Random random(1);
  std::vector<double> values = SpecialDoubles();
  for (int i = 0; i < 20000; ++i) values.push_back(AnyDouble(random));
  for (double x : values) {
    EXPECT_EQ(Dyadic(x).ToDouble(), x);
    EXPECT_EQ(Dyadic(x).sign(), (x > 0) - (x < 0));
    EXPECT_EQ((-Dyadic(x)).ToDouble(), -x);
  }
}

TEST(Dyadic, SumsAndProductsOfDoublesRoundAsTheProcessorRounds) {
  testing::Random random(2);
  for (int i = 0; i < 50000; ++i) {
    // Near exponents, so that sums carry and cancel; products reach denormals and infinity.
    const double a = std::ldexp(random.Uniform(-1, 1), random.Int(-600, 600));
    const double b = std::ldexp(random.Uniform(-1, 1), std::ilogb(a) + random.Int(-60, 60));
    const double c = std::ldexp(random.Uniform(-1, 1), random.Int(-540, -440));
    ASSERT_EQ((Dyadic(a) + Dyadic(b)).ToDouble(), a + b);
    ASSERT_EQ((Dyadic(a) - Dyadic(b)).ToDouble(), a - b);
    ASSERT_EQ((Dyadic(a) * Dyadic(b)).ToDouble(), a * b);
    ASSERT_EQ((Dyadic(c) * Dyadic(c)).ToDouble(), c * c);
    if (b != 0) {
      ASSERT_EQ(RatioToDouble(Dyadic(a), Dyadic(b)), a / b);
      ASSERT_EQ(RatioToDouble(Dyadic(c), Dyadic(a)), c / a);
    }
  }
}

TEST(Dyadic, DenormalResultsRoundToNearestEven) {
  const Dyadic least(Limits::denorm_min());
  const Dyadic half(0.5);
  EXPECT_EQ((least * half).ToDouble(), 0.0);  // a tie, to even
  EXPECT_EQ((least * Dyadic(0.75)).ToDouble(), Limits::denorm_min());
  EXPECT_EQ((least * Dyadic(1.5)).ToDouble(), 2 * Limits::denorm_min());  // a tie, to even
  EXPECT_EQ((least * Dyadic(2.5)).ToDouble(), 2 * Limits::denorm_min());
  EXPECT_EQ((least * least).ToDouble(), 0.0);
  EXPECT_EQ((least * least).sign(), 1);
  EXPECT_EQ(RatioToDouble(least, Dyadic(2)), 0.0);
  EXPECT_EQ(RatioToDouble(least, Dyadic(-1e-300)), -Limits::denorm_min() / 1e-300);
  // The largest denormal and half a unit more is the smallest normal number.
  const double below = std::nextafter(Limits::min(), 0.0);
  EXPECT_EQ((Dyadic(below) + least * half).ToDouble(), Limits::min());
}

TEST(Dyadic, BeyondTheRangeIsInfinite) {
  const Dyadic max(Limits::max());
  EXPECT_EQ((max * max).ToDouble(), kInfinity);
  EXPECT_EQ((-(max * max)).ToDouble(), -kInfinity);
  EXPECT_EQ((max + Dyadic(std::ldexp(1.0, 970))).ToDouble(), kInfinity);  // half a unit: to even
  EXPECT_EQ((max + Dyadic(std::ldexp(0.99, 970))).ToDouble(), Limits::max());
  EXPECT_EQ(RatioToDouble(max, Dyadic(Limits::min())), kInfinity);
  EXPECT_EQ(RatioToDouble(-max, Dyadic(Limits::min())), -kInfinity);
}

TEST(Dyadic, ScaledDoubleIsNeverOutOfRange) {
  const Dyadic large = Dyadic(Limits::max()) * Dyadic(1e300) * Dyadic(-3);
  int exponent = 0;
  const double fraction = large.ToScaledDouble(&exponent);
  EXPECT_LE(fraction, -0.5);
  EXPECT_GT(fraction, -1.0);
  EXPECT_EQ(exponent, 2023);  // 1e300 = 2^996.58
  EXPECT_EQ(Dyadic().ToScaledDouble(&exponent), 0.0);
  EXPECT_EQ(exponent, 0);
  testing::Random random(3);
  for (int i = 0; i < 10000; ++i) {
    const double x = AnyDouble(random);
    int expected = 0;
    const double f = std::frexp(x, &expected);
    ASSERT_EQ(Dyadic(x).ToScaledDouble(&exponent), f);
    ASSERT_EQ(exponent, x == 0 ? 0 : expected);
  }
  // Rounding up to a power of two keeps the fraction below one.
  const Dyadic almost_one = Dyadic(1) - Dyadic(0x1p-60);
  EXPECT_EQ(almost_one.ToScaledDouble(&exponent), 0.5);
  EXPECT_EQ(exponent, 1);
}

TEST(Dyadic, SignsSurviveCancellation) {
  const Dyadic tiny(Limits::denorm_min());
  const Dyadic huge(1e300);
  EXPECT_EQ((huge + tiny - huge - tiny).sign(), 0);
  EXPECT_EQ((huge + tiny - huge).sign(), 1);
  EXPECT_EQ((huge - tiny - huge).sign(), -1);
  // (a + b)(a - b) = a^2 - b^2 where a^2 and b^2 agree in all but the last of 600 bits.
  const Dyadic a = huge + tiny, b = huge;
  EXPECT_EQ((a * a - b * b - (a + b) * (a - b)).sign(), 0);
  EXPECT_EQ((a * a - b * b).sign(), 1);
}

TEST(Dyadic, RatioIsTheNearestDouble) {
  // x / y * y is off x by less than half a unit in the last place of the quotient.
  testing::Random random(4);
  for (int i = 0; i < 10000; ++i) {
    const Dyadic a = Dyadic(random.Uniform(-1, 1)) * Dyadic(random.Uniform(-1, 1)) * Dyadic(0.3);
    const Dyadic b = Dyadic(random.Uniform(1, 2)) * Dyadic(random.Uniform(1, 2));
    const double q = RatioToDouble(a, b);
    const double ulp = std::ldexp(1.0, std::ilogb(q) - 52);
    Dyadic off = a - Dyadic(q) * b;
    if (off.sign() < 0) off = -off;
    ASSERT_LE((off - Dyadic(0.5 * ulp) * b).sign(), 0);
  }
  EXPECT_EQ(RatioToDouble(Dyadic(0), Dyadic(3)), 0.0);
  EXPECT_EQ(RatioToDouble(Dyadic(1), Dyadic(3)), 1.0 / 3.0);
}

TEST(Dyadic, RoundingModesHaveNoSay) {
  testing::Random random(5);
  for (int i = 0; i < 2000; ++i) {
    const double a = random.Uniform(-1, 1), b = random.Uniform(-1, 1);
    const double sum = a + b, product = a * b, ratio = a / b;
    for (int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
      std::fesetround(mode);
      const double sum2 = (Dyadic(a) + Dyadic(b)).ToDouble();
      const double product2 = (Dyadic(a) * Dyadic(b)).ToDouble();
      const double ratio2 = RatioToDouble(Dyadic(a), Dyadic(b));
      std::fesetround(FE_TONEAREST);
      ASSERT_EQ(sum, sum2);
      ASSERT_EQ(product, product2);
      ASSERT_EQ(ratio, ratio2);
    }
  }
}

TEST(DyadicVector, DeterminantIsAlternatingAndMultilinear) {
  testing::Random random(6);
  const auto vector = [&] {
    return ToDyadic(Eigen::Vector3d(random.Uniform(-1e10, 1e10), random.Uniform(-1e-10, 1e-10),
                                    random.Uniform(-1, 1)));
  };
  for (int i = 0; i < 200; ++i) {
    const DyadicVector a = vector(), b = vector(), c = vector(), d = vector();
    EXPECT_EQ((Determinant(a, b, c) + Determinant(b, a, c)).sign(), 0);
    EXPECT_EQ((Determinant(a + d, b, c) - Determinant(a, b, c) - Determinant(d, b, c)).sign(), 0);
    EXPECT_EQ(Determinant(a, b, a + b).sign(), 0);
    EXPECT_EQ(Dot(Cross(a, b), a).sign(), 0);
    EXPECT_EQ(Dot(Cross(a, b), b - b).sign(), 0);
  }
}

}  // namespace
}  // namespace touchstone
