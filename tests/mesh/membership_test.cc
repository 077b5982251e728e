// SPDX-License-Identifier: MIT
#include "touchstone/core/mesh/membership.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "touchstone/tests/testing/poses.h"
#include "touchstone/tests/testing/random.h"
#include "touchstone/tools/shapes/shapes.h"

namespace touchstone {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using touchstone::testing::PoseOf;

MeshPair PairOf(const Shape& a, const Shape& b, const RelativePose& pose = {}) {
  return MeshPair(MustBuild(a), MustBuild(b), pose);
}

// The exact answer; doubles alone may only agree or say that they do not know.
Verdict Ask(const MeshPair& pair, const Translation& x) {
  const MembershipResult result = Membership(pair, x);
  EXPECT_NE(result.verdict, Verdict::kUndecided);
  const MembershipResult in_doubles = Membership(pair, x, {Certainty::kFloat});
  if (in_doubles.verdict != Verdict::kUndecided) {
    EXPECT_EQ(in_doubles.verdict, result.verdict);
    EXPECT_EQ(in_doubles.tier, Tier::kBound);
  }
  EXPECT_NE(in_doubles.verdict, Verdict::kTouch);
  return result.verdict;
}

Shape UnitBox() { return Box({0, 0, 0}, {1, 1, 1}); }

// By intervals.
Verdict BoxVerdict(const Vector3d& size_a, const Vector3d& size_b, const Vector3d& x) {
  Verdict verdict = Verdict::kOverlap;
  for (int i = 0; i < 3; ++i) {
    if (x[i] > size_a[i] || x[i] + size_b[i] < 0) return Verdict::kSeparate;
    if (x[i] == size_a[i] || x[i] + size_b[i] == 0) verdict = Verdict::kTouch;
  }
  return verdict;
}

TEST(Membership, BoxesOnTheGrid) {
  const Vector3d size_a(2, 2, 3), size_b(1, 2, 1);
  for (const double scale : {1.0, 0x1p-320, 0x1p320}) {
    const MeshPair pair =
        PairOf(Box(Vector3d::Zero(), scale * size_a), Box(Vector3d::Zero(), scale * size_b));
    int touches = 0;
    for (int i = -3; i <= 4; ++i) {
      for (int j = -3; j <= 4; ++j) {
        for (int k = -3; k <= 4; ++k) {
          const Vector3d x(i, j, k);
          const Verdict expected = BoxVerdict(size_a, size_b, x);
          ASSERT_EQ(Ask(pair, Vector3d(scale * x)), expected) << x.transpose();
          touches += expected == Verdict::kTouch;
        }
      }
    }
    EXPECT_GT(touches, 50);
  }
}

TEST(Membership, OneUlpDecides) {
  const MeshPair pair = PairOf(UnitBox(), UnitBox());
  for (const Vector3d& x : {Vector3d(1, 0.25, 0.375), Vector3d(0.5, 1, 1), Vector3d(1, 1, 1)}) {
    EXPECT_EQ(Ask(pair, x), Verdict::kTouch);
    Vector3d in = x, out = x;
    for (int i = 0; i < 3; ++i) {
      if (x[i] != 1) continue;
      in[i] = std::nextafter(1.0, 0.0);
      out[i] = std::nextafter(1.0, 2.0);
    }
    EXPECT_EQ(Ask(pair, in), Verdict::kOverlap);
    EXPECT_EQ(Ask(pair, out), Verdict::kSeparate);
  }
}

TEST(Membership, TheSameBodyTwiceOverlaps) {
  for (const std::string& name : ShapeNames()) {
    SCOPED_TRACE(name);
    const Shape shape = NamedShape(name, 100);
    EXPECT_EQ(Ask(PairOf(shape, shape), Vector3d(0, 0, 0)), Verdict::kOverlap);
  }
}

TEST(Membership, AKeyThatFillsItsSlotTouches) {
  const MeshPair slot = PairOf(Slot(), Key());
  EXPECT_EQ(Ask(slot, Vector3d(2, 1, 1)), Verdict::kTouch);      // on the floor
  EXPECT_EQ(Ask(slot, Vector3d(2, 1, 2)), Verdict::kTouch);      // between the walls
  EXPECT_EQ(Ask(slot, Vector3d(2, 0.3, 1.7)), Verdict::kTouch);  // anywhere between them
  EXPECT_EQ(Ask(slot, Vector3d(2, 1, 3)), Verdict::kTouch);      // on their rims
  EXPECT_EQ(Ask(slot, Vector3d(2, 1, 3.5)), Verdict::kSeparate);
  EXPECT_EQ(Ask(slot, Vector3d(std::nextafter(2.0, 3.0), 1, 2)), Verdict::kOverlap);
  EXPECT_EQ(Ask(slot, Vector3d(std::nextafter(2.0, 1.0), 1, 2)), Verdict::kOverlap);
  EXPECT_EQ(Ask(slot, Vector3d(2, 1, std::nextafter(1.0, 0.0))), Verdict::kOverlap);
  const MeshPair pocket = PairOf(Pocket(), Key());
  EXPECT_EQ(Ask(pocket, Vector3d(2, 2, 1.5)), Verdict::kTouch);
  EXPECT_EQ(Ask(pocket, Vector3d(2, std::nextafter(2.0, 3.0), 1.5)), Verdict::kOverlap);
}

TEST(Membership, StrictContainmentOverlaps) {
  const MeshPair pair = PairOf(Box({0, 0, 0}, {10, 10, 10}), NamedShape("torus", 200));
  EXPECT_EQ(Ask(pair, Vector3d(5, 5, 5)), Verdict::kOverlap);
  const MeshPair swapped = PairOf(NamedShape("torus", 200), Box({0, 0, 0}, {10, 10, 10}));
  EXPECT_EQ(Ask(swapped, Vector3d(-5, -5, -5)), Verdict::kOverlap);
  EXPECT_EQ(Membership(pair, Vector3d(5, 5, 5)).face_a, -1);
}

TEST(Membership, ABodyInACavityIsSeparate) {
  const MeshPair pair = PairOf(HollowBox(), Box({0, 0, 0}, {1, 1, 0.5}));
  EXPECT_EQ(Ask(pair, Vector3d(1.5, 1.25, 1.25)), Verdict::kSeparate);
  EXPECT_EQ(Ask(pair, Vector3d(1, 1.25, 1.25)), Verdict::kTouch);
  EXPECT_EQ(Ask(pair, Vector3d(0.75, 1.25, 1.25)), Verdict::kOverlap);
  const MeshPair filled = PairOf(HollowBox(), Box({0, 0, 0}, {2, 1.5, 1}));
  EXPECT_EQ(Ask(filled, Vector3d(1, 1, 1)), Verdict::kTouch);
  // Both hollow: the small one's shell in the large one's cavity, and the other way round.
  const Shape large = Moved(HollowBox(), 8, Vector3d::Zero());
  EXPECT_EQ(Ask(PairOf(large, HollowBox()), Vector3d(10, 10, 9)), Verdict::kSeparate);
  EXPECT_EQ(Ask(PairOf(HollowBox(), large), Vector3d(-10, -10, -9)), Verdict::kSeparate);
  EXPECT_EQ(Ask(PairOf(large, HollowBox()), Vector3d(1, 1, 1)), Verdict::kOverlap);
}

TEST(Membership, LinkedToriAreSeparate) {
  const Shape torus = Torus(16, 12, 2.0, 0.5);
  Matrix3d upright;
  upright << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  const MeshPair pair = PairOf(torus, torus, PoseOf(upright));
  EXPECT_EQ(Ask(pair, Vector3d(2, 0, 0)), Verdict::kSeparate);
  EXPECT_EQ(Ask(pair, Vector3d(3, 0, 0)), Verdict::kTouch);
  EXPECT_EQ(Ask(pair, Vector3d(3.01, 0, 0)), Verdict::kOverlap);
  EXPECT_EQ(Ask(pair, Vector3d(0, 0, 0)), Verdict::kOverlap);
  EXPECT_EQ(Ask(pair, Vector3d(6, 0, 0)), Verdict::kSeparate);
}

TEST(Membership, OneOfTwoComponentsDecides) {
  const Shape two = Together(UnitBox(), Moved(UnitBox(), 1, {4, 0, 0}));
  const MeshPair pair = PairOf(two, Box({0, 0, 0}, {3, 1, 1}));
  EXPECT_EQ(Ask(pair, Vector3d(1, 0, 0)), Verdict::kTouch);  // between the two
  EXPECT_EQ(Ask(pair, Vector3d(1.5, 0, 0)), Verdict::kOverlap);
  EXPECT_EQ(Ask(pair, Vector3d(5, 0, 0)), Verdict::kTouch);
  EXPECT_EQ(Ask(pair, Vector3d(1, 1.5, 0)), Verdict::kSeparate);
  // One component touches while the other is contained.
  const MeshPair mixed = PairOf(Together(UnitBox(), Box({4, -1, -1}, {9, 3, 3})),
                                Together(UnitBox(), Moved(UnitBox(), 1, {4, 0, 0})));
  EXPECT_EQ(Ask(mixed, Vector3d(1, 0, 0)), Verdict::kOverlap);
}

// A spike whose tip meets the bottom of a dent of the same slopes, one steeper, one flatter.
TEST(Membership, TipsInDents) {
  const auto slab = [](double height, double radius, bool dent) {
    Shape shape = dent ? Dimpled(4) : Spiked(4);
    for (Vector3d& v : shape.vertices) {
      if (std::abs(v[0]) <= 1 && std::abs(v[1]) <= 1 && v[2] > -2)
        v = Vector3d(radius * v[0], radius * v[1], v[2]);
    }
    shape.vertices.back()[2] = dent ? -height : height;
    return shape;
  };
  Matrix3d over;  // half a turn about x
  over << 1, 0, 0, 0, -1, 0, 0, 0, -1;
  const RelativePose pose = PoseOf(over);
  // The slabs' faces meet when x = 0; the tip then is at -height.
  EXPECT_EQ(Ask(PairOf(slab(1, 1, true), slab(1, 1, false), pose), Vector3d(0, 0, 0)),
            Verdict::kTouch);
  EXPECT_EQ(Ask(PairOf(slab(1, 1, true), slab(1.25, 1, false), pose), Vector3d(0, 0, 0.25)),
            Verdict::kTouch);
  EXPECT_EQ(Ask(PairOf(slab(1, 1, true), slab(1, 0.75, false), pose), Vector3d(0, 0, 0)),
            Verdict::kTouch);
  EXPECT_EQ(Ask(PairOf(slab(1, 0.75, true), slab(1, 1, false), pose), Vector3d(0, 0, 0)),
            Verdict::kOverlap);
  EXPECT_EQ(Ask(PairOf(slab(1, 1, true), slab(1, 0.75, false), pose), Vector3d(0, 0, -0.125)),
            Verdict::kOverlap);
  EXPECT_EQ(Ask(PairOf(slab(1, 1, true), slab(0.5, 0.5, false), pose), Vector3d(0, 0, -0.5)),
            Verdict::kOverlap);
}

// x is a point of a facet of M, exactly, for rotations that no double describes without rounding.
TEST(Membership, ImplicitTranslationsTouchExactly) {
  testing::Random random(3);
  const TriangleMesh a = MustBuild(NamedShape("star", 20)),
                     b = MustBuild(Box({-1, -2, -1}, {1, 1, 2}));
  int touches = 0;
  for (int i = 0; i < 300; ++i) {
    const RelativePose pose = PoseOf(random.Rotation(), random.Direction());
    const MeshPair pair(a, b, pose);
    ExactMeshPair exact(pair);
    const Triangle& face = a.face(random.Int(0, a.face_count() - 1));
    const int vertex = random.Int(0, b.vertex_count() - 1);
    // The point with weights 5/16, 7/16, 4/16, or 1, 0, 0, less the vertex of B.
    const bool at_corner = i % 3 == 0;
    ExactPoint x;
    x.denominator = Dyadic(16);
    x.coordinates = (at_corner ? Dyadic(16) : Dyadic(5)) * exact.PointOfA(face[0]) +
                    (at_corner ? Dyadic(0) : Dyadic(7)) * exact.PointOfA(face[1]) +
                    (at_corner ? Dyadic(0) : Dyadic(4)) * exact.PointOfA(face[2]) -
                    Dyadic(16) * exact.PointOfB(vertex);
    Vector3d rounded;
    for (int k = 0; k < 3; ++k) rounded[k] = RatioToDouble(x.coordinates[k], x.denominator);
    const Translation translation(rounded, 0x1p-50, x);
    const Verdict verdict = Ask(pair, translation);
    ASSERT_TRUE(verdict == Verdict::kTouch || verdict == Verdict::kOverlap);
    touches += verdict == Verdict::kTouch;
    const MembershipResult in_doubles = Membership(pair, translation, {Certainty::kFloat});
    ASSERT_EQ(in_doubles.verdict,
              verdict == Verdict::kTouch ? Verdict::kUndecided : in_doubles.verdict);
  }
  EXPECT_GT(touches, 20);
  EXPECT_LT(touches, 280);
}

TEST(Membership, SwappingTheBodiesReversesTheTranslation) {
  testing::Random random(4);
  for (const auto& [name_a, name_b] :
       {std::pair("axes", "u"), std::pair("dimpled", "spiked"), std::pair("slot", "key")}) {
    const Shape a = NamedShape(name_a, 0), b = NamedShape(name_b, 0);
    const MeshPair pair = PairOf(a, b), swapped = PairOf(b, a);
    for (int i = 0; i < 100; ++i) {
      const Vector3d x(random.Int(-8, 8) * 0.5, random.Int(-8, 8) * 0.5, random.Int(-8, 8) * 0.5);
      ASSERT_EQ(Ask(pair, x), Ask(swapped, Vector3d(-x))) << x.transpose();
    }
  }
}

TEST(Membership, WorldPosesMeanBothImages) {
  testing::Random random(6);
  for (int i = 0; i < 50; ++i) {
    // Both turned alike and moved alike: boxes that stand side by side, touching, in any frame.
    const Matrix3d rotation = random.Rotation();
    const Vector3d translation = random.Direction();
    const auto pose = RelativePose::FromWorld({rotation, translation}, {rotation, translation});
    const MeshPair pair = PairOf(UnitBox(), UnitBox(), *pose);
    EXPECT_EQ(Ask(pair, Vector3d(1, 0.5, 0.25)), Verdict::kTouch);
    EXPECT_EQ(Ask(pair, Vector3d(std::nextafter(1.0, 0.0), 0.5, 0.25)), Verdict::kOverlap);
    EXPECT_EQ(Ask(pair, Vector3d(std::nextafter(1.0, 2.0), 0.5, 0.25)), Verdict::kSeparate);
  }
}

TEST(Membership, CacheAndBatchChangeNoAnswer) {
  testing::Random random(7);
  const TriangleMesh a = MustBuild(NamedShape("torus", 400)),
                     b = MustBuild(NamedShape("star", 100));
  const MeshPair pair(a, b, PoseOf(random.Rotation()));
  std::vector<Vector3d> xs;
  for (int i = 0; i < 500; ++i) xs.push_back(random.Uniform(0, 5) * random.Direction());
  std::vector<MembershipResult> results(xs.size());
  MembershipCache cache;
  cache.crossing = {true, 1 << 20, 3};  // left by a larger pair
  Membership(pair, xs, results, {}, &cache);
  int overlaps = 0;
  for (std::size_t i = 0; i < xs.size(); ++i) {
    ASSERT_EQ(results[i].verdict, Membership(pair, xs[i]).verdict);
    overlaps += results[i].verdict == Verdict::kOverlap;
  }
  EXPECT_GT(overlaps, 50);
  EXPECT_LT(overlaps, 450);
}

TEST(Membership, PlacingAgainIsLikeANewPair) {
  testing::Random random(8);
  const TriangleMesh a = MustBuild(NamedShape("fish", 200)), b = MustBuild(NamedShape("cup", 160));
  MeshPair moved(a, b, RelativePose());
  for (int i = 0; i < 20; ++i) {
    const double far = i % 4 == 0 ? 1e6 : 2.0;  // another scale
    const RelativePose pose = PoseOf(random.Rotation(), far * random.Direction());
    moved.Place(pose);
    const MeshPair fresh(a, b, pose);
    EXPECT_EQ(moved.scale(), fresh.scale());
    for (int k = 0; k < 20; ++k) {
      const Vector3d x = random.Direction() - pose.translation();
      const MembershipResult p = Membership(moved, x), q = Membership(fresh, x);
      ASSERT_EQ(p.verdict, q.verdict);
      ASSERT_EQ(p.triangle_tests, q.triangle_tests);
    }
  }
}

TEST(Membership, FarAndHugeTranslationsAreSeparate) {
  const MeshPair pair = PairOf(UnitBox(), UnitBox());
  for (const double far : {3.0, 1e20, 1e100, 1e300}) {
    EXPECT_EQ(Ask(pair, Vector3d(far, 0, 0)), Verdict::kSeparate);
    EXPECT_EQ(Ask(pair, Vector3d(-far, far, far)), Verdict::kSeparate);
  }
}

}  // namespace
}  // namespace touchstone
