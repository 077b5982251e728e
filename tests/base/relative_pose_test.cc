// SPDX-License-Identifier: MIT
#include "touchstone/core/base/relative_pose.h"

#include <gtest/gtest.h>

#include <cfenv>
#include <limits>

#include "touchstone/core/base/dyadic.h"
#include "touchstone/tests/testing/random.h"

namespace touchstone {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

void ExpectFailure(const StatusOr<RelativePose>& pose, StatusCode code, ElementKind kind, int row) {
  ASSERT_FALSE(pose.ok());
  EXPECT_EQ(pose.status().code, code) << pose.status().ToString();
  EXPECT_EQ(pose.status().element, kind);
  EXPECT_EQ(pose.status().index, row);
  EXPECT_FALSE(pose.status().message.empty());
}

TEST(RelativePose, KeepsTheDoublesGiven) {
  testing::Random random(1);
  const Matrix3d r = random.Rotation();
  const Vector3d t(1e100, -2, 1e-300);
  const auto pose = RelativePose::Make(r, t);
  ASSERT_TRUE(pose.ok()) << pose.status().ToString();
  EXPECT_EQ(pose->rotation(), r);
  EXPECT_EQ(pose->translation(), t);
  EXPECT_EQ(pose->rotation_error(), 0.0);
  EXPECT_EQ(pose->translation_error(), 0.0);
  EXPECT_FALSE(pose->world().has_value());
}

TEST(RelativePose, NamesTheRowThatIsNotFinite) {
  for (double bad : {kNan, kInfinity, -kInfinity}) {
    for (int i = 0; i < 3; ++i) {
      Vector3d t = Vector3d::Zero();
      t[i] = bad;
      ExpectFailure(RelativePose::Make(Matrix3d::Identity(), t), StatusCode::kNonFinite,
                    ElementKind::kRow, i);
      Matrix3d r = Matrix3d::Identity();
      r(i, 1) = bad;
      ExpectFailure(RelativePose::Make(r, Vector3d::Zero()), StatusCode::kNonFinite,
                    ElementKind::kRow, i);
    }
  }
}

TEST(RelativePose, NamesTheRowThatIsOutOfRange) {
  const Vector3d t(0, std::nextafter(1e100, kInfinity), 0);
  ExpectFailure(RelativePose::Make(Matrix3d::Identity(), t), StatusCode::kOutOfRange,
                ElementKind::kRow, 1);
}

TEST(RelativePose, RefusesReflectionsAndZero) {
  Matrix3d r = Matrix3d::Identity();
  r(2, 2) = -1;
  ExpectFailure(RelativePose::Make(r, Vector3d::Zero()), StatusCode::kBadRotation,
                ElementKind::kNone, -1);
  ExpectFailure(RelativePose::Make(Matrix3d::Zero(), Vector3d::Zero()), StatusCode::kBadRotation,
                ElementKind::kRow, 0);
  ExpectFailure(RelativePose::Make(1e200 * Matrix3d::Identity(), Vector3d::Zero()),
                StatusCode::kBadRotation, ElementKind::kRow, 0);
}

// An off-diagonal entry of RᵀR is exactly the shear here: the largest double that passes is 1e-6.
TEST(RelativePose, TheLimitOfOneMillionthIsExact) {
  Matrix3d r = Matrix3d::Identity();
  r(1, 2) = 1e-6;
  EXPECT_TRUE(RelativePose::Make(r, Vector3d::Zero()).ok());
  r(1, 2) = std::nextafter(1e-6, 1.0);
  ExpectFailure(RelativePose::Make(r, Vector3d::Zero()), StatusCode::kBadRotation,
                ElementKind::kRow, 2);
  // 1 + x on the diagonal gives 2 x + x^2.
  r = Matrix3d::Identity();
  r(0, 0) = 1 + 0.5e-6;
  EXPECT_FALSE(RelativePose::Make(r, Vector3d::Zero()).ok());
  r(0, 0) = 1 + 0.499999e-6;
  EXPECT_TRUE(RelativePose::Make(r, Vector3d::Zero()).ok());
}

// Exactly: |det Rp * R - adj(Rp) Rq| <= error * det Rp entrywise, and likewise for t.
void ExpectBoundsHold(const RelativePose& pose) {
  const auto& [p, q] = *pose.world();
  const DyadicVector row0 = ToDyadic(p.rotation.row(0)), row1 = ToDyadic(p.rotation.row(1)),
                     row2 = ToDyadic(p.rotation.row(2));
  const std::array<DyadicVector, 3> cofactors = {Cross(row1, row2), Cross(row2, row0),
                                                 Cross(row0, row1)};
  const Dyadic det = Dot(row0, cofactors[0]);
  ASSERT_GT(det.sign(), 0);
  const DyadicVector difference = ToDyadic(q.translation) - ToDyadic(p.translation);
  const auto expect_within = [&](const Dyadic& exact_times_det, double value, double error) {
    Dyadic off = det * Dyadic(value) - exact_times_det;
    if (off.sign() < 0) off = -off;
    EXPECT_LE((off - det * Dyadic(error)).sign(), 0);
  };
  for (int i = 0; i < 3; ++i) {
    // Row i of the adjugate is column i of the cofactors.
    const DyadicVector adjugate = {cofactors[0][i], cofactors[1][i], cofactors[2][i]};
    for (int j = 0; j < 3; ++j) {
      expect_within(Dot(adjugate, ToDyadic(q.rotation.col(j))), pose.rotation()(i, j),
                    pose.rotation_error());
    }
    expect_within(Dot(adjugate, difference), pose.translation()[i], pose.translation_error());
  }
}

TEST(RelativePose, FromWorldStaysWithinItsBounds) {
  testing::Random random(2);
  for (int i = 0; i < 3000; ++i) {
    WorldPose p, q;
    p.rotation = random.Rotation();
    q.rotation = random.Rotation();
    // As far from orthonormal as is legal: about 1e-6 in RᵀR.
    p.rotation *= 1 + random.Uniform(-4.9e-7, 4.9e-7);
    q.rotation *= 1 + random.Uniform(-4.9e-7, 4.9e-7);
    const double scale = std::ldexp(1.0, random.Int(-1070, 330));
    p.translation = scale * Vector3d(random.Uniform(-1, 1), random.Uniform(-1, 1), random.Unit());
    q.translation = p.translation * (i % 3 == 0 ? 1.0000001 : -0.3);
    for (int mode : {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
      std::fesetround(mode);
      const auto pose = RelativePose::FromWorld(p, q);
      std::fesetround(FE_TONEAREST);
      ASSERT_TRUE(pose.ok()) << pose.status().ToString();
      ExpectBoundsHold(*pose);
    }
  }
}

// The bounds are worth something: 24 and 40 units of rounding.
TEST(RelativePose, FromWorldBoundsAreTight) {
  testing::Random random(3);
  WorldPose p{random.Rotation(), Vector3d(1, 2, 3)}, q{random.Rotation(), Vector3d(-5, 0, 1)};
  const auto pose = RelativePose::FromWorld(p, q);
  ASSERT_TRUE(pose.ok());
  EXPECT_LT(pose->rotation_error(), 6e-15);
  EXPECT_LT(pose->translation_error(), 6e-14);
  ASSERT_TRUE(pose->world().has_value());
  EXPECT_EQ(pose->world()->first.rotation, p.rotation);
  EXPECT_EQ(pose->world()->second.translation, q.translation);
}

TEST(RelativePose, FromWorldRefusesWhatMakeRefuses) {
  WorldPose good, bad;
  bad.translation[2] = kNan;
  ExpectFailure(RelativePose::FromWorld(bad, good), StatusCode::kNonFinite, ElementKind::kRow, 2);
  ExpectFailure(RelativePose::FromWorld(good, bad), StatusCode::kNonFinite, ElementKind::kRow, 2);
  bad = {};
  bad.rotation(1, 1) = 2;
  ExpectFailure(RelativePose::FromWorld(bad, good), StatusCode::kBadRotation, ElementKind::kRow, 1);
  // Each in range, their difference not.
  WorldPose left, right;
  left.translation[0] = -1e100;
  right.translation[0] = 1e100;
  ExpectFailure(RelativePose::FromWorld(left, right), StatusCode::kOutOfRange, ElementKind::kRow,
                0);
}

}  // namespace
}  // namespace touchstone
