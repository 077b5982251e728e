// SPDX-License-Identifier: GPL-3.0-or-later
#include "touchstone/exact/convex_hull.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "touchstone/tests/exact/shapes.h"

namespace touchstone::exact {
namespace {

TEST(ConvexHull, KeepsOnlyExtremePointsInTheirOrder) {
  // A cube with its centre, a point within a face, one within an edge, and a corner twice.
  Points points = {{0.5, 0.5, 0.5}, {1, 1, 1}, {0, 0, 0}, {0.5, 0.5, 0}, {1, 0, 0}, {0, 1, 0},
                   {0.5, 0, 0},     {0, 0, 1}, {1, 1, 0}, {1, 0, 1},     {0, 1, 1}, {1, 1, 1}};
  const ConvexPolyhedron cube = Hull(points);
  ASSERT_EQ(cube.vertex_count(), 8);
  EXPECT_EQ(cube.face_count(), 6);
  EXPECT_EQ(cube.vertices()[0], Eigen::Vector3d(1, 1, 1));
  EXPECT_EQ(cube.vertices()[7], Eigen::Vector3d(0, 1, 1));
  EXPECT_EQ(Hull(points, false).face_count(), 12);
}

TEST(ConvexHull, IsCanonical) {
  Random random(3);
  for (int round = 0; round < 50; ++round) {
    const ConvexPolyhedron hull = GridHull(&random, 20, 2, round % 2 == 0);
    std::vector<std::vector<int>> loops;
    for (int f = 0; f < hull.face_count(); ++f) {
      loops.emplace_back(hull.face(f).begin(), hull.face(f).end());
      EXPECT_EQ(loops.back()[0], *std::min_element(loops.back().begin(), loops.back().end()));
    }
    EXPECT_TRUE(std::is_sorted(loops.begin(), loops.end()));
    const Points again(hull.vertices().begin(), hull.vertices().end());
    const ConvexPolyhedron same = Hull(again, round % 2 == 0);
    EXPECT_TRUE(
        std::equal(hull.vertices().begin(), hull.vertices().end(), same.vertices().begin()));
    EXPECT_EQ(hull.face_count(), same.face_count());
  }
}

TEST(ConvexHull, SaysWhatIsWrong) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const StatusOr<ConvexPolyhedron> bad =
      ConvexHull(Points{{0, 0, 0}, {1, 0, nan}, {0, 1, 0}, {0, 0, 1}});
  EXPECT_EQ(bad.status().code, StatusCode::kNonFinite);
  EXPECT_EQ(bad.status().index, 1);
  EXPECT_EQ(ConvexHull(Points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 1, 0}}).status().code,
            StatusCode::kTooFewVertices);
  EXPECT_EQ(ConvexHull(Points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}}).status().code,
            StatusCode::kFlat);
  EXPECT_EQ(ConvexHull(Points{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}}).status().code,
            StatusCode::kFlat);
  EXPECT_EQ(ConvexHull(Points{}).status().code, StatusCode::kTooFewVertices);
}

TEST(ConvexHull, SeesAPointOneUlpOffAPlane) {
  const double up = 1 + 0x1p-52;
  const Points points = {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, up},
                         {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  EXPECT_EQ(Hull(points).face_count(), 7);  // the top alone falls into two
}

}  // namespace
}  // namespace touchstone::exact
