// SPDX-License-Identifier: MIT
#include "touchstone/core/mesh/surface_travel.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>
#include <tuple>
#include <vector>

#include "touchstone/core/mesh/membership.h"
#include "touchstone/core/proximity/directional_distance.h"
#include "touchstone/tests/testing/random.h"
#include "touchstone/tests/testing/shapes.h"
#include "touchstone/tools/shapes/shapes.h"

namespace touchstone {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

MeshPair PairOf(const Shape& a, const Shape& b, const Vector3d& at) {
  return MeshPair(MustBuild(a), MustBuild(b), *RelativePose::Make(Matrix3d::Identity(), at));
}

TEST(SurfaceTravel, BoxesOnTheGridAreExact) {
  for (const double scale : {1.0, 0x1p-320, 0x1p320}) {
    const Shape box = Moved(Box({0, 0, 0}, {1, 1, 1}), scale, Vector3d::Zero());
    // Onto a face, along a face, past an edge by nothing and by one ulp, onto an edge.
    const std::vector<std::tuple<Vector3d, Vector3d, double>> cases = {
        {{4, 0.25, 0.5}, {-1, 0, 0}, 3.0},
        {{4, 1, 0}, {-1, 0, 0}, 3.0},
        {{4, std::nextafter(1.0, 2.0), 0}, {-1, 0, 0}, -1.0},
        {{4, 0, 0}, {1, 0, 0}, -1.0},
        {{5, 5, 0.5}, {-2, -2, 0}, 2.0},
        {{3, 6, 9}, {-0.25, -0.5, -0.75}, 32.0 / 3.0},
        {{-4, 0.5, 0}, {0.5, 0, 0}, 6.0}};
    for (const auto& [at, s, expected] : cases) {
      const SurfaceTravelResult result =
          SurfaceTravel(PairOf(box, box, scale * at), scale * s, 40.0);
      EXPECT_EQ(result.is_hit, expected >= 0.0) << at.transpose();
      if (!result.is_hit) continue;
      EXPECT_EQ(result.travel, expected);
      EXPECT_LE(result.lower_bound, expected);
      EXPECT_GE(result.upper_bound, expected);
      EXPECT_LT(result.upper_bound - result.lower_bound, 1e-12);
    }
  }
}

// The reach is decided exactly: at it, and one ulp short of it.
TEST(SurfaceTravel, TheReachIsDecidedExactly) {
  const MeshPair pair = PairOf(Box({0, 0, 0}, {1, 1, 1}), UShape(), {5, 0, 0});
  EXPECT_TRUE(SurfaceTravel(pair, {-1, 0, 0}, 4.0).is_hit);
  EXPECT_FALSE(SurfaceTravel(pair, {-1, 0, 0}, std::nextafter(4.0, 0.0)).is_hit);
  EXPECT_FALSE(SurfaceTravel(pair, {-1, 0, 0}, 0.0).is_hit);
  EXPECT_TRUE(SurfaceTravel(pair, {-1, 0, 0}, 1e100).is_hit);
  // A third of a step is no double: 3 t >= 4 for the first time above 4/3.
  const double third = 4.0 / 3.0;
  EXPECT_EQ(SurfaceTravel(pair, {-3, 0, 0}, third).is_hit, 3.0L * third >= 4.0L);
  EXPECT_TRUE(SurfaceTravel(pair, {-3, 0, 0}, std::nextafter(third, 2.0)).is_hit);
  EXPECT_FALSE(SurfaceTravel(pair, {-3, 0, 0}, std::nextafter(third, 1.0)).is_hit);
}

// A key into a slot that it fits exactly, and one an ulp narrower.
TEST(SurfaceTravel, KeyIntoASlot) {
  // The walls are grazed from their upper rims on.
  const MeshPair fits = PairOf(Slot(), Key(), {2, 1, 8});
  EXPECT_EQ(SurfaceTravel(fits, {0, 0, -1}, 10.0).travel, 5.0);
  Shape thin = Key();
  for (Vector3d& v : thin.vertices) v[0] = v[0] == 0.0 ? 0x1p-52 : 1.0 - 0x1p-52;
  const MeshPair slides = PairOf(Slot(), thin, {2, 1, 8});
  const SurfaceTravelResult result = SurfaceTravel(slides, {0, 0, -1}, 10.0);
  EXPECT_EQ(result.travel, 7.0);  // the floor
  EXPECT_NEAR(result.normal[2], 1.0, 1e-14);
}

// DirectionalDistance proves both ends exactly.
TEST(SurfaceTravel, OfConvexBodiesIsWithinItsBounds) {
  std::printf("seed 54\n");
  testing::Random random(54);
  const std::vector<testing::Mesh> shapes = {
      testing::RoundBody(40, {2, 1, 0.5}, 7), testing::Triangulated(testing::Box({1, 0.01, 2})),
      testing::Triangulated(testing::Prism(12, 0.5)),
      testing::Triangulated(testing::Box({3, 1e-5, 1e-5})), testing::Tetrahedron()};
  const auto triangles = [](const testing::Mesh& mesh) {
    std::vector<Triangle> faces;
    for (const auto& f : mesh.faces) faces.push_back({f[0], f[1], f[2]});
    return *TriangleMesh::Build(mesh.vertices, faces);
  };
  SurfaceTravelCache cache;
  int hits = 0, misses = 0, wide = 0;
  for (int round = 0; round < 1500; ++round) {
    const testing::Mesh& p = shapes[random.Int(0, 4)];
    const testing::Mesh& q = shapes[random.Int(0, 4)];
    const Matrix3d rotation = round % 4 == 0 ? Matrix3d(Matrix3d::Identity()) : random.Rotation();
    Vector3d at = 8.0 * random.Direction();
    if (round % 4 == 0) at = at.array().round();
    const double length = std::pow(10.0, random.Uniform(-6, 6));
    const Vector3d s = round % 4 == 0
                           ? Vector3d(-at)
                           : Vector3d(length * (-at.normalized() + 0.2 * random.Direction()));
    const RelativePose pose = *RelativePose::Make(rotation, at);
    const auto truth = DirectionalDistance(testing::MustBuild(p), testing::MustBuild(q), pose, s);
    ASSERT_TRUE(truth.ok());
    const bool meets = truth->kind == TravelKind::kInterval;
    if (meets && truth->enter.travel.value <= 0.0) continue;
    const SurfaceTravelResult result =
        SurfaceTravel(MeshPair(triangles(p), triangles(q), pose), s, 100.0 / s.norm(), &cache);
    ASSERT_EQ(result.is_hit, meets) << round;
    (meets ? hits : misses) += 1;
    if (!meets) continue;
    const BoundedValue& enter = truth->enter.travel;
    ASSERT_LE(result.lower_bound, enter.value + enter.error);
    ASSERT_GE(result.upper_bound, enter.value - enter.error);
    ASSERT_NEAR(result.travel, enter.value, enter.error + 4e-12 * enter.value);
    wide += (result.upper_bound - result.lower_bound) * s.norm() > 1e-11;
  }
  EXPECT_GT(hits, 500);
  EXPECT_GT(misses, 200);
  std::printf("%d hits, %d misses, %d of the bounds wider than 1e-11\n", hits, misses, wide);
  EXPECT_LT(wide, hits / 20);
}

// No placement before the lower bound meets, and just after the upper one, or a little later, one
// does.
TEST(SurfaceTravel, AgainstMembership) {
  std::printf("seed 55\n");
  testing::Random random(55);
  const std::vector<TriangleMesh> meshes = {MustBuild(Torus(16, 10, 2.0, 0.75)),
                                            MustBuild(UShape()), MustBuild(Star(6)),
                                            MustBuild(InterlockedTori(8, 5)), MustBuild(Gear(8))};
  int hits = 0, misses = 0, overlaps = 0;
  for (int round = 0; round < 300; ++round) {
    const TriangleMesh& a = meshes[random.Int(0, 4)];
    const TriangleMesh& b = meshes[random.Int(0, 4)];
    const MeshPair pair(a, b, *RelativePose::Make(random.Rotation(), 4.0 * random.Direction()));
    if (Membership(pair, Vector3d(Vector3d::Zero())).verdict != Verdict::kSeparate) continue;
    const Vector3d s = random.Uniform(0.5, 8.0) * random.Direction();
    const SurfaceTravelResult result = SurfaceTravel(pair, s, 1.0);
    const double last = result.is_hit ? (1.0 - 1e-13) * result.lower_bound : 1.0;
    for (int k = 0; k < 30; ++k) {
      const double t = k == 0 ? last : last * random.Unit();
      ASSERT_EQ(Membership(pair, Vector3d(t * s)).verdict, Verdict::kSeparate) << round;
    }
    (result.is_hit ? hits : misses) += 1;
    if (!result.is_hit) continue;
    EXPECT_LT(result.upper_bound - result.lower_bound, 1e-12);
    EXPECT_LE(result.normal.dot(s), 0.0);
    overlaps +=
        Membership(pair, Vector3d((result.upper_bound + 1e-6) * s)).verdict == Verdict::kOverlap;
  }
  EXPECT_GT(hits, 30);
  EXPECT_GT(misses, 10);
  EXPECT_GE(overlaps, hits - 1);
}

TEST(SurfaceTravel, ExtremesEndAndHold) {
  const TriangleMesh big = MustBuild(Moved(Torus(10, 6, 2.0, 0.5), 1e99, Vector3d::Zero()));
  const TriangleMesh tiny = MustBuild(Moved(Star(5), 1e-99, Vector3d::Zero()));
  const MeshPair pair(big, tiny, *RelativePose::Make(Matrix3d::Identity(), Vector3d(0, 0, 2e99)));
  for (const double length : {1e-100, 1.0, 1e100}) {
    // Through the hole, and onto the tube.
    EXPECT_FALSE(SurfaceTravel(pair, {0, 0, -length}, 1e100).is_hit);
    const SurfaceTravelResult result =
        SurfaceTravel(pair, Vector3d(length, 0, -length).stableNormalized() * length, 1e100);
    EXPECT_EQ(result.is_hit, length >= 1.0);
    if (!result.is_hit) continue;
    EXPECT_GT(result.lower_bound * length, 2.0e99);
    EXPECT_LT(result.upper_bound * length, 3.0e99);
  }
}

}  // namespace
}  // namespace touchstone
