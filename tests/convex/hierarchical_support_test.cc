// SPDX-License-Identifier: MIT
#include "touchstone/core/convex/hierarchical_support.h"

#include <gtest/gtest.h>

#include "touchstone/core/convex/support.h"
#include "touchstone/tests/testing/random.h"
#include "touchstone/tests/testing/shapes.h"

namespace touchstone {
namespace {

using Eigen::Vector3d;

double Height(const ConvexPolyhedron& body, const Vector3d& direction, int vertex) {
  return direction.dot(body.vertex(vertex) - body.interior_point(0));
}

TEST(HierarchicalSupport, ReachesAsFarAsTheScan) {
  testing::Random random(1);
  for (const auto& [name, mesh] : testing::AllShapes()) {
    SCOPED_TRACE(name);
    const ConvexPolyhedron body = testing::MustBuild(mesh);
    const HierarchicalSupport hierarchy(body);
    for (int i = 0; i < 100; ++i) {
      const Vector3d direction =
          i % 3 == 0 ? body.face_normal(random.Int(0, body.face_count() - 1)) : random.Direction();
      const double scan = Height(body, direction, SupportVertexByScan(body, direction));
      EXPECT_NEAR(Height(body, direction, hierarchy.Find(direction)), scan,
                  1e-15 * direction.norm() * body.diameter_bound());
    }
  }
}

// What makes it a hierarchy: few levels, each a fraction of the one below, linear in all.
TEST(HierarchicalSupport, IsLogarithmicInDepthAndLinearInSize) {
  const ConvexPolyhedron body = testing::MustBuild(testing::RoundBody(5000, {2, 1, 1}, 3));
  const HierarchicalSupport hierarchy(body);
  EXPECT_GE(hierarchy.level_count(), 10);
  EXPECT_LE(hierarchy.level_count(), 60);
  EXPECT_LE(hierarchy.bytes(), 400U * body.vertex_count());
}

// The levels do the work, not the climb that ends a query: from the vertex above it, one or two
// moves are left where a climb from anywhere takes dozens.
TEST(HierarchicalSupport, LeavesLittleToClimb) {
  const ConvexPolyhedron body = testing::MustBuild(testing::RoundBody(5000, {1, 1, 1}, 4));
  const HierarchicalSupport hierarchy(body);
  testing::Random random(5);
  int moves = 0, moves_from_anywhere = 0;
  for (int i = 0; i < 200; ++i) {
    const Vector3d direction = random.Direction();
    SupportVertex(body, direction, hierarchy.FindAboveBody(direction), &moves);
    SupportVertex(body, direction, random.Int(0, body.vertex_count() - 1), &moves_from_anywhere);
  }
  EXPECT_LT(moves, 400);
  EXPECT_GT(moves_from_anywhere, 10 * moves);
}

}  // namespace
}  // namespace touchstone
