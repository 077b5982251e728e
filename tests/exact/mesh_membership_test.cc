// SPDX-License-Identifier: GPL-3.0-or-later
#include "touchstone/exact/mesh_membership.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <array>
#include <string>
#include <vector>

#include "touchstone/core/mesh/membership.h"
#include "touchstone/tests/testing/random.h"
#include "touchstone/tools/shapes/shapes.h"

namespace touchstone::exact {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Verdict Ask(const Shape& a, const Shape& b, const Vector3d& x) {
  return MeshMembership(PlacedMeshPair(MustBuild(a), MustBuild(b), RelativePose()),
                        ExactTranslation(x));
}

// Known by hand, so that the judge is judged.
TEST(MeshMembership, KnownAnswers) {
  const Shape box = Box({0, 0, 0}, {1, 1, 1});
  EXPECT_EQ(Ask(box, box, {0, 0, 0}), Verdict::kOverlap);
  EXPECT_EQ(Ask(box, box, {1, 0, 0}), Verdict::kTouch);
  EXPECT_EQ(Ask(box, box, {1, 1, 1}), Verdict::kTouch);
  EXPECT_EQ(Ask(box, box, {1 - 0x1p-53, 1 - 0x1p-53, 1 - 0x1p-53}), Verdict::kOverlap);
  EXPECT_EQ(Ask(box, box, {1 + 0x1p-52, 0, 0}), Verdict::kSeparate);
  EXPECT_EQ(Ask(Box({-5, -5, -5}, {5, 5, 5}), box, {0, 0, 0}), Verdict::kOverlap);
  EXPECT_EQ(Ask(box, Box({-5, -5, -5}, {5, 5, 5}), {0, 0, 0}), Verdict::kOverlap);
  EXPECT_EQ(Ask(Slot(), Key(), {2, 1, 2}), Verdict::kTouch);
  EXPECT_EQ(Ask(Slot(), Key(), {2 + 0x1p-51, 1, 2}), Verdict::kOverlap);
  EXPECT_EQ(Ask(Pocket(), Key(), {2, 2, 1}), Verdict::kTouch);
  EXPECT_EQ(Ask(Pocket(), Key(), {2, 2, 1 - 0x1p-53}), Verdict::kOverlap);
  EXPECT_EQ(Ask(HollowBox(), Box({0, 0, 0}, {1, 1, 0.5}), {1.5, 1.25, 1.25}), Verdict::kSeparate);
  EXPECT_EQ(Ask(HollowBox(), Box({0, 0, 0}, {2, 1.5, 1}), {1, 1, 1}), Verdict::kTouch);
  EXPECT_EQ(Ask(HollowBox(), HollowBox(), {0, 0, 0}), Verdict::kOverlap);
}

TEST(MeshMembership, FractionsAndDoublesAgree) {
  const PlacedMeshPair pair(MustBuild(Slot()), MustBuild(Key()), RelativePose());
  const mpq_class third(1, 3);
  // Between the walls, at a height that is no double.
  EXPECT_EQ(MeshMembership(pair, ExactTranslation({mpq_class(2), third, 1 + third})),
            Verdict::kTouch);
  EXPECT_EQ(MeshMembership(pair, ExactTranslation({2 + third, third, 1 + third})),
            Verdict::kOverlap);
  EXPECT_EQ(MeshMembership(pair, ExactTranslation({2, third, 3 + third})), Verdict::kSeparate);
}

// All 24 turns that map the axes to themselves.
std::vector<Matrix3d> AxisRotations() {
  std::vector<Matrix3d> rotations;
  const std::array<std::array<int, 3>, 6> orders = {
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {1, 0, 2}, {0, 2, 1}, {2, 1, 0}}};
  for (const auto& order : orders) {
    for (int signs = 0; signs < 8; ++signs) {
      Matrix3d r = Matrix3d::Zero();
      for (int i = 0; i < 3; ++i) r(i, order[i]) = signs >> i & 1 ? -1 : 1;
      if (r.determinant() > 0) rotations.push_back(r);
    }
  }
  return rotations;
}

struct Tally {
  std::array<int, 3> verdicts{};
  int undecided = 0;
};

// Holds core and exact half against each other.
void Compare(const MeshPair& pair, const PlacedMeshPair& exact, const Vector3d& x, Tally* tally) {
  const Verdict expected = MeshMembership(exact, ExactTranslation(x));
  const MembershipResult result = Membership(pair, x);
  ASSERT_EQ(result.verdict, expected) << x.transpose();
  const MembershipResult in_doubles = Membership(pair, x, {Certainty::kFloat});
  if (in_doubles.verdict != Verdict::kUndecided) {
    ASSERT_EQ(in_doubles.verdict, expected);
  }
  ++tally->verdicts[static_cast<int>(expected)];
  tally->undecided += in_doubles.verdict == Verdict::kUndecided;
}

