// SPDX-License-Identifier: GPL-3.0-or-later
#include "touchstone/exact/self_intersection.h"

#include <gtest/gtest.h>

#include <string>

#include "touchstone/tools/shapes/shapes.h"

namespace touchstone::exact {
namespace {

using Pair = std::pair<int, int>;

TEST(FindSelfIntersection, ShapesAreEmbedded) {
  for (const std::string& name : ShapeNames()) {
    SCOPED_TRACE(name);
    EXPECT_EQ(FindSelfIntersection(MustBuild(NamedShape(name, 200))), std::nullopt);
  }
  EXPECT_EQ(FindSelfIntersection(MustBuild(NamedShape("torus", 2000))), std::nullopt);
}

// Two boxes as one body that share no vertex: what meets is known by the offset.
TEST(FindSelfIntersection, BoxesThatCrossTouchOrStayApart) {
  const auto meet = [](const Shape& a, const Shape& b) {
    const auto found = FindSelfIntersection(MustBuild(Together(a, b)));
    if (found) {
      EXPECT_LT(found->first, 12);
      EXPECT_GE(found->second, 12);
    }
    return found.has_value();
  };
  for (const double scale : {1.0, 1e-90, 1e90}) {
    const Shape box = Box({0, 0, 0}, Eigen::Vector3d::Constant(scale));
    const auto moved = [&](double x, double y, double z) {
      return Moved(box, 1.0, scale * Eigen::Vector3d(x, y, z));
    };
    // A bar through two opposite faces.
    EXPECT_TRUE(meet(
        box, Box(scale * Eigen::Vector3d(-1, 0.25, 0.25), scale * Eigen::Vector3d(2, 0.75, 0.75))));
    EXPECT_TRUE(meet(box, moved(1, 0.5, 0.5)));  // face on face
    EXPECT_TRUE(meet(box, moved(1, 1, 0.5)));    // edge on edge
    EXPECT_FALSE(meet(box, moved(1 + 0x1p-40, 0, 0)));
    EXPECT_FALSE(meet(box, moved(3, 0, 0)));
  }
}

// A dent pushed through the far side: faces that cross are no neighbours, or share one vertex.
TEST(FindSelfIntersection, ApexPushedThroughTheFloor) {
  Shape cone = Cone(8, 1.0, 2.0);
  int apex = 0;
  for (std::size_t v = 0; v < cone.vertices.size(); ++v) {
    if (cone.vertices[v][2] > cone.vertices[apex][2]) apex = static_cast<int>(v);
  }
  ASSERT_EQ(FindSelfIntersection(MustBuild(cone)), std::nullopt);
  // Sideways far out of the base's circle: slivers pass one another, at the apex only.
  cone.vertices[apex] = {5, 0.5, 1};
  EXPECT_EQ(FindSelfIntersection(MustBuild(cone)), std::nullopt);
  // A dimpled slab whose dent comes out at the bottom.
  Shape slab = Dimpled(6);
  double low = 0.0, high = 0.0;
  for (const auto& x : slab.vertices) low = std::min(low, x[2]), high = std::max(high, x[2]);
  int dent = -1;
  for (std::size_t v = 0; v < slab.vertices.size(); ++v) {
    if (slab.vertices[v][2] > low && slab.vertices[v][2] < high) dent = static_cast<int>(v);
  }
  ASSERT_GE(dent, 0);
  slab.vertices[dent][2] = low - 1.0;
  const auto found = FindSelfIntersection(MustBuild(slab));
  ASSERT_TRUE(found.has_value());
  EXPECT_LT(found->first, found->second);
  // One ulp above the bottom they do not meet; on it they do.
  slab.vertices[dent][2] = low;
  EXPECT_TRUE(FindSelfIntersection(MustBuild(slab)).has_value());
  slab.vertices[dent][2] = low + 0x1p-50;
  EXPECT_FALSE(FindSelfIntersection(MustBuild(slab)).has_value());
}

}  // namespace
}  // namespace touchstone::exact
