// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/nearest_cells.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>
#include <string>

#include "touchstone/tests/minkowski/local_sum_checks.h"
#include "touchstone/tests/testing/random.h"

namespace touchstone {
namespace {

using Eigen::Vector3d;
using testing::PoseOf;

TEST(NearestCells, YieldsTheWholeBoundaryOnceInOrder) {
  testing::Random random(61);
  for (const auto& [name_a, name_b] : {std::pair("star", "u"), std::pair("torus", "l"),
                                       std::pair("hollow", "key"), std::pair("slot", "key")}) {
    for (const bool is_aligned : {false, true}) {
      SCOPED_TRACE(std::string(name_a) + (is_aligned ? " aligned" : ""));
      const TriangleMesh a = MustBuild(NamedShape(name_a, 40)),
                         b = MustBuild(NamedShape(name_b, 40));
      const RelativePose pose = is_aligned ? RelativePose() : PoseOf(random.Rotation());
      LocalMinkowskiSum whole(a, b, {LocalBuilder::kFull});
      const LocalSum& sum = whole.Update(pose, {Vector3d::Zero(), 1000.0});
      NearestCells cells(a, b);
      const Vector3d x = 3.0 * random.Unit() * random.Direction();
      ASSERT_TRUE(cells.Start(pose, x).ok());
      std::size_t count = 0, sheets = 0, triangles = 0;
      double last = 0.0, area = 0.0, expected_area = 0.0;
      while (const BoundaryCell* cell = cells.Next()) {
        EXPECT_GE(cell->distance, last - 1e-9);
        EXPECT_LE(cell->distance, cells.radius());
        last = cell->distance;
        sheets += cell->is_sheet;
        count += !cell->is_sheet;
        for (const auto& [u, v, w] : cell->triangles) {
          area += (v - u).cross(w - u).norm();
          triangles += !cell->is_sheet;
        }
        ASSERT_LE(count, 100000u);
      }
      EXPECT_EQ(count, static_cast<std::size_t>(sum.cell_count()));
      EXPECT_EQ(sheets, sum.sheets.size());
      EXPECT_EQ(triangles, sum.triangles.size());
      for (const auto& list : {sum.triangles, sum.sheets}) {
        for (const auto& [u, v, w] : list) {
          const Vector3d& o = sum.vertices[u];
          expected_area += (sum.vertices[v] - o).cross(sum.vertices[w] - o).norm();
        }
      }
      EXPECT_NEAR(area, expected_area, 1e-9 * expected_area);
      EXPECT_EQ(cells.Next(), nullptr);
    }
  }
}

TEST(NearestCells, AConsumerThatStopsEarlyLeavesTheRestUncut) {
  const TriangleMesh torus = MustBuild(NamedShape("torus", 400));
  testing::Random random(62);
  const RelativePose pose = PoseOf(random.Rotation());
  LocalMinkowskiSum whole(torus, torus, {LocalBuilder::kFull});
  const LocalSum& sum = whole.Update(pose, {Vector3d::Zero(), 1000.0});
  NearestCells cells(torus, torus);
  ASSERT_TRUE(cells.Start(pose, sum.vertices[0]).ok());
  for (int i = 0; i < 3; ++i) {
    const BoundaryCell* cell = cells.Next();
    ASSERT_NE(cell, nullptr);
    EXPECT_LT(cell->distance, 1e-9) << "at a vertex three cells or more";
  }
  EXPECT_LT(cells.radius(), 0.5);
}

TEST(NearestCells, BadPointsAreRefused) {
  const TriangleMesh box = MustBuild(NamedShape("box", 0));
  NearestCells cells(box, box);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(cells.Start({}, Vector3d(0, nan, 0)).code, StatusCode::kNonFinite);
  EXPECT_EQ(cells.Next(), nullptr);
  EXPECT_EQ(cells.Start({}, Vector3d(0, 1e101, 0)).code, StatusCode::kOutOfRange);
  EXPECT_EQ(cells.Next(), nullptr);
  ASSERT_TRUE(cells.Start({}, Vector3d(0, 1e3, 0)).ok());
  EXPECT_NE(cells.Next(), nullptr);
}

}  // namespace
}  // namespace touchstone
