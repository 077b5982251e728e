// SPDX-License-Identifier: MIT
#include "touchstone/core/mesh/crossing_prism.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "touchstone/core/mesh/membership.h"
#include "touchstone/core/mesh/triangle_contact_internal.h"
#include "touchstone/tests/testing/poses.h"
#include "touchstone/tests/testing/random.h"
#include "touchstone/tools/shapes/shapes.h"

namespace touchstone {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using touchstone::testing::PoseOf;

// Where nothing but the cache's planes answered.
bool IsByPrism(const MembershipResult& result) {
  return result.verdict == Verdict::kOverlap && result.box_tests == 0 && result.triangle_tests == 0;
}

// Warm and cold must agree, in doubles and exactly.
MembershipResult AskBoth(const MeshPair& pair, const Translation& x, MembershipCache* cache) {
  const MembershipResult cold = Membership(pair, x, {Certainty::kFloat});
  const MembershipResult warm = Membership(pair, x, {Certainty::kFloat}, cache);
  EXPECT_EQ(warm.verdict, cold.verdict);
  EXPECT_EQ(Membership(pair, x, {}, cache).verdict, Membership(pair, x).verdict);
  return warm;
}

Shape Scaled(Shape shape, double factor) {
  for (Vector3d& v : shape.vertices) v *= factor;
  return shape;
}

// One cache goes round all pairs and poses, whose faces have the same numbers.
TEST(CrossingPrism, OneCacheForPairsPosesAndScales) {
  testing::Random random(21);
  MembershipCache cache;
  int by_prism = 0, overlaps = 0, others = 0;
  for (const double scale : {1.0, 1e99, 1e-99, 0x1p-310}) {
    const TriangleMesh torus = MustBuild(Scaled(NamedShape("torus", 200), scale)),
                       larger = MustBuild(Scaled(NamedShape("torus", 200), 1.0625 * scale)),
                       star = MustBuild(Scaled(NamedShape("star", 100), scale));
    std::vector<MeshPair> pairs;
    for (int i = 0; i < 3; ++i) {
      const RelativePose pose = PoseOf(random.Rotation(), scale * random.Direction());
      pairs.emplace_back(torus, star, pose);
      pairs.emplace_back(larger, star, pose);
      pairs.emplace_back(star, torus, pose);
      pairs.emplace_back(torus, larger, pose);
      pairs.emplace_back(torus, torus, pose);
      pairs.emplace_back(torus, torus, PoseOf(pose.rotation(), Vector3d(-pose.translation())));
    }
    for (int i = 0; i < 600; ++i) {
      const Vector3d x = random.Uniform(0.0, 5.0) * scale * random.Direction();
      const int runs = i % 3;  // of the same pair, so that the planes are used at all
      MeshPair& pair = pairs[random.Int(0, static_cast<int>(pairs.size()) - 1)];
      if (i % 7 == 0) pair.Place(PoseOf(random.Rotation(), scale * random.Direction()));
      for (int k = 0; k <= runs; ++k) {
        const Vector3d y = x + 1e-2 * k * scale * random.Direction();
        const MembershipResult result = AskBoth(pair, y, &cache);
        by_prism += IsByPrism(result);
        overlaps += result.verdict == Verdict::kOverlap;
        others += result.verdict != Verdict::kOverlap;
      }
    }
  }
  EXPECT_GT(by_prism, 200);
  EXPECT_GT(overlaps, 800);
  EXPECT_GT(others, 800);
}

// The body is another one by a unit in the last place of one coordinate.
TEST(CrossingPrism, ABodyThatDiffersByOneUlp) {
  const Shape box = Box({0, 0, 0}, {1, 1, 1});
  // Passes through the box's lid and floor, along z.
  const Shape pin = Box({0.25, 0.25, -1}, {0.5, 0.5, 2});
  MembershipCache cache;
  const MeshPair pair(MustBuild(box), MustBuild(pin), RelativePose());
  const Vector3d touching(-0.5, 0.125, 0);
  for (int i = 0; i < 2; ++i) AskBoth(pair, Vector3d(0.1, 0, 0), &cache);
  EXPECT_TRUE(IsByPrism(Membership(pair, Vector3d(0.1, 0, 0), {}, &cache)));
  EXPECT_EQ(Membership(pair, touching, {}, &cache).verdict, Verdict::kTouch);
  Shape wider = pin;
  for (Vector3d& v : wider.vertices) {
    if (v[0] == 0.5) v[0] = std::nextafter(0.5, 1.0);
  }
  const MeshPair other(MustBuild(box), MustBuild(wider), RelativePose());
  EXPECT_EQ(Membership(other, touching, {}, &cache).verdict, Verdict::kOverlap);
  EXPECT_EQ(Membership(pair, touching, {}, &cache).verdict, Verdict::kTouch);
}

// Up to the planes of what crosses, and a unit in the last place to either side.
TEST(CrossingPrism, OneUlpAtItsSides) {
  for (const double scale : {1.0, 0x1p300, 0x1p-300}) {
    const MeshPair pair(MustBuild(Scaled(Box({0, 0, 0}, {1, 1, 1}), scale)),
                        MustBuild(Scaled(Box({0.25, 0.25, -1}, {0.5, 0.5, 2}), scale)),
                        RelativePose());
    MembershipCache cache;
    int by_prism = 0;
    for (int axis = 0; axis < 3; ++axis) {
      // Where the intervals [0, 1] and [0.25, 0.5] + x, or [-1, 2] + x, meet in a point.
      const double low = axis < 2 ? -0.5 : -2.0, high = axis < 2 ? 0.75 : 2.0;
      for (const double at : {low, high}) {
        for (int i = 0; i < 3; ++i) {
          const Vector3d inside = scale * Vector3d(0.125, 0.0625, 0.03125);
          by_prism += IsByPrism(AskBoth(pair, inside, &cache));
        }
        const double inward = at == low ? 3.0 : -3.0;
        Vector3d x = scale * Vector3d(0.125, 0.0625, 0.03125);
        x[axis] = scale * at;
        EXPECT_EQ(Membership(pair, x, {}, &cache).verdict, Verdict::kTouch);
        x[axis] = scale * std::nextafter(at, inward);
        EXPECT_EQ(Membership(pair, x, {}, &cache).verdict, Verdict::kOverlap);
        x[axis] = scale * std::nextafter(at, -inward);
        EXPECT_EQ(Membership(pair, x, {}, &cache).verdict, Verdict::kSeparate);
        for (int ulps = 1; ulps < 4000; ulps *= 3) {
          for (const double sign : {-1.0, 1.0}) {
            x[axis] = scale * (at + sign * ulps * 0x1p-52);
            AskBoth(pair, x, &cache);
          }
        }
      }
    }
    EXPECT_GT(by_prism, 5);
  }
}

// What is known of x only up to a bound, which is not to be taken for x.
TEST(CrossingPrism, TranslationsWithACorrection) {
  testing::Random random(23);
  const TriangleMesh a = MustBuild(NamedShape("torus", 200)), b = MustBuild(NamedShape("star", 50));
  const MeshPair pair(a, b, PoseOf(random.Rotation(), random.Direction()));
  MembershipCache cache;
  int by_prism = 0, wide = 0;
  for (int i = 0; i < 400; ++i) {
    const Vector3d at = random.Uniform(0.0, 3.0) * random.Direction();
    for (const double bound : {0.0, 0x1p-50, 0x1p-20, 0.25}) {
      ExactPoint exact;  // off by the bound, along one axis
      exact.coordinates = ToDyadic(Vector3d(at + bound * Vector3d(1, 0, 0)));
      const Translation x(at, 1.001 * bound + 0x1p-50, exact);
      const MembershipResult result = AskBoth(pair, x, &cache);
      by_prism += IsByPrism(result);
      wide += IsByPrism(result) && bound == 0.25;
      if (result.verdict != Verdict::kUndecided) {
        EXPECT_EQ(result.verdict,
                  Membership(pair, Vector3d(at + bound * Vector3d(1, 0, 0))).verdict);
      }
    }
  }
  EXPECT_GT(by_prism, 100);
  EXPECT_EQ(wide, 0);
}

// Any edge and any face: what lies in their prism, the two triangles' comparison finds to cross.
TEST(CrossingPrism, SaysNoMoreThanTheTriangles) {
  testing::Random random(22);
  int held = 0, near = 0;
  for (int round = 0; round < 60; ++round) {
    const double far = round % 5 == 0 ? 1e3 : 1.0;  // bits lost to the distance
    const TriangleMesh a = MustBuild(NamedShape(round % 2 == 0 ? "torus" : "cone", 100)),
                       b = MustBuild(NamedShape("star", 50));
    const MeshPair pair(a, b, PoseOf(random.Rotation(), far * random.Direction()));
    for (int i = 0; i < 200; ++i) {
      Crossing crossing;
      crossing.edge_is_of_a = random.Int(0, 1) == 1;
      const TriangleMesh &of_edge = crossing.edge_is_of_a ? a : b,
                         &of_face = crossing.edge_is_of_a ? b : a;
      crossing.half_edge = random.Int(0, of_edge.half_edge_count() - 1);
      crossing.face = random.Int(0, of_face.face_count() - 1);
      CrossingPrism prism;
      if (!prism.Make(pair, crossing)) continue;
      ASSERT_TRUE(prism.IsOf(pair));
      // A point of the edge on one of the face, and others near its sides.
      const PlacedMesh &edge_mesh = crossing.edge_is_of_a ? pair.a() : pair.b(),
                       &face_mesh = crossing.edge_is_of_a ? pair.b() : pair.a();
      const Triangle& corners = of_face.face(crossing.face);
      for (int k = 0; k < 12; ++k) {
        const double s = k % 4 == 0 ? 0x1p-50 : random.Unit();
        const double u = k % 4 == 1 ? 0x1p-51 : random.Unit(), v = (1.0 - u) * random.Unit();
        const Vector3d on_edge = (1.0 - s) * edge_mesh.points[of_edge.tail(crossing.half_edge)] +
                                 s * edge_mesh.points[of_edge.head(crossing.half_edge)];
        const Vector3d on_face = u * face_mesh.points[corners[0]] +
                                 v * face_mesh.points[corners[1]] +
                                 (1.0 - u - v) * face_mesh.points[corners[2]];
        const Vector3d scaled =
            crossing.edge_is_of_a ? Vector3d(on_edge - on_face) : Vector3d(on_face - on_edge);
        const Translation x(Vector3d(scaled / pair.scale()));
        if (!prism.Holds(pair, x)) {
          ++near;
          continue;
        }
        ++held;
        const int of_edge_face = TriangleMesh::face_of(crossing.half_edge);
        Crossing found;
        ASSERT_EQ(
            internal::TriageTriangles(pair, crossing.edge_is_of_a ? of_edge_face : crossing.face,
                                      crossing.edge_is_of_a ? crossing.face : of_edge_face,
                                      internal::MakeOffset(pair, x), &found),
            internal::Triage::kCross);
        if (k == 2) {
          ASSERT_EQ(Membership(pair, x).verdict, Verdict::kOverlap);
        }
      }
    }
  }
  EXPECT_GT(held, 30000);
  EXPECT_GT(near, 5000);
}

}  // namespace
}  // namespace touchstone
