// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "touchstone/core/base/dyadic.h"
#include "touchstone/core/convex/convex_polyhedron.h"
#include "touchstone/tests/testing/random.h"
#include "touchstone/tests/testing/shapes.h"

namespace touchstone {
namespace {

using Eigen::Vector3d;
using testing::Mesh;

void ExpectStrictlyInside(const ConvexPolyhedron& body, const Vector3d& point) {
  for (int f = 0; f < body.face_count(); ++f) {
    const auto [a, b, c] = body.face_plane(f);
    const DyadicVector o = ToDyadic(body.vertex(a));
    ASSERT_LT(
        Determinant(ToDyadic(body.vertex(b)) - o, ToDyadic(body.vertex(c)) - o, ToDyadic(point) - o)
            .sign(),
        0);
  }
}

TEST(InteriorPoints, TwoDistinctPointsStrictlyInside) {
  for (const auto& [name, mesh] : testing::AllShapes()) {
    SCOPED_TRACE(name);
    const ConvexPolyhedron body = testing::MustBuild(mesh);
    EXPECT_NE(body.interior_point(0), body.interior_point(1));
    ExpectStrictlyInside(body, body.interior_point(0));
    ExpectStrictlyInside(body, body.interior_point(1));
  }
}

// By (1 + 0.59 + 0.37) / 32 of the diameter at most: where the mean is too near a face for that,
// the mean itself is taken.
TEST(InteriorPoints, TheFirstIsNearTheMeanOfTheVertices) {
  for (const auto& [name, mesh] : testing::AllShapes()) {
    SCOPED_TRACE(name);
    const ConvexPolyhedron body = testing::MustBuild(mesh);
    Vector3d sum = Vector3d::Zero();
    for (const Vector3d& v : body.vertices()) sum += v;
    const Vector3d off = body.interior_point(0) - sum / body.vertex_count();
    EXPECT_LE(off.cwiseAbs().maxCoeff(), 0.0625 * body.diameter_bound());
  }
}

// Boxes a few units in the last place wide: the mean may round onto a face.
TEST(InteriorPoints, BoxesOfAFewUlps) {
  const double ulp = std::nextafter(1.0, 2.0) - 1.0;
  for (int x : {2, 3, 4, 5}) {
    for (int y : {2, 3, 100}) {
      Mesh mesh = testing::Box({1, 1, 1});
      for (Vector3d& v : mesh.vertices) {
        v = {1 + (v[0] > 0 ? x : 0) * ulp, 1 + (v[1] > 0 ? y : 0) * ulp, v[2]};
      }
      const auto body = ConvexPolyhedron::Build(mesh.vertices, mesh.faces);
      ASSERT_TRUE(body.ok()) << body.status().ToString();
      ExpectStrictlyInside(*body, body->interior_point(0));
      ExpectStrictlyInside(*body, body->interior_point(1));
    }
  }
}

// One ulp wide, between neighbouring doubles: nothing lies strictly inside.
TEST(InteriorPoints, NoneInABoxOfOneUlp) {
  Mesh mesh = testing::Box({1, 1, 1});
  for (Vector3d& v : mesh.vertices) v[0] = v[0] > 0 ? std::nextafter(1.0, 2.0) : 1.0;
  const auto body = ConvexPolyhedron::Build(mesh.vertices, mesh.faces);
  ASSERT_FALSE(body.ok());
  EXPECT_EQ(body.status().code, StatusCode::kNoInteriorPoint);
}

// A box of two ulps a side has one double inside: two are asked for.
TEST(InteriorPoints, OneIsNotEnough) {
  const double ulp = std::nextafter(1.0, 2.0) - 1.0;
  const Mesh mesh = testing::Placed(testing::Box({ulp, ulp, ulp}), 1, {1.5, 1.5, 1.5});
  const auto body = ConvexPolyhedron::Build(mesh.vertices, mesh.faces);
  ASSERT_FALSE(body.ok());
  EXPECT_EQ(body.status().code, StatusCode::kNoInteriorPoint);
  EXPECT_NE(body.status().message.find("one point"), std::string::npos);
}

// Tetrahedra of any thinness: a point or a status, never a false proof.
TEST(InteriorPoints, ThinTetrahedra) {
  testing::Random random(7);
  int found = 0, thin = 0;
  for (int i = 0; i < 3000; ++i) {
    Mesh mesh = testing::Tetrahedron();
    Vector3d middle = Vector3d::Zero();
    for (int v = 0; v < 3; ++v) {
      mesh.vertices[v] = 10 * random.Direction();
      middle += mesh.vertices[v] / 3;
    }
    mesh.vertices[3] = middle + std::ldexp(1.0, -random.Int(20, 54)) * random.Direction();
    auto body = ConvexPolyhedron::Build(mesh.vertices, mesh.faces);
    if (!body.ok() && body.status().code == StatusCode::kInconsistentOrientation) {
      std::swap(mesh.vertices[0], mesh.vertices[1]);
      body = ConvexPolyhedron::Build(mesh.vertices, mesh.faces);
    }
    if (!body.ok()) {
      if (body.status().code == StatusCode::kFlat) continue;  // rounded into one plane
      ASSERT_EQ(body.status().code, StatusCode::kNoInteriorPoint) << body.status().ToString();
      ++thin;
      continue;
    }
    ++found;
    ExpectStrictlyInside(*body, body->interior_point(0));
    ExpectStrictlyInside(*body, body->interior_point(1));
    ASSERT_NE(body->interior_point(0), body->interior_point(1));
  }
  EXPECT_GT(found, 2500);
  EXPECT_GT(thin, 0);
}

}  // namespace
}  // namespace touchstone
