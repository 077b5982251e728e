// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/local_sum.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "touchstone/core/mesh/membership.h"
#include "touchstone/core/minkowski/boundary.h"
#include "touchstone/tests/minkowski/local_sum_checks.h"
#include "touchstone/tests/testing/random.h"
#include "touchstone/tools/shapes/shapes.h"

namespace touchstone {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

using testing::AreAlike;
using testing::Builders;
using testing::Piece;
using testing::PiecesOf;
using testing::PoseOf;

double DistanceToTriangle(const Vector3d& x, const Vector3d& a, const Vector3d& b,
                          const Vector3d& c) {
  const auto to_segment = [&](const Vector3d& u, const Vector3d& v) {
    const double t = std::clamp((x - u).dot(v - u) / (v - u).squaredNorm(), 0.0, 1.0);
    return (x - u - t * (v - u)).norm();
  };
  const Vector3d n = (b - a).cross(c - a).normalized();
  if (n.cross(b - a).dot(x - a) >= 0 && n.cross(c - b).dot(x - b) >= 0 &&
      n.cross(a - c).dot(x - c) >= 0) {
    return std::abs(n.dot(x - a));
  }
  return std::min({to_segment(a, b), to_segment(b, c), to_segment(c, a)});
}

// Twice the area of the triangles on each facet of a sorted list.
template <class Sum>
std::vector<double> AreasByFacet(const Sum& sum, const std::vector<SumFacet>& facets) {
  std::vector<double> areas(facets.size(), 0.0);
  for (std::size_t t = 0; t < sum.triangles.size(); ++t) {
    const SumFacet& facet = sum.facets[sum.facet_of_triangle[t]];
    const auto place = std::lower_bound(facets.begin(), facets.end(), facet);
    const auto& [a, b, c] = sum.triangles[t];
    const Vector3d& o = sum.vertices[a];
    areas[place - facets.begin()] += (sum.vertices[b] - o).cross(sum.vertices[c] - o).norm();
  }
  return areas;
}

TEST(LocalSum, IsTheWholeBoundaryInABallLargerThanIt) {
  testing::Random random(41);
  for (const auto& [name_a, name_b] :
       {std::pair("star", "u"), std::pair("torus", "torus"), std::pair("slot", "key"),
        std::pair("hollow", "key"), std::pair("spoon", "cup")}) {
    for (const Matrix3d& rotation : {Matrix3d(Matrix3d::Identity()), random.Rotation()}) {
      SCOPED_TRACE(name_a);
      Builders builders(NamedShape(name_a, 100), NamedShape(name_b, 100));
      const RelativePose pose = PoseOf(rotation, random.Direction());
      ASSERT_NO_FATAL_FAILURE(builders.Compare(pose, {Vector3d::Zero(), 100.0}, true));
      const LocalSum& local = builders.sum(2).sum();
      const MeshPair pair(builders.a(), builders.b(), pose);
      const SumBoundary whole =
          BuildSumBoundary(pair, GaussMap(builders.a()), GaussMap(builders.b()));
      EXPECT_EQ(local.triangles.size(), whole.triangles.size());
      // Cells are cut into triangles from another corner, so what each facet keeps is compared.
      const std::vector<double> areas = AreasByFacet(whole, whole.facets);
      const std::vector<double> local_areas = AreasByFacet(local, whole.facets);
      for (std::size_t f = 0; f < areas.size(); ++f) {
        EXPECT_NEAR(local_areas[f], areas[f], 1e-9 * (1.0 + areas[f]));
      }
      EXPECT_EQ(local.sheets.size(), whole.sheets.size());
      EXPECT_EQ(local.segments.size(), whole.segments.size());
      EXPECT_EQ(local.points.size(), whole.points.size());
    }
  }
}

// Every triangle of the whole boundary that meets the ball is there, and none that is not of it.
TEST(LocalSum, IsTheWholeBoundaryClipped) {
  testing::Random random(42);
  std::size_t compared = 0;
  for (const auto& [name_a, name_b] :
       {std::pair("star", "u"), std::pair("axes", "dimpled"), std::pair("torus", "torus"),
        std::pair("spoon", "cup"), std::pair("tori", "hollow"), std::pair("spiked", "fish"),
        std::pair("slot", "key"), std::pair("l", "star"), std::pair("cone", "axes")}) {
    Builders builders(NamedShape(name_a, 100), NamedShape(name_b, 100));
    const RelativePose pose = PoseOf(random.Rotation(), random.Direction());
    const LocalSum whole =
        builders.sum(0).Update(pose, {Vector3d::Zero(), 100.0});  // as BuildSumBoundary: see above
    for (int i = 0; i < 8; ++i) {
      SCOPED_TRACE(std::string(name_a) + ' ' + name_b + ' ' + std::to_string(i));
      const auto& at = whole.triangles[random.Int(0, static_cast<int>(whole.triangles.size()) - 1)];
      const Ball ball{whole.vertices[at[0]] + 0.2 * random.Direction(),
                      builders.size() * random.Uniform(0.0, 0.3)};
      compared += builders.Compare(pose, ball, true);
      if (HasFatalFailure()) return;
      const LocalSum& local = builders.sum(2).sum();
      std::vector<Piece> pieces = PiecesOf(local);
      std::size_t found = 0;
      for (std::size_t t = 0; t < whole.triangles.size(); ++t) {
        const auto& [a, b, c] = whole.triangles[t];
        const Piece piece{whole.facets[whole.facet_of_triangle[t]],
                          {whole.vertices[a], whole.vertices[b], whole.vertices[c]}};
        const bool is_there = std::any_of(pieces.begin(), pieces.end(),
                                          [&](const Piece& x) { return AreAlike(x, piece, 1e-9); });
        found += is_there;
        const double distance =
            DistanceToTriangle(ball.center, piece.corners[0], piece.corners[1], piece.corners[2]);
        if (distance < ball.radius - 1e-9) {
          EXPECT_TRUE(is_there) << distance << ' ' << ball.radius;
        }
      }
      EXPECT_EQ(found, local.triangles.size());
    }
  }
  EXPECT_GT(compared, 1000u);
}

}  // namespace
}  // namespace touchstone
