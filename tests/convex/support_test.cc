// SPDX-License-Identifier: MIT
#include "touchstone/core/convex/support.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cfenv>
#include <limits>
#include <set>
#include <vector>

#include "touchstone/core/base/dyadic.h"
#include "touchstone/tests/testing/random.h"
#include "touchstone/tests/testing/shapes.h"

namespace touchstone {
namespace {

using Eigen::Vector3d;

// How far the vertex found is below the best one, exactly, over the largest entry of n times the
// diameter bound.
double Shortfall(const ConvexPolyhedron& body, const Vector3d& direction, int found) {
  const DyadicVector n = ToDyadic(direction);
  const DyadicVector own = ToDyadic(body.vertex(found));
  Dyadic worst(0);
  for (const Vector3d& v : body.vertices()) {
    const Dyadic gain = Dot(n, ToDyadic(v) - own);
    if ((gain - worst).sign() > 0) worst = gain;
  }
  const double length = direction.cwiseAbs().maxCoeff();
  return RatioToDouble(worst, Dyadic(length) * Dyadic(body.diameter_bound()));
}

// Directions that make ties and near ties, beside random ones.
std::vector<Vector3d> Directions(const ConvexPolyhedron& body, testing::Random& random, int count) {
  std::vector<Vector3d> directions;
  for (int i = 0; i < count; ++i) {
    directions.push_back(random.Direction());
    directions.emplace_back(random.Int(-1, 1), random.Int(-1, 1), random.Int(-1, 1));
    const Vector3d normal = body.face_normal(random.Int(0, body.face_count() - 1));
    directions.push_back(normal);
    directions.push_back(-normal);
    directions.push_back(normal + 1e-15 * random.Direction());
    directions.push_back(std::ldexp(1.0, random.Int(-900, 900)) * normal);
    const Edge& edge = body.edge(random.Int(0, body.edge_count() - 1));
    directions.push_back(body.face_normal(edge.left) + body.face_normal(edge.right));
  }
  std::erase_if(directions, [](const Vector3d& d) { return d == Vector3d::Zero(); });
  return directions;
}

// Measured at most 1.7e-16 for the scan and 3e-16 for the rest; a height has five roundings of
// 2^-53.
constexpr double kShortfall = 1e-15;

TEST(Support, FromTheTableAndFromAnywhereNoVertexIsHigher) {
  testing::Random random(1);
  for (const auto& [name, mesh] : testing::AllShapes()) {
    SCOPED_TRACE(name);
    const ConvexPolyhedron body = testing::MustBuild(mesh);
    const int count = body.vertex_count() > 500 ? 5 : 40;
    for (const Vector3d& direction : Directions(body, random, count)) {
      EXPECT_LE(Shortfall(body, direction, SupportVertexByScan(body, direction)), kShortfall);
      EXPECT_LE(Shortfall(body, direction, SupportVertex(body, direction)), kShortfall);
      const int start = random.Int(0, body.vertex_count() - 1);
      EXPECT_LE(Shortfall(body, direction, SupportVertex(body, direction, start)), kShortfall);
    }
  }
}

// Where the best vertex is clear, all methods name it.
TEST(Support, AgreesWithTheScanWhereThereIsNoTie) {
  testing::Random random(2);
  for (const auto& [name, mesh] : testing::AllShapes()) {
    SCOPED_TRACE(name);
    const ConvexPolyhedron body = testing::MustBuild(mesh);
    for (int i = 0; i < 300; ++i) {
      const Vector3d direction = random.Direction();
      const int expected = SupportVertexByScan(body, direction);
      const double height = direction.dot(body.vertex(expected) - body.interior_point(0));
      int rivals = 0;
      for (const Vector3d& v : body.vertices()) {
        const double h = direction.dot(v - body.interior_point(0));
        rivals += height - h <= 1e-12 * body.diameter_bound();
      }
      if (rivals > 1) continue;
      EXPECT_EQ(SupportVertex(body, direction), expected);
      EXPECT_EQ(SupportVertex(body, direction, random.Int(0, body.vertex_count() - 1)), expected);
    }
  }
}

// A start inside a facet or an edge is as good as any, whatever the direction: straight down from
// the top of a cube all neighbours are level.
TEST(Support, NoPlateauHoldsAClimb) {
  for (const testing::Mesh& mesh :
       {testing::SubdividedCube(6, true), testing::SubdividedCube(6, false),
        testing::CubeWithSplitEdges(20)}) {
    const ConvexPolyhedron body = testing::MustBuild(mesh);
    for (int start = 0; start < body.vertex_count(); ++start) {
      for (int axis = 0; axis < 3; ++axis) {
        for (double sign : {-1.0, 1.0}) {
          const Vector3d direction = sign * Vector3d::Unit(axis);
          const int found = SupportVertex(body, direction, start);
          EXPECT_EQ(body.vertex(found)[axis], sign);
        }
      }
    }
  }
}

TEST(Support, OnlyCornersAreNamed) {
  testing::Random random(3);
  const ConvexPolyhedron body = testing::MustBuild(testing::SubdividedCube(8, true));
  for (int i = 0; i < 1000; ++i) {
    const int found = SupportVertex(body, random.Direction());
    EXPECT_EQ(body.vertex(found).cwiseAbs(), Vector3d::Ones());
  }
}

TEST(Support, TheLengthOfTheDirectionDoesNotMatter) {
  testing::Random random(4);
  for (const auto& [name, mesh] : testing::AllShapes()) {
    SCOPED_TRACE(name);
    const ConvexPolyhedron body = testing::MustBuild(mesh);
    for (int i = 0; i < 20; ++i) {
      const Vector3d direction = random.Direction();
      const int found = SupportVertex(body, direction);
      for (int exponent : {-1000, -500, -399, -1, 1, 399, 500, 1020}) {
        EXPECT_EQ(SupportVertex(body, std::ldexp(1.0, exponent) * direction), found) << exponent;
      }
    }
  }
}

TEST(Support, MeaninglessDirectionsStillNameAVertex) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const testing::Mesh& mesh :
       {testing::Tetrahedron(), testing::RoundBody(100, {1, 1, 1}, 1)}) {
    const ConvexPolyhedron body = testing::MustBuild(mesh);
    for (const Vector3d& direction :
         {Vector3d(0, 0, 0), Vector3d(kNan, 0, 1), Vector3d(kInfinity, 0, 0),
          Vector3d(1, -kInfinity, kNan), Vector3d(1e308, 1e308, 1e308), Vector3d(5e-324, 0, 0)}) {
      for (int start : {-1, 3}) {
        const int found = SupportVertex(body, direction, start);
        EXPECT_GE(found, 0);
        EXPECT_LT(found, body.vertex_count());
      }
    }
  }
}

