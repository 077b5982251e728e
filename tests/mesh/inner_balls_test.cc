// SPDX-License-Identifier: MIT
#include "touchstone/core/mesh/inner_balls.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "touchstone/core/mesh/mesh_pair.h"
#include "touchstone/core/mesh/nearest_on_triangle.h"
#include "touchstone/core/mesh/point_in_mesh_internal.h"
#include "touchstone/tools/shapes/shape.h"
#include "touchstone/tools/shapes/shapes.h"

namespace touchstone {
namespace {

using Eigen::Vector3d;

Vector3d MiddleOf(const TriangleMesh& mesh, int face) {
  const Triangle& corners = mesh.face(face);
  return (mesh.vertex(corners[0]) + mesh.vertex(corners[1]) + mesh.vertex(corners[2])) / 3.0;
}

double DistanceToSurface(const TriangleMesh& mesh, const Vector3d& x) {
  double least = std::numeric_limits<double>::infinity();
  for (int f = 0; f < mesh.face_count(); ++f) {
    const Triangle& corners = mesh.face(f);
    const Vector3d at = NearestOnTriangle(x, mesh.vertex(corners[0]), mesh.vertex(corners[1]),
                                          mesh.vertex(corners[2]));
    least = std::min(least, (at - x).norm());
  }
  return least;
}

// Every face of these has a ball, which lies within the solid and comes near the face's middle.
void ExpectGoodBalls(const TriangleMesh& mesh, const std::string& name) {
  const std::vector<InnerBall> balls = InnerBalls(mesh);
  ASSERT_EQ(std::ssize(balls), mesh.face_count()) << name;
  const MeshPair pair(mesh, mesh, RelativePose());
  for (int f = 0; f < mesh.face_count(); ++f) {
    const InnerBall& ball = balls[f];
    ASSERT_GT(ball.radius, 0.0) << name << " face " << f;
    EXPECT_LE(ball.radius, DistanceToSurface(mesh, ball.centre)) << name << " face " << f;
    EXPECT_TRUE(
        internal::TriageInside(pair.a(), pair.scale() * ball.centre, 0x1p-48).value_or(false))
        << name << " face " << f;
    const double away = (ball.centre - MiddleOf(mesh, f)).norm();
    EXPECT_LT(away, 1.04 * ball.radius + 1e-5 / pair.scale()) << name << " face " << f;
  }
}

TEST(InnerBalls, LieWithinAndComeNearTheirFaces) {
  ExpectGoodBalls(MustBuild(Box({0, 0, 0}, {1, 2, 3})), "box");
  ExpectGoodBalls(MustBuild(Axes(6)), "axes");
  ExpectGoodBalls(MustBuild(HollowBox()), "hollow box");
  ExpectGoodBalls(MustBuild(Cone(40, 1.0, 3.0)), "cone");
  ExpectGoodBalls(MustBuild(Torus(24, 10, 5.0, 2.0)), "torus");
  ExpectGoodBalls(MustBuild(InterlockedTori(16, 8)), "tori");
  ExpectGoodBalls(MustBuild(Cup(12)), "cup");
  ExpectGoodBalls(MustBuild(Gear(7)), "gear");
  ExpectGoodBalls(MustBuild(Star(9)), "star");
  ExpectGoodBalls(MustBuild(Dimpled(8)), "dimpled");
}

// What is large or small, or far from its frame's origin, is placed before it is looked at.
TEST(InnerBalls, AtAnyScale) {
  for (const double size : {1e-90, 1e-3, 1e90}) {
    Shape shape = Torus(12, 6, 5.0, 2.0);
    for (Vector3d& v : shape.vertices) v *= size;
    ExpectGoodBalls(MustBuild(shape), std::to_string(size));
  }
}

// Slivers beside each other have one ball.
TEST(InnerBalls, AreShared) {
  const std::vector<InnerBall> balls = InnerBalls(MustBuild(Cone(500, 1.0, 3.0)));
  int made = 0;
  for (std::size_t f = 1; f < balls.size(); ++f) {
    made += std::none_of(balls.begin(), balls.begin() + static_cast<std::ptrdiff_t>(f),
                         [&](const InnerBall& b) { return b.centre == balls[f].centre; });
  }
  EXPECT_LT(made, 150);  // of 1000; measured 87
}

// A wall so thin that its far side is all but as far as the near one, from beyond.
TEST(InnerBalls, WithinThinWalls) {
  for (const double thickness : {0.1, 0.01, 1e-3, 1e-4}) {
    const TriangleMesh wall = MustBuild(Box({0, 0, 0}, {1, 1, thickness}));
    const std::vector<InnerBall> balls = InnerBalls(wall);
    for (int f = 0; f < wall.face_count(); ++f) {
      EXPECT_LE(balls[f].radius, 0.5 * thickness);
      const double height = MiddleOf(wall, f)[2];
      if (height > 0.0 && height < thickness) continue;
      EXPECT_GT(balls[f].radius, 0.4 * thickness) << thickness;
      EXPECT_NEAR(balls[f].centre[2], 0.5 * thickness, 0.05 * thickness);
    }
  }
}

}  // namespace
}  // namespace touchstone
