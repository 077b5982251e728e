// SPDX-License-Identifier: MIT
#include "touchstone/core/proximity/distance.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <utility>

#include "touchstone/core/cd_dual/cd_dual.h"
#include "touchstone/tests/proximity/brute_force.h"
#include "touchstone/tests/testing/shapes.h"

namespace touchstone::testing {
namespace {

const Eigen::Matrix3d kUpright = Eigen::Matrix3d::Identity();

// Everything that a sound result says of itself.
void ExpectSound(const Placement& x, const DistanceResult& result) {
  ASSERT_TRUE(std::isfinite(result.distance.value) && std::isfinite(result.distance.error) &&
              result.point_on_p.allFinite() && result.point_on_q.allFinite() &&
              result.direction.allFinite())
      << x.name;
  EXPECT_LE(result.lower, result.upper) << x.name;
  if (result.kind != DistanceKind::kSeparate) {
    EXPECT_EQ(result.distance.value, 0.0) << x.name;
    return;
  }
  const double size = SizeOf(x.p, x.q, x.pose);
  EXPECT_LE(result.lower, result.distance.value + result.distance.error) << x.name;
  EXPECT_GE(result.upper, result.distance.value - result.distance.error) << x.name;
  EXPECT_NEAR(result.direction.norm(), 1.0, 1e-15) << x.name;
  if (!result.optimal) return;
  EXPECT_LE(result.distance.error, 1e-12 * result.distance.condition * result.distance.value)
      << x.name;
  EXPECT_LE(result.point_error, 1e-12 * 1.75 * size) << x.name;
  EXPECT_NEAR((result.point_on_q - result.point_on_p).norm(), result.distance.value, 4e-12 * size)
      << x.name;
}

TEST(Distance, AgreesWithBruteForceOverAllFeatures) {
  std::map<std::pair<FeatureKind, FeatureKind>, int> met;
  int meets = 0;
  std::vector<Placement> placements = SmallPlacements(/*seed=*/11, 1500);
  for (Placement& x : RoundPlacements(/*seed=*/12, 300)) placements.push_back(std::move(x));
  for (const Placement& x : placements) {
    const DistanceResult result = Distance(x.p, x.q, x.pose);
    ExpectSound(x, result);
    if (Collide(x.p, x.q, x.pose).verdict != Verdict::kSeparate) {
      EXPECT_EQ(result.kind, DistanceKind::kMeet) << x.name;
      EXPECT_NE(result.certificate.kind, CertificateKind::kNone) << x.name;
      ++meets;
      continue;
    }
    ASSERT_EQ(result.kind, DistanceKind::kSeparate) << x.name;
    EXPECT_TRUE(result.optimal) << x.name;
    EXPECT_NEAR(result.distance.value, DistanceByBruteForce(x.p, x.q, x.pose),
                1e-12 * SizeOf(x.p, x.q, x.pose))
        << x.name;
    ++met[{result.feature_p->kind, result.feature_q->kind}];
  }
  EXPECT_GT(meets, 100);
  for (const FeatureKind p : {FeatureKind::kVertex, FeatureKind::kEdge, FeatureKind::kFace}) {
    for (const FeatureKind q : {FeatureKind::kVertex, FeatureKind::kEdge, FeatureKind::kFace}) {
      EXPECT_GT((met[{p, q}]), 0) << ToString(p) << " " << ToString(q);
    }
  }
}

TEST(Distance, BoxesFaceToFaceEdgeToEdgeVertexToVertex) {
  const ConvexPolyhedron box = MustBuild(Box({1, 1, 1}));
  struct Case {
    Eigen::Vector3d translation;
    double distance;
    FeatureKind feature;
  };
  for (const Case& c :
       {Case{{5, 0.5, 0}, 3, FeatureKind::kFace}, Case{{5, 6, 0.25}, 5, FeatureKind::kEdge},
        Case{{3, 4, 4}, 3, FeatureKind::kVertex}}) {
    const DistanceResult result = Distance(box, box, MustPose(kUpright, c.translation));
    ASSERT_EQ(result.kind, DistanceKind::kSeparate);
    EXPECT_NEAR(result.distance.value, c.distance, result.distance.error);
    EXPECT_EQ(result.feature_p->kind, c.feature);
    EXPECT_EQ(result.feature_q->kind, c.feature);
  }
}

// One unit in the last place of the translation is all that keeps them apart.
TEST(Distance, OneUlpFromTouching) {
  const ConvexPolyhedron box = MustBuild(Box({1, 1, 1}));
  const double ulp = std::nextafter(2.0, 3.0) - 2.0;
  const DistanceResult apart = Distance(box, box, MustPose(kUpright, {2.0 + ulp, 0.5, 0.25}));
  ASSERT_EQ(apart.kind, DistanceKind::kSeparate);
  EXPECT_TRUE(apart.optimal);
  EXPECT_NEAR(apart.distance.value, ulp, 4.0 * 0x1p-52 * ulp);
  EXPECT_EQ(apart.tier, Tier::kExact);
  const DistanceResult touching = Distance(box, box, MustPose(kUpright, {2.0, 0.5, 0.25}));
  EXPECT_EQ(touching.kind, DistanceKind::kMeet);
  EXPECT_EQ(touching.certificate.kind, CertificateKind::kTouchingFacet);
  EXPECT_EQ(Distance(box, box, MustPose(kUpright, {2.0, 0.5, 0.25}), {Certainty::kFloat}).kind,
            DistanceKind::kUndecided);
}

TEST(Distance, DoesNotChangeWhenTheBodiesAreExchanged) {
  int compared = 0;
  for (const Placement& x : SmallPlacements(/*seed=*/13, 800)) {
    if (!(x.pose.rotation() * x.pose.rotation().transpose()).isIdentity(0.0)) continue;
    const DistanceResult there = Distance(x.p, x.q, x.pose);
    const DistanceResult back = Distance(x.q, x.p, Inverse(x.pose));
    ASSERT_EQ(there.kind, back.kind) << x.name;
    if (there.kind != DistanceKind::kSeparate) continue;
    EXPECT_LE(std::abs(there.distance.value - back.distance.value),
              there.distance.error + back.distance.error)
        << x.name;
    EXPECT_EQ(there.feature_p->kind, back.feature_q->kind) << x.name;
    ++compared;
  }
  EXPECT_GT(compared, 100);
}

// Powers of two change no bit but exponents.
TEST(Distance, ScalesToTheBit) {
  for (const Placement& x : SmallPlacements(/*seed=*/14, 200)) {
    const DistanceResult plain = Distance(x.p, x.q, x.pose);
    for (const double factor : {0x1p-300, 0x1p-1, 0x1p300}) {
      const Placement y = Scaled(x, factor);
      const DistanceResult scaled = Distance(y.p, y.q, y.pose);
      ASSERT_EQ(scaled.kind, plain.kind) << x.name;
      EXPECT_EQ(scaled.distance.value, factor * plain.distance.value) << x.name;
      EXPECT_EQ(scaled.point_on_p, factor * plain.point_on_p) << x.name;
      EXPECT_EQ(scaled.simplex, plain.simplex) << x.name;
    }
  }
}

// Bodies of very different sizes, far from the origin, thin as a needle.
TEST(Distance, ExtremesOfScale) {
  int separate = 0;
  for (const Placement& x : ExtremePlacements(/*seed=*/15, -2, 20)) {
    const DistanceResult result = Distance(x.p, x.q, x.pose);
    ExpectSound(x, result);
    const Verdict verdict = Collide(x.p, x.q, x.pose).verdict;
    EXPECT_EQ(result.kind,
              verdict == Verdict::kSeparate ? DistanceKind::kSeparate : DistanceKind::kMeet);
    if (verdict == Verdict::kSeparate) ++separate;
  }
  EXPECT_GT(separate, 40);
}

TEST(Distance, FloatIsNeverWrong) {
  int undecided = 0, separate = 0;
  std::vector<Placement> placements = SmallPlacements(/*seed=*/16, 800);
  for (Placement& x : RoundPlacements(/*seed=*/17, 200)) placements.push_back(std::move(x));
  for (const Placement& x : placements) {
    const DistanceResult exact = Distance(x.p, x.q, x.pose);
    const DistanceResult result = Distance(x.p, x.q, x.pose, {Certainty::kFloat});
    ExpectSound(x, result);
    EXPECT_EQ(result.exact_signs, 0) << x.name;
    if (result.kind == DistanceKind::kUndecided) {
      ++undecided;
      EXPECT_LE(exact.distance.value, 1e-12 * SizeOf(x.p, x.q, x.pose)) << x.name;
      continue;
    }
    ASSERT_EQ(result.kind, exact.kind) << x.name;
    if (exact.kind != DistanceKind::kSeparate) continue;
    ++separate;
    EXPECT_LE(std::abs(result.distance.value - exact.distance.value),
              result.distance.error + exact.distance.error)
        << x.name;
    EXPECT_LE(result.lower, exact.distance.value + exact.distance.error) << x.name;
    EXPECT_GE(result.upper, exact.distance.value - exact.distance.error) << x.name;
  }
  EXPECT_GT(separate, 300);
  EXPECT_GT(undecided, 0) << "doubles cannot prove a touch";
}

TEST(Distance, WarmAgreesWithColdAlongAMotion) {
  const ConvexPolyhedron p = MustBuild(RoundBody(100, {2, 1, 1}, 18));
  const ConvexPolyhedron q = MustBuild(RoundBody(80, {1, 1.5, 0.7}, 19));
  DistanceCache cache;
  long warm_supports = 0, cold_supports = 0;
  for (int frame = 0; frame < 400; ++frame) {
    const double angle = 0.005 * frame;
    const Eigen::Matrix3d turn =
        (Eigen::AngleAxisd(angle, Eigen::Vector3d(1, 2, 3).normalized())).toRotationMatrix();
    const RelativePose pose = MustPose(turn, {3.4 * std::cos(angle), 3.0 * std::sin(angle), 0.5});
    const DistanceResult cold = Distance(p, q, pose), warm = Distance(p, q, pose, {}, &cache);
    ASSERT_EQ(warm.kind, cold.kind) << frame;
    ASSERT_EQ(warm.kind, DistanceKind::kSeparate);
    EXPECT_LE(std::abs(warm.distance.value - cold.distance.value),
              warm.distance.error + cold.distance.error);
    EXPECT_TRUE(warm.optimal);
    EXPECT_EQ(warm.feature_p, cold.feature_p);
    EXPECT_EQ(warm.feature_q, cold.feature_q);
    warm_supports += warm.counts.support_calls;
    cold_supports += cold.counts.support_calls;
  }
  EXPECT_LT(2 * warm_supports, cold_supports) << "the cache is of no use";
}

// A cache tells where to begin and nothing else: one from other bodies, or made up, is harmless.
TEST(Distance, AForeignCacheChangesNoAnswer) {
  Random random(20);
  for (const Placement& x : SmallPlacements(/*seed=*/21, 300)) {
    const DistanceResult cold = Distance(x.p, x.q, x.pose);
    DistanceCache cache;
    cache.simplex.size = random.Int(1, 3);
    for (VertexPair& pair : cache.simplex.points) pair = {random.Int(-2, 12), random.Int(-2, 12)};
    const DistanceResult warm = Distance(x.p, x.q, x.pose, {}, &cache);
    ASSERT_EQ(warm.kind, cold.kind) << x.name;
    EXPECT_LE(std::abs(warm.distance.value - cold.distance.value),
              warm.distance.error + cold.distance.error)
        << x.name;
  }
}

}  // namespace
}  // namespace touchstone::testing
