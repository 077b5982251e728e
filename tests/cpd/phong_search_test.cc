// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "touchstone/core/cpd/phong_search_internal.h"
#include "touchstone/tests/testing/random.h"

namespace touchstone {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using internal::AtCorner;
using internal::FindZeros;
using internal::QuarticIndex;
using internal::Quartics;
using internal::QuarticZeros;

// Coefficients of a product of four affine functions, each by its values at the corners.
std::array<double, 15> Product(const std::array<Vector3d, 4>& factors) {
  std::map<std::array<int, 3>, double> product = {{{0, 0, 0}, 1.0}};
  for (int n = 0; n < 4; ++n) {
    std::map<std::array<int, 3>, double> next;
    for (const auto& [powers, value] : product) {
      for (int c = 0; c < 3; ++c) {
        std::array<int, 3> raised = powers;
        ++raised[c];
        next[raised] += raised[c] / (n + 1.0) * factors[n][c] * value;
      }
    }
    product = next;
  }
  std::array<double, 15> coefficients;
  double largest = 0.0;
  for (const auto& [powers, value] : product) largest = std::max(largest, std::abs(value));
  for (const auto& [powers, value] : product) {
    coefficients[QuarticIndex(powers[0], powers[2])] = value / largest;
  }
  return coefficients;
}

constexpr std::array<AtCorner, 3> kNothing = {};

// λ_1 - u and λ_2 - v, values at corners.
Vector3d AcrossFirst(double u) { return {-u, 1.0 - u, -u}; }
Vector3d AcrossSecond(double v) { return {-v, -v, 1.0 - v}; }

int CountNear(const QuarticZeros& zeros, const Vector2d& at, double distance) {
  return static_cast<int>(
      std::count_if(zeros.zeros.begin(), zeros.zeros.begin() + zeros.count, [&](const auto& zero) {
        return zero.is_simple && (Vector2d(zero.at[1], zero.at[2]) - at).norm() < distance;
      }));
}

// Sixteen, as many as quartics have: where lines of two directions cross, sheared.
TEST(PhongSearch, FindsEveryCrossingOfLines) {
  testing::Random random(3);
  int most = 0;
  for (int i = 0; i < 300; ++i) {
    std::array<double, 4> u, v;
    for (double& x : u) x = random.Uniform(-0.1, i % 3 == 0 ? 0.45 : 0.9);
    for (double& x : v) x = random.Uniform(-0.1, i % 3 == 0 ? 0.45 : 0.9);
    const double apart = [&] {
      double least = 1.0;
      for (const auto* values : {&u, &v}) {
        for (int a = 0; a < 4; ++a) {
          for (int b = 0; b < a; ++b) {
            least = std::min(least, std::abs((*values)[a] - (*values)[b]));
          }
        }
      }
      return least;
    }();
    if (apart < 1e-3) continue;
    Quartics quartics;
    quartics.x =
        Product({AcrossFirst(u[0]), AcrossFirst(u[1]), AcrossFirst(u[2]), AcrossFirst(u[3])});
    quartics.y =
        Product({AcrossSecond(v[0]), AcrossSecond(v[1]), AcrossSecond(v[2]), AcrossSecond(v[3])});
    // Sums and differences: neither vanishes on lines any more.
    for (int c = 0; c < 15; ++c) {
      const double x = quartics.x[c], y = quartics.y[c];
      quartics.x[c] = 0.5 * (x + 0.7 * y);
      quartics.y[c] = 0.5 * (0.3 * x - y);
    }
    const QuarticZeros zeros = FindZeros(quartics, kNothing);
    EXPECT_TRUE(zeros.is_complete) << i;
    int inside = 0;
    for (const double x : u) {
      for (const double y : v) {
        const double least = std::min({x, y, 1.0 - x - y});
        if (least < 0.0) continue;
        ++inside;
        EXPECT_EQ(CountNear(zeros, {x, y}, 1e-6), 1) << i << ' ' << x << ' ' << y;
      }
    }
    most = std::max(most, inside);
    // Others are beyond a side.
    for (int z = 0; z < zeros.count; ++z) {
      const Vector3d& at = zeros.zeros[z].at;
      double nearest = 1.0;
      for (const double x : u) {
        for (const double y : v) nearest = std::min(nearest, Vector2d(at[1] - x, at[2] - y).norm());
      }
      EXPECT_LT(nearest, 1e-6) << i;
    }
  }
  EXPECT_EQ(most, 16);
}

// Zeros on sides and at corners are as much the triangle's as others.
TEST(PhongSearch, FindsZerosOnSidesAndAtCorners) {
  for (const double u : {0.0, 0.25, 1.0 / 3.0, 0.5, 1.0}) {
    for (const double v : {0.0, 0.25, 1.0 / 3.0, 0.5, 1.0}) {
      if (u + v > 1.0) continue;
      for (const double off : {0.0, 1e-17, -1e-16, 1e-12, -9e-10}) {
        Quartics quartics;
        quartics.x = Product({AcrossFirst(u + off), {2, 2, 2}, {1, 2, 3}, {1, 1, 1}});
        quartics.y = Product({AcrossSecond(v + off), {1, 1, 1}, {3, 1, 2}, {1, 1, 1}});
        const QuarticZeros zeros = FindZeros(quartics, kNothing);
        EXPECT_TRUE(zeros.is_complete);
        EXPECT_EQ(CountNear(zeros, {u, v}, 1e-8), 1) << u << ' ' << v << ' ' << off;
      }
    }
  }
}

// Two zeros that come together: told apart until some 1e-5, one place after that, never passed
// over.
TEST(PhongSearch, LeavesWhatIsMultiple) {
  for (int e = 1; e <= 17; ++e) {
    const double apart = std::pow(10.0, -e) * (e < 17);
    Quartics quartics;
    quartics.x = Product({AcrossFirst(0.31), AcrossFirst(0.31 + apart), {1, 2, 2}, {1, 1, 1}});
    quartics.y = Product({AcrossSecond(0.2), {1, 1, 2}, {3, 1, 2}, {1, 1, 1}});
    const QuarticZeros zeros = FindZeros(quartics, kNothing);
    if (zeros.is_complete) {
      EXPECT_EQ(zeros.count, 2) << e;
      EXPECT_LE(e, 5);
    } else {
      EXPECT_GE(e, 4) << e;
      ASSERT_GE(zeros.count, 1) << e;
      for (int z = 0; z < zeros.count; ++z) {
        EXPECT_LT((zeros.zeros[z].at - Vector3d(0.49, 0.31, 0.2)).norm(), 1e-3) << e;
      }
    }
    EXPECT_LT(zeros.cells, 2000) << e;
  }
  // None, but by less than roundings tell.
  Quartics quartics;
  quartics.x = Product({AcrossFirst(0.31), AcrossFirst(0.31), {1, 1, 1}, {1, 1, 1}});
  for (double& x : quartics.x) x += 1e-15;
  quartics.y = Product({AcrossSecond(0.2), {1, 1, 2}, {3, 1, 2}, {1, 1, 1}});
  EXPECT_FALSE(FindZeros(quartics, kNothing).is_complete);
  // None, and told.
  for (double& x : quartics.x) x += 1e-9;
  const QuarticZeros none = FindZeros(quartics, kNothing);
  EXPECT_TRUE(none.is_complete);
  EXPECT_EQ(none.count, 0);
}

TEST(PhongSearch, EndsWhereNothingIsToBeTold) {
  Quartics quartics;
  quartics.x.fill(0.0);
  quartics.y.fill(0.0);
  EXPECT_FALSE(FindZeros(quartics, kNothing).is_complete);
  quartics.x = Product({AcrossFirst(0.3), {1, 1, 1}, {1, 1, 1}, {1, 1, 1}});
  quartics.y = quartics.x;  // a line of zeros
  const QuarticZeros line = FindZeros(quartics, kNothing);
  EXPECT_FALSE(line.is_complete);
  EXPECT_LE(line.cells, 2049);
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    quartics.x[3] = bad;
    EXPECT_FALSE(FindZeros(quartics, kNothing).is_complete);
    EXPECT_EQ(FindZeros(quartics, kNothing).count, 0);
  }
}

}  // namespace
}  // namespace touchstone
