// SPDX-License-Identifier: MIT
#include "touchstone/core/cpd/translational_collision.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "touchstone/core/cpd/contact_body.h"
#include "touchstone/core/cpd/contact_space_projection.h"
#include "touchstone/core/cpd/mesh_penetration_depth.h"
#include "touchstone/core/mesh/membership.h"
#include "touchstone/tests/testing/random.h"
#include "touchstone/tools/shapes/shapes.h"

namespace touchstone {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

TEST(TranslationalCollision, BoxOntoBox) {
  const TriangleMesh box = MustBuild(Box({0, 0, 0}, {1, 1, 1}));
  const MeshPair pair(box, box, RelativePose());
  const auto hit = TranslationalCollision(pair, {4, 0.25, 0.125}, {0, 0.25, 0.125});
  EXPECT_TRUE(hit.is_hit);
  EXPECT_NEAR(hit.fraction, 0.75, 1e-12);
  EXPECT_LE(hit.safe_fraction, 0.75);
  EXPECT_NEAR(hit.safe_fraction, 0.75, 1e-10);
  EXPECT_NEAR(hit.normal[0], 1.0, 1e-12);
  const auto miss = TranslationalCollision(pair, {4, 1.5, 0}, {-4, 1.5, 0});
  EXPECT_FALSE(miss.is_hit);
  EXPECT_EQ(miss.safe_fraction, 1.0);
}

// No placement on the way before the contact overlaps, and just after it one does.
TEST(TranslationalCollision, AgainstMembership) {
  const TriangleMesh a = MustBuild(Torus(16, 10, 2.0, 0.75)), b = MustBuild(Star(6));
  testing::Random random(47);
  int hits = 0;
  for (int i = 0; i < 40; ++i) {
    const MeshPair pair(a, b, *RelativePose::Make(random.Rotation(), Vector3d::Zero()));
    const Vector3d from = 6.0 * random.Direction(), to = 3.0 * random.Direction();
    const auto way = TranslationalCollision(pair, from, to);
    const Vector3d safe = from + way.safe_fraction * (to - from);
    EXPECT_NE(Membership(pair, safe).verdict, Verdict::kOverlap);
    for (int k = 0; k < 50; ++k) {
      const Vector3d x = from + way.safe_fraction * random.Unit() * (to - from);
      EXPECT_NE(Membership(pair, x).verdict, Verdict::kOverlap);
    }
    if (!way.is_hit) continue;
    ++hits;
    const Vector3d beyond = from + (way.fraction + 1e-7) * (to - from);
    if (way.fraction < 1.0 - 1e-6) {
      EXPECT_EQ(Membership(pair, beyond).verdict, Verdict::kOverlap);
    }
  }
  EXPECT_GT(hits, 10);
}

TEST(ContactSpaceProjection, IsAnUpperBound) {
  const TriangleMesh a = MustBuild(Torus(16, 10, 2.0, 0.75)), b = MustBuild(Fish(9, 6));
  const ContactBody body_a(a), body_b(b);
  testing::Random random(53);
  ContactSpaceCache cache;
  int overlapping = 0;
  for (int i = 0; i < 20; ++i) {
    const MeshPair pair(a, b, *RelativePose::Make(random.Rotation(), 1.6 * random.Direction()));
    const MeshDepthResult depth = MeshPenetrationDepth(pair, body_a, body_b);
    for (ContactSpaceCache* use : {static_cast<ContactSpaceCache*>(nullptr), &cache}) {
      const ContactSpaceResult result = ContactSpaceProjection(pair, {}, use);
      EXPECT_EQ(result.is_separate, depth.status == MeshDepthStatus::kSeparate);
      EXPECT_NE(Membership(pair, result.translation).verdict, Verdict::kOverlap);
      EXPECT_GE(result.translation.norm(), depth.lower_bound);
      overlapping += !result.is_separate;
    }
  }
  EXPECT_GT(overlapping, 20);
}

}  // namespace
}  // namespace touchstone
