// SPDX-License-Identifier: MIT
#include "touchstone/core/convex/support_table.h"

#include <gtest/gtest.h>

#include <cfenv>
#include <cmath>

#include "touchstone/core/base/dyadic.h"
#include "touchstone/core/convex/support.h"
#include "touchstone/tests/testing/host_modes.h"
#include "touchstone/tests/testing/random.h"
#include "touchstone/tests/testing/shapes.h"

namespace touchstone {
namespace {

using Eigen::Vector3d;

Vector3d AnyDirection(const ConvexPolyhedron& body, testing::Random* random) {
  switch (random->Int(0, 4)) {
    case 0:
      return body.face_normal(random->Int(0, body.face_count() - 1));
    case 1:
      return {1.0 * random->Int(-1, 1), 1.0 * random->Int(-1, 1), 1.0 * random->Int(-1, 1)};
    case 2:
      return std::ldexp(1.0, random->Int(-1050, 1000)) * random->Direction();
    case 3:
      return body.face_normal(random->Int(0, body.face_count() - 1)) +
             std::ldexp(1.0, random->Int(-50, -15)) * random->Direction();
    default:
      return random->Direction();
  }
}

TEST(SupportTable, LanesAndTheirScalarTwinAgreeToTheBit) {
  testing::Random random(1);
  for (const auto& [name, mesh] : testing::AllShapes()) {
    SCOPED_TRACE(name);
    const ConvexPolyhedron body = testing::MustBuild(mesh);
    const SupportTable& table = body.support_table();
    for (const int mode : {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
      for (int i = 0; i < 500; ++i) {
        const Vector3d n = AnyDirection(body, &random);
        const testing::HostMode set(mode, /*flush=*/i % 2 == 1);
        ASSERT_EQ(table.Look(n[0], n[1], n[2]), table.LookByScalars(n[0], n[1], n[2]));
      }
    }
  }
}

TEST(SupportTable, ALookIsNearlyAlwaysRight) {
  testing::Random random(2);
  for (const int n : {8, 20, 32, 33, 100, 1000}) {
    const ConvexPolyhedron body = testing::MustBuild(testing::RoundBody(n, {2, 1, 1}, 5));
    const SupportTable& table = body.support_table();
    int right = 0;
    for (int i = 0; i < 1000; ++i) {
      const Vector3d d = random.Direction();
      right += table.vertex(table.Look(d[0], d[1], d[2])) == SupportVertexByScan(body, d);
    }
    EXPECT_GE(right, n <= 32 ? 999 : 960) << n;
  }
}

// The claim that proofs rest on, checked exactly: no vertex of the body is level with a certain
// peak or above it, nor would be after the change of direction that the claim allows for. Bodies
// nearly flat at their corners, directions nearly level with edges and faces.
TEST(SupportTable, ACertainPeakIsThePeak) {
  testing::Random random(3);
  long certain = 0, uncertain = 0;
  std::vector<testing::Mesh> meshes = {testing::ParaboloidLens(9),
                                       testing::Bipyramid(40, 1e-6),
                                       testing::Prism(30, 1e-3),
                                       testing::RoundBody(60, {1, 1, 1e-5}, 4),
                                       testing::RoundBody(25, {1e4, 1, 1}, 5),
                                       testing::RoundBody(300, {1, 1, 1}, 6)};
  for (const auto& [name, mesh] : testing::AllShapes()) {
    if (mesh.vertices.size() <= 400) meshes.push_back(mesh);
  }
  for (const testing::Mesh& mesh : meshes) {
    const ConvexPolyhedron body = testing::MustBuild(mesh);
    const SupportTable& table = body.support_table();
    for (int i = 0; i < 150; ++i) {
      const Vector3d n = AnyDirection(body, &random);
      if (!(n.lpNorm<1>() > 0.0)) continue;
      int steps = 0;
      const auto peak = table.Climb(random.Int(0, table.corner_count() - 1), n, &steps);
      ++(peak.certain ? certain : uncertain);
      if (!peak.certain) continue;
      const int own = table.vertex(peak.corner);
      Vector3d changed = n;
      for (int k = 0; k < 3; ++k) changed[k] += 0x1p-30 * n.lpNorm<1>() * random.Int(-1, 1);
      for (const Vector3d& d : {n, changed}) {
        const DyadicVector exact = ToDyadic(d), top = ToDyadic(body.vertex(own));
        for (int v = 0; v < body.vertex_count(); ++v) {
          if (v == own) continue;
          ASSERT_LT(Dot(exact, ToDyadic(body.vertex(v)) - top).sign(), 0)
              << "vertex " << v << " against " << own;
        }
      }
    }
  }
  EXPECT_GT(certain, 500);
  EXPECT_GT(uncertain, 500);
}

// The same for a corner that is no certain peak: no vertex lies further along than the rise says,
// for the direction or one that is off by as much as was allowed for.
TEST(SupportTable, NothingLiesAboveTheRise) {
  testing::Random random(9);
  long zero = 0, finite = 0, tight = 0;
  for (const auto& [name, mesh] : testing::AllShapes()) {
    if (mesh.vertices.size() > 400) continue;
    SCOPED_TRACE(name);
    const ConvexPolyhedron body = testing::MustBuild(mesh);
    const SupportTable& table = body.support_table();
    for (int i = 0; i < 150; ++i) {
      const Vector3d n = AnyDirection(body, &random);
      if (!(n.lpNorm<1>() > 0.0)) continue;
      int steps = 0;
      const int corner =
          i % 3 == 0 ? random.Int(0, table.corner_count() - 1) : table.Climb(0, n, &steps).corner;
      const double error = i % 2 == 0 ? 0.0 : 0x1p-33 * n.lpNorm<1>();
      const double rise = table.Rise(corner, n, error);
      if (std::isinf(rise)) continue;
      ++(rise == 0.0 ? zero : finite);
      Vector3d changed = n;
      for (int k = 0; k < 3; ++k) changed[k] += error * random.Int(-1, 1);
      const DyadicVector top = ToDyadic(body.vertex(table.vertex(corner)));
      double highest = 0.0;
      for (const Vector3d& d : {n, changed}) {
        const DyadicVector exact = ToDyadic(d);
        for (int v = 0; v < body.vertex_count(); ++v) {
          const Dyadic height = Dot(exact, ToDyadic(body.vertex(v)) - top);
          ASSERT_LE((height - Dyadic(rise)).sign(), 0) << "vertex " << v;
          highest = std::max(highest, d.dot(body.vertex(v) - body.vertex(table.vertex(corner))));
        }
      }
      tight += rise > 0.0 && highest > 0.01 * rise;
    }
  }
  EXPECT_GT(zero, 200);
  EXPECT_GT(finite, 200);
  EXPECT_GT(tight, 20);
}

#ifdef TOUCHSTONE_SANITIZED
constexpr int kManyVertices = 100'000;  // slow builds look for other faults
#else
constexpr int kManyVertices = 1'000'000;
#endif

TEST(SupportTable, AMillionVertices) {
  const int cells = static_cast<int>(std::sqrt(kManyVertices)) + 1;
  const ConvexPolyhedron body = testing::MustBuild(testing::ParaboloidLens(cells));
  ASSERT_GE(body.vertex_count(), kManyVertices);
  testing::Random random(7);
  for (int i = 0; i < 20; ++i) {
    const Vector3d n = random.Direction();
    const int expected = SupportVertexByScan(body, n);
    const int found = SupportVertex(body, n);
    EXPECT_LE(n.dot(body.vertex(expected) - body.vertex(found)), 1e-15 * body.diameter_bound());
  }
}

TEST(BoundingEllipsoid, HoldsTheBody) {
  testing::Random random(8);
  for (const auto& [name, mesh] : testing::AllShapes()) {
    SCOPED_TRACE(name);
    const ConvexPolyhedron body = testing::MustBuild(mesh);
    const BoundingEllipsoid& bound = body.bounding_ellipsoid();
    const Vector3d middle = body.interior_point(0);
    for (const Vector3d& v : body.vertices()) {
      EXPECT_LE((v - middle).norm(), bound.ball_radius);
    }
    for (int i = 0; i < 200; ++i) {
      const Vector3d n = random.Direction();
      const Vector3d y(bound.factor_xx * n[0] + bound.factor_yx * n[1] + bound.factor_zx * n[2],
                       bound.factor_yy * n[1] + bound.factor_zy * n[2], bound.factor_zz * n[2]);
      const double reach = n.dot(body.vertex(SupportVertexByScan(body, n)) - middle);
      const double limit = bound.radius * y.norm() + bound.slack;
      EXPECT_LE(reach, limit * (1 + 1e-15));
      // A bound worth having: less than the square root of three times too large, as for a box.
      EXPECT_LE(limit, 12.0 * reach);
    }
  }
}

}  // namespace
}  // namespace touchstone