TEST(MeshMembership, CoreAgreesOnTheGridWhereFacesAndEdgesMeet) {
  testing::Random random(21);
  const std::vector<Shape> shapes = {
      Box({0, 0, 0}, {1, 1, 1}),
      Box({0, 0, 0}, {2, 1, 1}),
      LShape(),
      UShape(),
      Axes(3),
      Slot(),
      Pocket(),
      Key(),
      HollowBox(),
      Star(4),
      Dimpled(4),
      Spiked(4),
      Cone(8, 1, 2),
      Together(Box({0, 0, 0}, {1, 1, 1}), Box({2, 0, 0}, {3, 1, 1}))};
  const std::vector<Matrix3d> rotations = AxisRotations();
  const int last = static_cast<int>(shapes.size()) - 1;
  Tally tally;
  for (int i = 0; i < 120; ++i) {
    const TriangleMesh a = MustBuild(shapes[random.Int(0, last)]);
    const TriangleMesh b = MustBuild(shapes[random.Int(0, last)]);
    const Matrix3d rotation = rotations[random.Int(0, 23)];
    const RelativePose pose = *RelativePose::Make(rotation, Vector3d::Zero());
    const MeshPair pair(a, b, pose);
    const PlacedMeshPair exact(a, b, pose);
    for (int k = 0; k < 5; ++k) {
      // A vertex on a vertex, moved by quarters.
      Vector3d x = a.vertex(random.Int(0, a.vertex_count() - 1)) -
                   rotation * b.vertex(random.Int(0, b.vertex_count() - 1));
      if (k % 2 == 0) x += 0.25 * Vector3d(random.Int(-6, 6), random.Int(-6, 6), random.Int(-6, 6));
      ASSERT_NO_FATAL_FAILURE(Compare(pair, exact, x, &tally));
    }
  }
  for (const int count : tally.verdicts) EXPECT_GT(count, 60);
}

TEST(MeshMembership, CoreAgreesInGeneralPosition) {
  testing::Random random(22);
  Tally tally;
  for (const auto& [name_a, name_b] :
       {std::pair("torus", "torus"), std::pair("cone", "axes"), std::pair("spoon", "cup"),
        std::pair("fish", "torus"), std::pair("star", "u"), std::pair("tori", "hollow")}) {
    const TriangleMesh a = MustBuild(NamedShape(name_a, 300)),
                       b = MustBuild(NamedShape(name_b, 300));
    for (int i = 0; i < 5; ++i) {
      const RelativePose pose = *RelativePose::Make(random.Rotation(), random.Direction());
      const MeshPair pair(a, b, pose);
      const PlacedMeshPair exact(a, b, pose);
      for (int k = 0; k < 40; ++k) {
        const Vector3d x = random.Uniform(0, 5) * random.Direction();
        ASSERT_NO_FATAL_FAILURE(Compare(pair, exact, x, &tally));
      }
    }
  }
  EXPECT_GT(tally.verdicts[0], 200);
  EXPECT_GT(tally.verdicts[2], 200);
  EXPECT_EQ(tally.undecided, 0);
}

mpq_class ToRational(double value) { return mpq_class(value); }

// A vertex of B exactly on a face of A, for rotations that round: points that are no doubles.
TEST(MeshMembership, CoreAgreesAtImplicitPoints) {
  testing::Random random(23);
  std::array<int, 3> verdicts{};
  for (int i = 0; i < 500; ++i) {
    const TriangleMesh a = MustBuild(NamedShape(i % 2 == 0 ? "star" : "axes", 0));
    const TriangleMesh b = MustBuild(NamedShape(i % 3 == 0 ? "u" : "dimpled", 0));
    const Matrix3d rotation = random.Rotation();
    const RelativePose pose = *RelativePose::Make(rotation, Vector3d::Zero());
    const MeshPair pair(a, b, pose);
    const PlacedMeshPair exact(a, b, pose);
    ExactMeshPair big(pair);
    const Triangle& face = a.face(random.Int(0, a.face_count() - 1));
    const int v = random.Int(0, b.vertex_count() - 1);
    const std::array<int, 3> weights = {random.Int(0, 3), random.Int(0, 3), random.Int(1, 3)};
    const int sum = weights[0] + weights[1] + weights[2];

    ExactPoint x;
    x.denominator = Dyadic(sum);
    std::array<mpq_class, 3> rational;
    Vector3d rounded;
    for (int k = 0; k < 3; ++k) {
      x.coordinates[k] = -(Dyadic(sum) * big.PointOfB(v)[k]);
      for (int j = 0; j < 3; ++j) {
        x.coordinates[k] = x.coordinates[k] + Dyadic(weights[j]) * Dyadic(a.vertex(face[j])[k]);
        rational[k] += weights[j] * ToRational(a.vertex(face[j])[k]) / sum;
        rational[k] -= ToRational(rotation(k, j)) * ToRational(b.vertex(v)[j]);
      }
      rounded[k] = RatioToDouble(x.coordinates[k], x.denominator);
    }
    const Verdict expected = MeshMembership(exact, ExactTranslation(rational));
    ASSERT_EQ(Membership(pair, Translation(rounded, 0x1p-48, x)).verdict, expected);
    ++verdicts[static_cast<int>(expected)];
  }
  EXPECT_EQ(verdicts[0], 0);
  EXPECT_GT(verdicts[1], 20);
  EXPECT_GT(verdicts[2], 20);
}

}  // namespace
}  // namespace touchstone::exact
