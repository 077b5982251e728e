// SPDX-License-Identifier: MIT
#include "touchstone/core/proximity/penetration_depth.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <utility>

#include "touchstone/core/cd_dual/cd_dual.h"
#include "touchstone/core/proximity/distance.h"
#include "touchstone/tests/proximity/brute_force.h"
#include "touchstone/tests/testing/shapes.h"

namespace touchstone::testing {
namespace {

const Eigen::Matrix3d kUpright = Eigen::Matrix3d::Identity();

void ExpectSound(const Placement& x, const PenetrationResult& result) {
  ASSERT_TRUE(std::isfinite(result.depth.value) && std::isfinite(result.depth.error) &&
              result.translation.allFinite() && result.direction.allFinite() &&
              result.point_on_p.allFinite() && result.point_on_q.allFinite())
      << x.name;
  EXPECT_LE(result.lower, result.upper) << x.name;
  if (result.verdict != Verdict::kOverlap) {
    EXPECT_EQ(result.depth.value, 0.0) << x.name;
    EXPECT_TRUE(result.translation.isZero(0.0)) << x.name;
    return;
  }
  EXPECT_LE(result.lower, result.depth.value + result.depth.error) << x.name;
  EXPECT_GE(result.upper, result.depth.value - result.depth.error) << x.name;
  if (!result.minimal) return;
  const double size = 1.75 * SizeOf(x.p, x.q, x.pose);
  EXPECT_GT(result.depth.value, 0.0) << x.name;
  EXPECT_LE(result.depth.error, 1e-12 * result.depth.condition * result.depth.value) << x.name;
  EXPECT_NEAR(result.translation.norm(), result.depth.value, 2e-12 * size) << x.name;
  EXPECT_LE((result.point_on_p - result.point_on_q - result.translation).norm(), 4e-12 * size)
      << x.name;
  EXPECT_LE(result.depth.value - result.lower, 1e-12 * size) << x.name;
  EXPECT_LE(result.upper - result.depth.value, 1e-12 * size) << x.name;
}

TEST(PenetrationDepth, AgreesWithBruteForceOverAllFacets) {
  std::map<FaceClass, int> met;
  std::map<Verdict, int> verdicts;
  std::vector<Placement> placements = SmallPlacements(/*seed=*/31, 1500);
  for (Placement& x : RoundPlacements(/*seed=*/32, 200)) placements.push_back(std::move(x));
  for (const Placement& x : placements) {
    const PenetrationResult result = PenetrationDepth(x.p, x.q, x.pose);
    ExpectSound(x, result);
    ASSERT_EQ(result.verdict, Collide(x.p, x.q, x.pose).verdict) << x.name;
    ++verdicts[result.verdict];
    if (result.verdict != Verdict::kOverlap) continue;
    ASSERT_TRUE(result.minimal && result.facet) << x.name;
    EXPECT_NEAR(result.depth.value, DepthByBruteForce(x.p, x.q, x.pose),
                1e-12 * SizeOf(x.p, x.q, x.pose))
        << x.name;
    ++met[result.facet->face_class];
  }
  for (const Verdict verdict : {Verdict::kSeparate, Verdict::kTouch, Verdict::kOverlap})
    EXPECT_GT(verdicts[verdict], 50) << ToString(verdict);
  for (const FaceClass c : {FaceClass::kFaceVertex, FaceClass::kVertexFace, FaceClass::kEdgeEdge,
                            FaceClass::kFaceEdge, FaceClass::kEdgeFace, FaceClass::kFaceFace}) {
    EXPECT_GT(met[c], 0) << ToString(c);
  }
}

// The convention: Q moved by the translation just touches P, and moved a little less still
// overlaps.
TEST(PenetrationDepth, QMovedByTheTranslationJustTouches) {
  int moved = 0;
  for (const Placement& x : RoundPlacements(/*seed=*/33, 200)) {
    const PenetrationResult result = PenetrationDepth(x.p, x.q, x.pose);
    if (result.verdict != Verdict::kOverlap) continue;
    const double size = SizeOf(x.p, x.q, x.pose);
    const auto at = [&](double factor) {
      return MustPose(x.pose.rotation(), x.pose.translation() + factor * result.translation);
    };
    const DistanceResult distance = Distance(x.p, x.q, at(1.0));
    EXPECT_LE(distance.distance.value, 1e-12 * size) << x.name;
    EXPECT_EQ(Collide(x.p, x.q, at(1.0 + 1e-9)).verdict, Verdict::kSeparate) << x.name;
    EXPECT_EQ(Collide(x.p, x.q, at(1.0 - 1e-9)).verdict, Verdict::kOverlap) << x.name;
    ++moved;
  }
  EXPECT_GT(moved, 50);
}

TEST(PenetrationDepth, BoxesInEachOther) {
  const ConvexPolyhedron box = MustBuild(Box({1, 1, 1})), small = MustBuild(Box({0.25, 0.5, 0.25}));
  const PenetrationResult beside = PenetrationDepth(box, box, MustPose(kUpright, {1.5, 0.25, 0}));
  ASSERT_EQ(beside.verdict, Verdict::kOverlap);
  EXPECT_NEAR(beside.depth.value, 0.5, beside.depth.error);
  EXPECT_LE((beside.translation - Eigen::Vector3d(0.5, 0, 0)).norm(), beside.foot_error);
  EXPECT_EQ(beside.facet->face_class, FaceClass::kFaceFace);
  // Wholly inside: out by the nearest wall, and through it.
  const PenetrationResult inside = PenetrationDepth(box, small, MustPose(kUpright, {0, 0, -0.125}));
  ASSERT_EQ(inside.verdict, Verdict::kOverlap);
  EXPECT_NEAR(inside.depth.value, 1.125, inside.depth.error);
  EXPECT_LE((inside.translation - Eigen::Vector3d(0, 0, -1.125)).norm(), inside.foot_error);
}

// Six facets of M at exactly the same distance.
TEST(PenetrationDepth, ConcentricCubesTie) {
  const ConvexPolyhedron box = MustBuild(Box({1, 1, 1}));
  for (const Certainty certainty : {Certainty::kExact, Certainty::kFloat}) {
    const PenetrationResult result = PenetrationDepth(box, box, RelativePose(), {certainty});
    ASSERT_EQ(result.verdict, Verdict::kOverlap);
    EXPECT_NEAR(result.depth.value, 2.0, result.depth.error);
    if (certainty == Certainty::kExact) {
      EXPECT_TRUE(result.minimal);
    }
  }
}

// What exact ranking is for: two facets of M whose distances differ by less than doubles can tell
// at this size.
TEST(PenetrationDepth, FacetsThatDifferByOneUlp) {
  const double ulp = 0x1p-52;
  const ConvexPolyhedron p = MustBuild(Box({1, 1, 1})), q = MustBuild(Box({1, 1, 1}));
  int right = 0;
  for (const int axis : {0, 1, 2}) {
    for (const double sense : {-1.0, 1.0}) {
      Eigen::Vector3d t = Eigen::Vector3d::Zero();
      t[axis] = sense * ulp;
      const PenetrationResult result = PenetrationDepth(p, q, MustPose(kUpright, t));
      ASSERT_EQ(result.verdict, Verdict::kOverlap);
      Eigen::Vector3d::Index along = 0;
      result.direction.cwiseAbs().maxCoeff(&along);
      right += along == axis && result.direction[axis] * sense > 0.0;
    }
  }
  EXPECT_EQ(right, 6);
}

TEST(PenetrationDepth, OneUlpDeep) {
  const ConvexPolyhedron box = MustBuild(Box({1, 1, 1}));
  const double ulp = 2.0 - std::nextafter(2.0, 1.0);
  const PenetrationResult result =
      PenetrationDepth(box, box, MustPose(kUpright, {2.0 - ulp, 0.5, 0.25}));
  ASSERT_EQ(result.verdict, Verdict::kOverlap);
  EXPECT_TRUE(result.minimal);
  EXPECT_NEAR(result.depth.value, ulp, result.depth.error);
  EXPECT_LE(result.depth.error, 1e-12 * 8.0);
  EXPECT_EQ(result.direction, Eigen::Vector3d::UnitX());
}

TEST(PenetrationDepth, TouchAndSeparateAreAnswers) {
  const ConvexPolyhedron box = MustBuild(Box({1, 1, 1}));
  const PenetrationResult touch = PenetrationDepth(box, box, MustPose(kUpright, {2, 0.5, 0.25}));
  EXPECT_EQ(touch.verdict, Verdict::kTouch);
  EXPECT_EQ(touch.depth.value, 0.0);
  EXPECT_EQ(touch.certificate.kind, CertificateKind::kTouchingFacet);
  ASSERT_TRUE(touch.facet);
  EXPECT_EQ(touch.facet->face_class, FaceClass::kFaceFace);
  const PenetrationResult apart = PenetrationDepth(box, box, MustPose(kUpright, {3, 0.5, 0.25}));
  EXPECT_EQ(apart.verdict, Verdict::kSeparate);
  EXPECT_EQ(apart.depth.value, 0.0);
  EXPECT_NE(apart.certificate.kind, CertificateKind::kNone);
}

TEST(PenetrationDepth, DoesNotChangeWhenTheBodiesAreExchanged) {
  int compared = 0;
  for (const Placement& x : SmallPlacements(/*seed=*/34, 800)) {
    if (!(x.pose.rotation() * x.pose.rotation().transpose()).isIdentity(0.0)) continue;
    const PenetrationResult there = PenetrationDepth(x.p, x.q, x.pose);
    const PenetrationResult back = PenetrationDepth(x.q, x.p, Inverse(x.pose));
    ASSERT_EQ(there.verdict, back.verdict) << x.name;
    EXPECT_LE(std::abs(there.depth.value - back.depth.value), there.depth.error + back.depth.error)
        << x.name;
    compared += there.verdict == Verdict::kOverlap;
  }
  EXPECT_GT(compared, 100);
}

TEST(PenetrationDepth, ScalesToTheBit) {
  for (const Placement& x : SmallPlacements(/*seed=*/35, 200)) {
    const PenetrationResult plain = PenetrationDepth(x.p, x.q, x.pose);
    for (const double factor : {0x1p-300, 0x1p-1, 0x1p300}) {
      const Placement y = Scaled(x, factor);
      const PenetrationResult scaled = PenetrationDepth(y.p, y.q, y.pose);
      ASSERT_EQ(scaled.verdict, plain.verdict) << x.name;
      EXPECT_EQ(scaled.depth.value, factor * plain.depth.value) << x.name;
      EXPECT_EQ(scaled.translation, factor * plain.translation) << x.name;
    }
  }
}

TEST(PenetrationDepth, ExtremesOfScale) {
  int overlaps = 0;
  for (const Placement& x : ExtremePlacements(/*seed=*/36, 0, 40)) {
    const PenetrationResult result = PenetrationDepth(x.p, x.q, x.pose);
    ExpectSound(x, result);
    EXPECT_EQ(result.verdict, Collide(x.p, x.q, x.pose).verdict);
    if (result.verdict != Verdict::kOverlap) continue;
    ++overlaps;
    EXPECT_TRUE(result.minimal);
    EXPECT_NEAR(result.depth.value, DepthByBruteForce(x.p, x.q, x.pose),
                1e-11 * SizeOf(x.p, x.q, x.pose));
  }
  EXPECT_GT(overlaps, 60);
}

TEST(PenetrationDepth, FloatIsNeverWrong) {
  int overlaps = 0, undecided = 0;
  std::vector<Placement> placements = SmallPlacements(/*seed=*/37, 800);
  for (Placement& x : RoundPlacements(/*seed=*/38, 200)) placements.push_back(std::move(x));
  for (const Placement& x : placements) {
    const PenetrationResult exact = PenetrationDepth(x.p, x.q, x.pose);
    const PenetrationResult result = PenetrationDepth(x.p, x.q, x.pose, {Certainty::kFloat});
    ExpectSound(x, result);
    EXPECT_EQ(result.exact_signs, 0) << x.name;
    if (result.verdict == Verdict::kUndecided) {
      ++undecided;
      EXPECT_LE(exact.depth.value, 1e-12 * SizeOf(x.p, x.q, x.pose)) << x.name;
      continue;
    }
    ASSERT_EQ(result.verdict, exact.verdict) << x.name;
    if (exact.verdict != Verdict::kOverlap) continue;
    ++overlaps;
    EXPECT_LE(result.lower, exact.depth.value + exact.depth.error) << x.name;
    EXPECT_GE(result.upper, exact.depth.value - exact.depth.error) << x.name;
    EXPECT_LE(std::abs(result.depth.value - exact.depth.value),
              result.depth.error + exact.depth.error)
        << x.name;
  }
  EXPECT_GT(overlaps, 200);
  EXPECT_GT(undecided, 0);
}

// Frames of 0.3 degrees, in and out of each other.
TEST(PenetrationDepth, WarmAgreesWithColdAlongAMotion) {
  const ConvexPolyhedron p = MustBuild(RoundBody(100, {2, 1, 1}, 39));
  const ConvexPolyhedron q = MustBuild(RoundBody(80, {1, 1.5, 0.7}, 40));
  PenetrationCache cache;
  long warm_rounds = 0, cold_rounds = 0;
  int warm_count = 0, overlaps = 0;
  for (int frame = 0; frame < 1200; ++frame) {
    const double angle = 0.005 * frame;
    const Eigen::Matrix3d turn =
        (Eigen::AngleAxisd(angle, Eigen::Vector3d(1, 2, 3).normalized())).toRotationMatrix();
    const double away = 1.3 + 1.5 * std::cos(3.0 * angle);
    const RelativePose pose = MustPose(turn, {away * std::cos(angle), away * std::sin(angle), 0.1});
    const PenetrationResult cold = PenetrationDepth(p, q, pose);
    const PenetrationResult warm = PenetrationDepth(p, q, pose, {}, &cache);
    ASSERT_EQ(warm.verdict, cold.verdict) << frame;
    ExpectSound({"frame " + std::to_string(frame), p, q, pose}, warm);
    if (cold.verdict != Verdict::kOverlap) continue;
    ++overlaps;
    ASSERT_TRUE(warm.minimal && warm.facet);
    EXPECT_LE(std::abs(warm.depth.value - cold.depth.value), warm.depth.error + cold.depth.error);
    EXPECT_EQ(warm.facet->feature_p, cold.facet->feature_p);
    EXPECT_EQ(warm.facet->feature_q, cold.facet->feature_q);
    warm_rounds += warm.counts.faces_visited;
    cold_rounds += cold.counts.faces_visited;
    warm_count += warm.warm;
  }
  EXPECT_GT(overlaps, 400);
  EXPECT_GT(20 * warm_count, 19 * overlaps) << "the cache is of no use";
  EXPECT_LT(4 * warm_rounds, cold_rounds);
}

TEST(PenetrationDepth, AForeignCacheChangesNoAnswer) {
  PenetrationCache cache;
  int warm = 0;
  for (const Placement& x : SmallPlacements(/*seed=*/41, 600)) {
    const PenetrationResult cold = PenetrationDepth(x.p, x.q, x.pose);
    // Whatever the last bodies left.
    const PenetrationResult reused = PenetrationDepth(x.p, x.q, x.pose, {}, &cache);
    ASSERT_EQ(reused.verdict, cold.verdict) << x.name;
    EXPECT_LE(std::abs(reused.depth.value - cold.depth.value),
              reused.depth.error + cold.depth.error)
        << x.name;
    EXPECT_EQ(reused.minimal, cold.minimal) << x.name;
    warm += reused.warm;
  }
  EXPECT_GT(warm, 0) << "the caches were never taken up";
}

// The proof of the lower bound: closed, and around o.
TEST(PenetrationDepth, TheInnerPolytopeIsClosed) {
  for (const Placement& x : RoundPlacements(/*seed=*/42, 60)) {
    const PenetrationResult result =
        PenetrationDepth(x.p, x.q, x.pose, {.certainty = Certainty::kExact, .certificate = true});
    if (result.verdict != Verdict::kOverlap) {
      EXPECT_TRUE(result.inner_polytope.empty());
      continue;
    }
    std::map<std::array<int, 4>, int> sides;
    for (const auto& t : result.inner_polytope) {
      for (int i = 0; i < 3; ++i) ++sides[{t[i].p, t[i].q, t[(i + 1) % 3].p, t[(i + 1) % 3].q}];
    }
    EXPECT_EQ(sides.size(), 3 * result.inner_polytope.size()) << x.name;
    for (const auto& [side, count] : sides) {
      EXPECT_EQ(count, 1);
      EXPECT_TRUE((sides.contains({side[2], side[3], side[0], side[1]}))) << x.name;
    }
  }
}

// Many facets of M about as near as the nearest: round bodies, o in the middle.
TEST(PenetrationDepth, RoundBodiesAboutTheirMiddle) {
  for (const int n : {50, 300}) {
    const ConvexPolyhedron p = MustBuild(RoundBody(n, {1, 1, 1}, 43));
    const ConvexPolyhedron q = MustBuild(RoundBody(n, {1, 1, 1}, 44));
    const PenetrationResult result = PenetrationDepth(p, q, RelativePose());
    ASSERT_EQ(result.verdict, Verdict::kOverlap);
    EXPECT_TRUE(result.minimal);
    if (n == 50) {
      EXPECT_NEAR(result.depth.value, DepthByBruteForce(p, q, RelativePose()), 1e-12);
    }
    EXPECT_GT(result.counts.faces_visited, 20);
  }
}

}  // namespace
}  // namespace touchstone::testing