TEST(Support, AnyRoundingModeWillDo) {
  testing::Random random(5);
  const ConvexPolyhedron body = testing::MustBuild(testing::RoundBody(300, {3, 1, 1}, 7));
  for (int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    for (int i = 0; i < 200; ++i) {
      const Vector3d direction = random.Direction();
      std::fesetround(mode);
      const int found = SupportVertex(body, direction);
      std::fesetround(FE_TONEAREST);
      EXPECT_LE(Shortfall(body, direction, found), 2 * kShortfall);
    }
  }
}

TEST(Support, TableStartsSaveSteps) {
  testing::Random random(6);
  const ConvexPolyhedron body = testing::MustBuild(testing::RoundBody(1000, {2, 1, 1}, 8));
  int table_steps = 0, far_steps = 0;
  constexpr int kCount = 2000;
  for (int i = 0; i < kCount; ++i) {
    const Vector3d direction = random.Direction();
    SupportVertex(body, direction, -1, &table_steps);
    SupportVertex(body, direction, 0, &far_steps);
  }
  EXPECT_LT(table_steps, 0.4 * kCount);  // measured 0.17
  EXPECT_GT(far_steps, 5 * kCount);
}

// A corner with a hundred thousand edges does not make building or one query quadratic.
TEST(Support, LargeFans) {
  testing::Random random(7);
  const ConvexPolyhedron body = testing::MustBuild(testing::Bipyramid(100000, 1));
  for (int i = 0; i < 20; ++i) {
    const Vector3d direction = random.Direction();
    const int found = SupportVertex(body, direction);
    const int expected = SupportVertexByScan(body, direction);
    EXPECT_LE(direction.dot(body.vertex(expected) - body.vertex(found)), 1e-14);
  }
}

}  // namespace
}  // namespace touchstone
