// SPDX-License-Identifier: MIT
#include "touchstone/core/proximity/directional_distance.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "touchstone/core/cd_dual/cd_dual.h"
#include "touchstone/core/proximity/distance.h"
#include "touchstone/core/proximity/penetration_depth.h"
#include "touchstone/tests/proximity/brute_force.h"
#include "touchstone/tests/testing/shapes.h"

namespace touchstone::testing {
namespace {

const Eigen::Matrix3d kUpright = Eigen::Matrix3d::Identity();

DirectionalResult Ask(const Placement& x, const Eigen::Vector3d& s,
                      Certainty certainty = Certainty::kExact) {
  const auto result = DirectionalDistance(x.p, x.q, x.pose, s, {certainty});
  EXPECT_TRUE(result.ok()) << x.name;
  return *result;
}

// Along an axis, along a diagonal of the lattice, through a point of M near its vertices, anywhere.
Eigen::Vector3d SomeDirection(const Placement& x, Random* random) {
  const int kind = random->Int(0, 3);
  if (kind == 0) return (random->Int(0, 1) ? 1.0 : -1.0) * Eigen::Vector3d::Unit(random->Int(0, 2));
  if (kind == 1) {
    for (;;) {
      const Eigen::Vector3d s(random->Int(-2, 2), random->Int(-2, 2), random->Int(-2, 2));
      if (!s.isZero(0.0)) return s;
    }
  }
  if (kind == 2) {
    const Eigen::Vector3d s =
        x.p.vertex(random->Int(0, x.p.vertex_count() - 1)) -
        x.pose.rotation() * x.q.vertex(random->Int(0, x.q.vertex_count() - 1)) -
        x.pose.translation();
    if (s.norm() > 1e-3) return s;
  }
  return random->Uniform(0.1, 10.0) * random->Direction();
}

void ExpectSound(const Placement& x, const DirectionalResult& result) {
  if (result.kind != TravelKind::kInterval) return;
  for (const TravelEnd* end : {&result.enter, &result.leave}) {
    ASSERT_TRUE(std::isfinite(end->travel.value) && std::isfinite(end->travel.error)) << x.name;
    EXPECT_LE(end->travel.error, 1e-12 * end->travel.condition * std::abs(end->travel.value))
        << x.name;
    EXPECT_TRUE(end->facet) << x.name;
  }
  EXPECT_LE(result.enter.travel.value, result.leave.travel.value) << x.name;
}

TEST(DirectionalDistance, AgreesWithBruteForceOverAllPlanes) {
  Random random(71);
  std::map<TravelKind, int> kinds;
  std::map<FaceClass, int> classes;
  int grazing = 0, meeting = 0;
  std::vector<Placement> placements = SmallPlacements(/*seed=*/72, 1200);
  for (Placement& x : RoundPlacements(/*seed=*/73, 200)) placements.push_back(std::move(x));
  for (const Placement& x : placements) {
    const Eigen::Vector3d s = SomeDirection(x, &random);
    const DirectionalResult result = Ask(x, s);
    ExpectSound(x, result);
    ++kinds[result.kind];
    grazing += result.grazing;
    const TravelBounds bounds = TravelByBruteForce(x.p, x.q, x.pose, s);
    const double size = SizeOf(x.p, x.q, x.pose);
    if (result.kind == TravelKind::kNever) {
      // Some plane along s keeps M away, or the planes leave nothing: up to rounding.
      EXPECT_TRUE(bounds.least_across < 1e-12 * size || bounds.enter > bounds.leave) << x.name;
      continue;
    }
    ASSERT_EQ(result.kind, TravelKind::kInterval) << x.name;
    EXPECT_GT(bounds.least_across, -1e-12 * size) << x.name;
    const auto near = [&](const TravelEnd& end, double truth) {
      const double tolerance =
          1e-9 * end.travel.condition * std::abs(end.travel.value) + 1e-9 * size / s.norm();
      EXPECT_NEAR(end.travel.value, truth, tolerance) << x.name;
    };
    if (!result.grazing) {
      near(result.enter, bounds.enter);
      near(result.leave, bounds.leave);
    }
    const bool meets = result.enter.travel.value <= 0.0 && result.leave.travel.value >= 0.0;
    EXPECT_EQ(meets, Collide(x.p, x.q, x.pose).verdict != Verdict::kSeparate) << x.name;
    meeting += meets;
    ++classes[result.enter.facet->face_class];
  }
  EXPECT_GT(kinds[TravelKind::kNever], 50);
  EXPECT_GT(kinds[TravelKind::kInterval], 500);
  EXPECT_GT(grazing, 20);
  EXPECT_GT(meeting, 200);
  for (const FaceClass c : {FaceClass::kFaceVertex, FaceClass::kVertexFace, FaceClass::kEdgeEdge,
                            FaceClass::kFaceEdge, FaceClass::kEdgeFace, FaceClass::kFaceFace}) {
    EXPECT_GT(classes[c], 0) << ToString(c);
  }
}

TEST(DirectionalDistance, BoxesThatMeetMissAndGraze) {
  const ConvexPolyhedron box = MustBuild(Box({1, 1, 1}));
  const auto ask = [&](const Eigen::Vector3d& t, const Eigen::Vector3d& s) {
    return Ask({"boxes", box, box, MustPose(kUpright, t)}, s);
  };
  const auto expect = [](const DirectionalResult& r, double enter, double leave, bool grazing) {
    ASSERT_EQ(r.kind, TravelKind::kInterval);
    EXPECT_EQ(r.enter.travel.value, enter);
    EXPECT_EQ(r.leave.travel.value, leave);
    EXPECT_EQ(r.grazing, grazing);
  };
  expect(ask({3, 0.5, 0}, {-1, 0, 0}), 1, 5, false);
  expect(ask({3, 0.5, 0}, {1, 0, 0}), -5, -1, false);
  expect(ask({3, 0.5, 0}, {-2, 0, 0}), 0.5, 2.5, false);
  expect(ask({0.5, 0.5, 0}, {1, 0, 0}), -2.5, 1.5, false);
  // In contact as they are: an end is exactly zero.
  expect(ask({2, 0.5, 0}, {-1, 0, 0}), 0, 4, false);
  expect(ask({2, 0.5, 0}, {1, 0, 0}), -4, 0, false);
  // Past each other along a face, and along an edge.
  expect(ask({3, 2, 0}, {-1, 0, 0}), 1, 5, true);
  expect(ask({3, 2, -2}, {-1, 0, 0}), 1, 5, true);
  for (const Eigen::Vector3d& t : {Eigen::Vector3d(3, 2.5, 0), Eigen::Vector3d(3, 2, -2.25),
                                   Eigen::Vector3d(0, std::nextafter(2.0, 3.0), 0)}) {
    EXPECT_EQ(ask(t, {-1, 0, 0}).kind, TravelKind::kNever);
  }
}

// The line touches M in one vertex only.
TEST(DirectionalDistance, ASingleTravel) {
  const ConvexPolyhedron diamond = MustBuild(Octahedron());
  const DirectionalResult result =
      Ask({"octahedra", diamond, diamond, MustPose(kUpright, {5, 2, 0})}, {-1, 0, 0});
  ASSERT_EQ(result.kind, TravelKind::kInterval);
  EXPECT_EQ(result.enter.travel.value, 5.0);
  EXPECT_EQ(result.leave.travel.value, 5.0);
  EXPECT_TRUE(result.grazing);
}

TEST(DirectionalDistance, QMovedToTheEndsJustTouches) {
  Random random(74);
  int moved = 0;
  for (const Placement& x : RoundPlacements(/*seed=*/75, 200)) {
    const Eigen::Vector3d s = random.Uniform(0.1, 4.0) * random.Direction();
    const DirectionalResult result = Ask(x, s);
    if (result.kind != TravelKind::kInterval) continue;
    const double size = SizeOf(x.p, x.q, x.pose);
    const auto at = [&](double t) {
      return MustPose(x.pose.rotation(), x.pose.translation() + t * s);
    };
    const double enter = result.enter.travel.value, leave = result.leave.travel.value;
    for (const double t : {enter, leave}) {
      EXPECT_LE(Distance(x.p, x.q, at(t)).distance.value, 1e-11 * size) << x.name;
      EXPECT_LE(PenetrationDepth(x.p, x.q, at(t)).depth.value, 1e-11 * size) << x.name;
    }
    EXPECT_EQ(Collide(x.p, x.q, at(0.5 * (enter + leave))).verdict, Verdict::kOverlap) << x.name;
    const double beyond = 1e-3 * (leave - enter) + 1e-9 * size / s.norm();
    EXPECT_EQ(Collide(x.p, x.q, at(enter - beyond)).verdict, Verdict::kSeparate) << x.name;
    EXPECT_EQ(Collide(x.p, x.q, at(leave + beyond)).verdict, Verdict::kSeparate) << x.name;
    ++moved;
  }
  EXPECT_GT(moved, 60);
}

TEST(DirectionalDistance, MirrorsAndScales) {
  Random random(76);
  int compared = 0;
  for (const Placement& x : SmallPlacements(/*seed=*/77, 400)) {
    const Eigen::Vector3d s = SomeDirection(x, &random);
    const DirectionalResult there = Ask(x, s), back = Ask(x, -s);
    ASSERT_EQ(there.kind, back.kind) << x.name;
    EXPECT_EQ(there.grazing, back.grazing) << x.name;
    if (there.kind != TravelKind::kInterval) continue;
    ++compared;
    EXPECT_LE(std::abs(there.enter.travel.value + back.leave.travel.value),
              there.enter.travel.error + back.leave.travel.error)
        << x.name;
    EXPECT_LE(std::abs(there.leave.travel.value + back.enter.travel.value),
              there.leave.travel.error + back.enter.travel.error)
        << x.name;
    // Powers of two change no bit but exponents.
    for (const double factor : {0x1p-300, 0x1p2, 0x1p300}) {
      const DirectionalResult scaled = Ask(x, factor * s);
      EXPECT_EQ(scaled.enter.travel.value, there.enter.travel.value / factor) << x.name;
      EXPECT_EQ(scaled.leave.travel.value, there.leave.travel.value / factor) << x.name;
    }
  }
  EXPECT_GT(compared, 150);
}

TEST(DirectionalDistance, FloatIsNeverWrong) {
  Random random(78);
  int decided = 0, undecided = 0;
  std::vector<Placement> placements = SmallPlacements(/*seed=*/79, 600);
  for (Placement& x : RoundPlacements(/*seed=*/80, 300)) placements.push_back(std::move(x));
  for (const Placement& x : placements) {
    const Eigen::Vector3d s = SomeDirection(x, &random);
    const DirectionalResult exact = Ask(x, s), result = Ask(x, s, Certainty::kFloat);
    EXPECT_EQ(result.exact_signs, 0) << x.name;
    if (result.kind == TravelKind::kUndecided) {
      ++undecided;
      continue;
    }
    ++decided;
    ASSERT_EQ(result.kind, exact.kind) << x.name;
    if (exact.kind != TravelKind::kInterval) continue;
    EXPECT_LE(std::abs(result.enter.travel.value - exact.enter.travel.value),
              result.enter.travel.error + exact.enter.travel.error)
        << x.name;
    EXPECT_LE(std::abs(result.leave.travel.value - exact.leave.travel.value),
              result.leave.travel.error + exact.leave.travel.error)
        << x.name;
  }
  EXPECT_GT(decided, 250);
  EXPECT_GT(undecided, 0);
}

TEST(DirectionalDistance, ExtremesOfScale) {
  Random random(81);
  int i = 0, intervals = 0;
  for (const Placement& x : ExtremePlacements(/*seed=*/82, 0, 40)) {
    Eigen::Vector3d s = random.Direction();
    if (i % 4 == 1) s *= 1e-100 * 1.01;
    if (i % 4 == 2) s *= 1e99;
    if (i % 4 == 3) s = {1.0, 1e-200, -1e-320};
    ++i;
    const DirectionalResult result = Ask(x, s);
    ExpectSound(x, result);
    ASSERT_NE(result.kind, TravelKind::kUndecided);
    if (result.kind != TravelKind::kInterval) continue;
    ++intervals;
    const bool meets = result.enter.travel.value <= 0.0 && result.leave.travel.value >= 0.0;
    EXPECT_EQ(meets, Collide(x.p, x.q, x.pose).verdict != Verdict::kSeparate);
  }
  EXPECT_GT(intervals, 60);
}

TEST(DirectionalDistance, BadDirectionsAreAStatus) {
  const ConvexPolyhedron box = MustBuild(Box({1, 1, 1}));
  const RelativePose pose;
  const auto code = [&](const Eigen::Vector3d& s) {
    EXPECT_EQ(DirectionalDistance(box, box, pose, s).status().code,
              DirectionalDistanceAsPublished(box, box, pose, s).status().code);
    return DirectionalDistance(box, box, pose, s).status().code;
  };
  EXPECT_EQ(code({0, 0, 0}), StatusCode::kOutOfRange);
  EXPECT_EQ(code({1e-200, 0, 0}), StatusCode::kOutOfRange);
  EXPECT_EQ(code({0, 2e100, 0}), StatusCode::kOutOfRange);
  EXPECT_EQ(code({1e308, 1e308, 0}), StatusCode::kOutOfRange);
  EXPECT_EQ(code({std::numeric_limits<double>::quiet_NaN(), 1, 0}), StatusCode::kNonFinite);
  EXPECT_EQ(code({std::numeric_limits<double>::infinity(), 1, 0}), StatusCode::kNonFinite);
}

// Section 6 as printed, where its c serves: separate ellipsoids.
TEST(PublishedDirection, GivesTheNearerEndOfSeparateBodies) {
  Random random(82);
  int right = 0, total = 0;
  for (const Placement& x : RoundPlacements(/*seed=*/83, 300)) {
    const Eigen::Vector3d s = x.pose.translation() + 0.1 * random.Direction();
    const auto published = DirectionalDistanceAsPublished(x.p, x.q, x.pose, s);
    ASSERT_TRUE(published.ok());
    const DirectionalResult truth = Ask(x, s);
    EXPECT_EQ(published->kind == PublishedTravelKind::kNever, truth.kind == TravelKind::kNever)
        << x.name;
    if (published->kind != PublishedTravelKind::kTravel) continue;
    const TravelEnd& end = published->c_travel > 0.0 ? truth.enter : truth.leave;
    ++total;
    right += std::abs(published->travel - end.travel.value) <=
             1e-9 * end.travel.condition * std::abs(end.travel.value);
  }
  EXPECT_GT(total, 200);
  EXPECT_GT(right, 0.9 * total);
  EXPECT_LT(right, total) << "CD-DUALITY's own failures show here as well";
}

// The smallest found: two tetrahedra with coordinates of at most 1. The triangle of the fan that
// holds the shadow of o is that of a facet of M, so c = s is on the boundary of M, in the plane by
// which the line enters: d divides by zero. (The weights are 1/3 each, all positive as asked.)
TEST(PublishedDirection, COnTheBoundaryOfM) {
  const std::vector<std::vector<int>> faces = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
  const ConvexPolyhedron p = MustBuild({{{1, 0, 1}, {0, 0, 0}, {0, 0, 1}, {0, -1, 1}}, faces});
  const ConvexPolyhedron q = MustBuild({{{1, 0, 0}, {1, 1, -1}, {0, -1, 0}, {1, 0, -1}}, faces});
  const Placement x{"tetrahedra", p, q, RelativePose()};
  const Eigen::Vector3d s(0, 0, 1);
  const auto published = DirectionalDistanceAsPublished(p, q, x.pose, s);
  ASSERT_TRUE(published.ok());
  EXPECT_EQ(published->kind, PublishedTravelKind::kOnBoundary);
  for (const double weight : published->weights) EXPECT_NEAR(weight, 1.0 / 3.0, 1e-15);
  EXPECT_NEAR(published->c_travel, 1.0, 1e-15);
  ASSERT_EQ(Collide(p, q, x.pose).verdict, Verdict::kSeparate);
  const DirectionalResult truth = Ask(x, s);
  ASSERT_EQ(truth.kind, TravelKind::kInterval);
  EXPECT_EQ(truth.enter.travel.value, 1.0);
  EXPECT_EQ(truth.leave.travel.value, 2.0);
  EXPECT_FALSE(truth.grazing);
}

}  // namespace
}  // namespace touchstone::testing
