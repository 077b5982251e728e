// SPDX-License-Identifier: GPL-3.0-or-later
//
// The judges of distance, depth and travel can fail: each planted fault is found, under its own
// name, and sound results pass. And the exact searches that they rest on agree with M built whole.
#include "touchstone/exact/judge_proximity.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "touchstone/core/proximity/directional_distance.h"
#include "touchstone/core/proximity/distance.h"
#include "touchstone/core/proximity/penetration_depth.h"
#include "touchstone/exact/convex_minkowski.h"
#include "touchstone/exact/nearest_facet.h"
#include "touchstone/exact/nearest_point.h"
#include "touchstone/tests/exact/shapes.h"

namespace touchstone::exact {

void PrintTo(FindingKind kind, std::ostream* out);

namespace {

using testing::Contains;
using testing::IsEmpty;
using testing::Not;
using testing::UnorderedElementsAre;

std::vector<FindingKind> Kinds(const std::vector<Finding>& findings) {
  std::vector<FindingKind> kinds;
  for (const Finding& finding : findings) kinds.push_back(finding.kind);
  return kinds;
}

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

class JudgeProximityTest : public testing::Test {
 protected:
  JudgeProximityTest()
      : random_(61),
        p_(EllipsoidHull(&random_, 20, {2, 1, 1})),
        q_(EllipsoidHull(&random_, 20, {1, 2, 1})),
        apart_(Pose(RoundedRotation(&random_), {2.5, 2.0, 0.5})),
        overlapping_(Pose(RoundedRotation(&random_), {0.5, 0.25, 0.5})) {}

  DistanceResult Apart() const { return Distance(p_.body(), q_.body(), apart_); }
  std::vector<FindingKind> Judged(const DistanceResult& result) const {
    return Kinds(JudgeDistance(p_, q_, apart_, result, {.construct = true}));
  }
  PenetrationResult Deep() const {
    return PenetrationDepth(p_.body(), q_.body(), overlapping_,
                            {.certainty = Certainty::kExact, .certificate = true});
  }
  std::vector<FindingKind> Judged(const PenetrationResult& result) const {
    return Kinds(JudgePenetration(p_, q_, overlapping_, result, {.construct = true}));
  }

  DirectionalResult Along(const Eigen::Vector3d& s) const {
    return *DirectionalDistance(p_.body(), q_.body(), apart_, s);
  }
  std::vector<FindingKind> Judged(const Eigen::Vector3d& s, const DirectionalResult& result) const {
    return Kinds(JudgeDirection(p_, q_, apart_, s, result, {.construct = true}));
  }

  Random random_;
  ExactBody p_, q_;
  RelativePose apart_, overlapping_;
  const Eigen::Vector3d toward_{-2.0, -2.0, -0.5}, past_{0.0, 0.0, 3.0};
};

TEST_F(JudgeProximityTest, SoundResultsPass) {
  ASSERT_EQ(Apart().kind, DistanceKind::kSeparate);
  EXPECT_THAT(Judged(Apart()), IsEmpty());
  ASSERT_EQ(Deep().verdict, Verdict::kOverlap);
  EXPECT_THAT(Judged(Deep()), IsEmpty());
  // Each as the answer to the other's question.
  EXPECT_THAT(
      Kinds(JudgeDistance(p_, q_, overlapping_, Distance(p_.body(), q_.body(), overlapping_))),
      IsEmpty());
  EXPECT_THAT(
      Kinds(JudgePenetration(p_, q_, apart_, PenetrationDepth(p_.body(), q_.body(), apart_))),
      IsEmpty());
}

TEST_F(JudgeProximityTest, DistanceOfTheWrongKind) {
  DistanceResult result = Apart();
  result.kind = DistanceKind::kMeet;
  EXPECT_THAT(Judged(result), UnorderedElementsAre(FindingKind::kWrongVerdict));
  result.kind = DistanceKind::kUndecided;
  EXPECT_THAT(Judged(result), UnorderedElementsAre(FindingKind::kUndecided));
  EXPECT_THAT(Kinds(JudgeDistance(p_, q_, apart_, result, {.certainty = Certainty::kFloat})),
              UnorderedElementsAre(FindingKind::kUndecided))
      << "far from contact doubles are no excuse";
  EXPECT_THAT(Kinds(JudgeDistance(p_, q_, overlapping_, Apart())),
              UnorderedElementsAre(FindingKind::kWrongVerdict));
}

TEST_F(JudgeProximityTest, DistanceOutOfItsBounds) {
  DistanceResult result = Apart();
  result.distance.value += 4.0 * result.distance.error;
  EXPECT_THAT(Judged(result), Contains(FindingKind::kValueOutOfBounds));
  result = Apart();
  result.distance.value = kNan;
  EXPECT_THAT(Judged(result), Contains(FindingKind::kValueOutOfBounds));
  result = Apart();
  result.distance.error = 1e-9;
  EXPECT_THAT(Judged(result), UnorderedElementsAre(FindingKind::kLooseBound));
  result = Apart();
  result.distance.condition = 1e9;
  EXPECT_THAT(Judged(result), UnorderedElementsAre(FindingKind::kLooseBound));
  result = Apart();
  result.lower = result.distance.value * (1.0 + 1e-13);
  EXPECT_THAT(Judged(result), Contains(FindingKind::kValueOutOfBounds));
  result = Apart();
  result.upper = result.distance.value * (1.0 - 1e-13);
  EXPECT_THAT(Judged(result), UnorderedElementsAre(FindingKind::kValueOutOfBounds));
  result = Apart();
  result.lower = 0.0;
  EXPECT_THAT(Judged(result), UnorderedElementsAre(FindingKind::kLooseBound));
}

TEST_F(JudgeProximityTest, ClosestPointsThatAreNot) {
  DistanceResult result = Apart();
  result.point_on_p[1] += 1e-9;
  EXPECT_THAT(Judged(result), UnorderedElementsAre(FindingKind::kValueOutOfBounds));
  result = Apart();
  std::swap(result.point_on_p, result.point_on_q);
  EXPECT_THAT(Judged(result), Contains(FindingKind::kValueOutOfBounds));
  result = Apart();
  result.point_error = 1e-6;
  EXPECT_THAT(Judged(result), Contains(FindingKind::kLooseBound));
  // Another vertex of P in the simplex: the points no longer are what it names.
  result = Apart();
  result.simplex[0].p = (result.simplex[0].p + 5) % 20;
  EXPECT_THAT(Judged(result), Contains(FindingKind::kNotOptimal));
  result = Apart();
  result.simplex[0].p = 1000;
  EXPECT_THAT(Judged(result), UnorderedElementsAre(FindingKind::kNotOptimal));
  result = Apart();
  result.simplex_size = 0;
  EXPECT_THAT(Judged(result), UnorderedElementsAre(FindingKind::kMissingPart));
  // Unproven, and then it owes points of the bodies all the same.
  result = Apart();
  result.optimal = false;
  EXPECT_THAT(Judged(result), UnorderedElementsAre(FindingKind::kNotOptimal));
  result.point_on_p += Eigen::Vector3d(10, 0, 0);
  EXPECT_THAT(Judged(result), Contains(FindingKind::kValueOutOfBounds));
}

TEST_F(JudgeProximityTest, DirectionsAndFeaturesThatAreNot) {
  DistanceResult result = Apart();
  result.direction = -result.direction;
  EXPECT_THAT(Judged(result), UnorderedElementsAre(FindingKind::kValueOutOfBounds));
  result = Apart();
  result.direction *= 1.0 + 1e-9;
  EXPECT_THAT(Judged(result), UnorderedElementsAre(FindingKind::kBadCertificate));
  result = Apart();
  result.feature_p.reset();
  EXPECT_THAT(Judged(result), UnorderedElementsAre(FindingKind::kMissingPart));
  result = Apart();
  result.feature_q->index = (result.feature_q->index + 1) % 20;
  EXPECT_THAT(Judged(result), UnorderedElementsAre(FindingKind::kWrongClass));
  result = Apart();
  result.feature_q = Feature{FeatureKind::kFace, 100000};
  EXPECT_THAT(Judged(result), UnorderedElementsAre(FindingKind::kWrongClass));
  result = Apart();
  result.feature_p->kind =
      result.feature_p->kind == FeatureKind::kVertex ? FeatureKind::kEdge : FeatureKind::kVertex;
  EXPECT_THAT(Judged(result), UnorderedElementsAre(FindingKind::kWrongClass));
}

TEST_F(JudgeProximityTest, MeetingOwesAProof) {
  DistanceResult result = Distance(p_.body(), q_.body(), overlapping_);
  ASSERT_EQ(result.kind, DistanceKind::kMeet);
  result.certificate = {};
  EXPECT_THAT(Kinds(JudgeDistance(p_, q_, overlapping_, result)),
              UnorderedElementsAre(FindingKind::kMissingPart));
  result = Distance(p_.body(), q_.body(), overlapping_);
  std::swap(result.certificate.points[0], result.certificate.points[1]);
  result.interior_p = 2;
  EXPECT_THAT(Kinds(JudgeDistance(p_, q_, overlapping_, result)),
              UnorderedElementsAre(FindingKind::kBadCertificate));
  result = Distance(p_.body(), q_.body(), overlapping_);
  result.distance.value = 1e-300;
  EXPECT_THAT(Kinds(JudgeDistance(p_, q_, overlapping_, result)),
              UnorderedElementsAre(FindingKind::kValueOutOfBounds));
}

TEST_F(JudgeProximityTest, DepthOfTheWrongVerdict) {
  PenetrationResult result = Deep();
  result.verdict = Verdict::kTouch;
  EXPECT_THAT(Judged(result), UnorderedElementsAre(FindingKind::kWrongVerdict));
  result.verdict = Verdict::kUndecided;
  EXPECT_THAT(Judged(result), UnorderedElementsAre(FindingKind::kUndecided));
  EXPECT_THAT(
      Kinds(JudgePenetration(p_, q_, overlapping_, result, {.certainty = Certainty::kFloat})),
      UnorderedElementsAre(FindingKind::kUndecided));
  PenetrationResult apart = PenetrationDepth(p_.body(), q_.body(), apart_);
  apart.certificate = {};
  EXPECT_THAT(Kinds(JudgePenetration(p_, q_, apart_, apart)),
              UnorderedElementsAre(FindingKind::kMissingPart));
  apart = PenetrationDepth(p_.body(), q_.body(), apart_);
  apart.translation[0] = 1e-300;
  EXPECT_THAT(Kinds(JudgePenetration(p_, q_, apart_, apart)),
              UnorderedElementsAre(FindingKind::kValueOutOfBounds));
}

// A facet of M, all its numbers right, but another is nearer: found by looking at all.
TEST_F(JudgeProximityTest, AFacetThatIsNotTheNearest) {
  const PenetrationResult nearest = Deep();
  // The facet that o is nearest to when the bodies have moved on.
  int others = 0;
  for (int i = 0; i < 20; ++i) {
    const RelativePose moved =
        Pose(overlapping_.rotation(), {random_.Real(-0.5, 0.5), random_.Real(-0.5, 0.5), 0.3});
    const PenetrationResult other = PenetrationDepth(p_.body(), q_.body(), moved);
    if (other.verdict != Verdict::kOverlap ||
        (other.facet->feature_p == nearest.facet->feature_p &&
         other.facet->feature_q == nearest.facet->feature_q)) {
      continue;
    }
    PenetrationResult result = nearest;
    result.facet = other.facet;
    EXPECT_THAT(Judged(result), Contains(FindingKind::kNotOptimal));
    EXPECT_THAT(Judged(result), Not(Contains(FindingKind::kWrongClass)));
    ++others;
  }
  EXPECT_GT(others, 5);
}

TEST_F(JudgeProximityTest, AFacetThatIsNone) {
  PenetrationResult result = Deep();
  result.facet->triangle[1].p = (result.facet->triangle[1].p + 7) % 20;
  EXPECT_THAT(Judged(result), Contains(FindingKind::kNotAFace));
  result = Deep();
  std::swap(result.facet->triangle[0], result.facet->triangle[1]);
  EXPECT_THAT(Judged(result), Contains(FindingKind::kNotAFace));
  result = Deep();
  result.facet->triangle[0].q = -1;
  EXPECT_THAT(Judged(result), Contains(FindingKind::kNotAFace));
  result = Deep();
  result.facet->face_class = result.facet->face_class == FaceClass::kEdgeEdge
                                 ? FaceClass::kFaceVertex
                                 : FaceClass::kEdgeEdge;
  EXPECT_THAT(Judged(result), UnorderedElementsAre(FindingKind::kWrongClass));
  result = Deep();
  result.facet.reset();
  EXPECT_THAT(Judged(result), UnorderedElementsAre(FindingKind::kMissingPart));
  result = Deep();
  result.minimal = false;
  EXPECT_THAT(Judged(result), Contains(FindingKind::kMissingPart));
}

TEST_F(JudgeProximityTest, DepthOutOfItsBounds) {
  PenetrationResult result = Deep();
  result.depth.value -= 4.0 * result.depth.error;
  EXPECT_THAT(Judged(result), UnorderedElementsAre(FindingKind::kValueOutOfBounds));
  result = Deep();
  result.depth.error = 1e-9;
  EXPECT_THAT(Judged(result), UnorderedElementsAre(FindingKind::kLooseBound));
  result = Deep();
  result.lower = result.depth.value * (1.0 + 1e-13);
  EXPECT_THAT(Judged(result), Contains(FindingKind::kValueOutOfBounds));
  result = Deep();
  result.lower = 0.5 * result.depth.value;
  EXPECT_THAT(Judged(result), UnorderedElementsAre(FindingKind::kLooseBound));
  result = Deep();
  result.upper = result.depth.value * (1.0 - 1e-13);
  EXPECT_THAT(Judged(result), Contains(FindingKind::kValueOutOfBounds));
  result = Deep();
  result.translation = -result.translation;
  EXPECT_THAT(Judged(result), UnorderedElementsAre(FindingKind::kValueOutOfBounds));
  result = Deep();
  result.foot_error = kNan;
  EXPECT_THAT(Judged(result), UnorderedElementsAre(FindingKind::kValueOutOfBounds));
  result = Deep();
  result.point_on_q[2] += 1e-9;
  EXPECT_THAT(Judged(result), UnorderedElementsAre(FindingKind::kValueOutOfBounds));
  result = Deep();
  result.direction = -result.direction;
  EXPECT_THAT(Judged(result), UnorderedElementsAre(FindingKind::kValueOutOfBounds));
}

TEST_F(JudgeProximityTest, InnerPolytopesThatProveNothing) {
  PenetrationResult result = Deep();
  ASSERT_GE(result.inner_polytope.size(), 4u);
  result.inner_polytope.pop_back();
  EXPECT_THAT(Judged(result), UnorderedElementsAre(FindingKind::kBadCertificate)) << "a hole";
  result = Deep();
  for (auto& triangle : result.inner_polytope) std::swap(triangle[0], triangle[1]);
  EXPECT_THAT(Judged(result), UnorderedElementsAre(FindingKind::kBadCertificate)) << "inside out";
  // One corner elsewhere: closed as before, and through the ball or around nothing.
  result = Deep();
  const VertexPair moved = result.inner_polytope[0][0];
  const VertexPair to{(moved.p + 9) % 20, (moved.q + 11) % 20};
  for (auto& triangle : result.inner_polytope) {
    for (VertexPair& corner : triangle) {
      if (corner == moved) corner = to;
    }
  }
  EXPECT_THAT(Judged(result), UnorderedElementsAre(FindingKind::kBadCertificate));
  result = Deep();
  result.inner_polytope[0][0] = {-1, 3};
  EXPECT_THAT(Judged(result), UnorderedElementsAre(FindingKind::kBadCertificate));
}

TEST_F(JudgeProximityTest, SoundTravelsPass) {
  ASSERT_EQ(Along(toward_).kind, TravelKind::kInterval);
  EXPECT_THAT(Judged(toward_, Along(toward_)), IsEmpty());
  ASSERT_EQ(Along(past_).kind, TravelKind::kNever);
  EXPECT_THAT(Judged(past_, Along(past_)), IsEmpty());
  EXPECT_THAT(Judged(1e-90 * toward_, Along(1e-90 * toward_)), IsEmpty());
}

TEST_F(JudgeProximityTest, TravelsOfTheWrongKind) {
  // Never, where they meet: no separator can show it.
  DirectionalResult result = Along(toward_);
  result.kind = TravelKind::kNever;
  result.separator = {result.enter.facet->triangle[0], result.enter.facet->triangle[1]};
  EXPECT_THAT(Judged(toward_, result),
              UnorderedElementsAre(FindingKind::kBadCertificate, FindingKind::kWrongVerdict));
  // An interval, where they do not.
  result = Along(toward_);
  EXPECT_THAT(Judged(past_, result), Contains(FindingKind::kWrongVerdict));
  result.kind = TravelKind::kUndecided;
  EXPECT_THAT(Judged(toward_, result), UnorderedElementsAre(FindingKind::kUndecided));
  result = Along(toward_);
  result.grazing = true;
  EXPECT_THAT(Judged(toward_, result), UnorderedElementsAre(FindingKind::kWrongVerdict));
}

TEST_F(JudgeProximityTest, SeparatorsThatAreNot) {
  DirectionalResult result = Along(past_);
  std::swap(result.separator[0], result.separator[1]);
  EXPECT_THAT(Judged(past_, result), UnorderedElementsAre(FindingKind::kBadCertificate));
  result = Along(past_);
  result.separator[1] = result.separator[0];
  EXPECT_THAT(Judged(past_, result), UnorderedElementsAre(FindingKind::kBadCertificate));
  result = Along(past_);
  result.separator[0].p = (result.separator[0].p + 7) % 20;
  EXPECT_THAT(Judged(past_, result), UnorderedElementsAre(FindingKind::kBadCertificate));
  result.separator[0].q = 20;
  EXPECT_THAT(Judged(past_, result), UnorderedElementsAre(FindingKind::kBadCertificate));
}

TEST_F(JudgeProximityTest, TravelsOutOfTheirBounds) {
  DirectionalResult result = Along(toward_);
  result.enter.travel.value += 4.0 * result.enter.travel.error;
  EXPECT_THAT(Judged(toward_, result), UnorderedElementsAre(FindingKind::kValueOutOfBounds));
  result = Along(toward_);
  result.leave.travel.error = 1e-9;
  EXPECT_THAT(Judged(toward_, result), UnorderedElementsAre(FindingKind::kLooseBound));
  result = Along(toward_);
  result.leave.travel.condition = 1e9;
  EXPECT_THAT(Judged(toward_, result), UnorderedElementsAre(FindingKind::kLooseBound));
  result = Along(toward_);
  result.leave.travel.value = result.enter.travel.value * 0.5;
  EXPECT_THAT(Judged(toward_, result), Contains(FindingKind::kValueOutOfBounds));
  result = Along(toward_);
  result.enter.travel.value = kNan;
  EXPECT_THAT(Judged(toward_, result), Contains(FindingKind::kValueOutOfBounds));
}

TEST_F(JudgeProximityTest, EndsThatAreNot) {
  DirectionalResult result = Along(toward_);
  std::swap(result.enter.facet, result.leave.facet);
  EXPECT_THAT(Judged(toward_, result),
              UnorderedElementsAre(FindingKind::kNotAFace, FindingKind::kNotAFace));
  result = Along(toward_);
  result.enter.facet.reset();
  EXPECT_THAT(Judged(toward_, result), UnorderedElementsAre(FindingKind::kMissingPart));
  result = Along(toward_);
  result.leave.facet->triangle[0].p = (result.leave.facet->triangle[0].p + 5) % 20;
  EXPECT_THAT(Judged(toward_, result), Contains(FindingKind::kNotAFace));
  // Other lines' facets: of M, but this line misses them.
  int others = 0;
  for (int i = 0; i < 100; ++i) {
    const DirectionalResult other = Along(toward_ + 2.0 * random_.OnSphere());
    result = Along(toward_);
    if (other.kind != TravelKind::kInterval ||
        (other.enter.facet->feature_p == result.enter.facet->feature_p &&
         other.enter.facet->feature_q == result.enter.facet->feature_q)) {
      continue;
    }
    result.enter.facet = other.enter.facet;
    EXPECT_THAT(Judged(toward_, result), Contains(FindingKind::kNotAFace));
    ++others;
  }
  EXPECT_GT(others, 10);
  result = Along(toward_);
  result.enter.facet->feature_p.index = (result.enter.facet->feature_p.index + 3) % 20;
  EXPECT_THAT(Judged(toward_, result), Contains(FindingKind::kWrongClass));
}

TEST_F(JudgeProximityTest, PublishedTravelsAreHeldToTheTruth) {
  const DirectionalResult truth = Along(toward_);
  PublishedTravel published =
      *DirectionalDistanceAsPublished(p_.body(), q_.body(), apart_, toward_);
  ASSERT_EQ(published.kind, PublishedTravelKind::kTravel);
  EXPECT_THAT(Kinds(JudgePublishedTravel(published, truth)), IsEmpty());
  published.travel *= 1.001;
  EXPECT_THAT(Kinds(JudgePublishedTravel(published, truth)),
              UnorderedElementsAre(FindingKind::kNotOptimal));
  published.kind = PublishedTravelKind::kOnBoundary;
  EXPECT_THAT(Kinds(JudgePublishedTravel(published, truth)),
              UnorderedElementsAre(FindingKind::kMissingPart));
  published.kind = PublishedTravelKind::kNever;
  EXPECT_THAT(Kinds(JudgePublishedTravel(published, truth)),
              UnorderedElementsAre(FindingKind::kWrongVerdict));
}

// The judge's own searches against M built whole: small bodies, many ties.
TEST(NearestTiers, SearchesAgreeWithMBuiltWhole) {
  Random random(62);
  int separate = 0, overlap = 0;
  for (int i = 0; i < 120; ++i) {
    const ExactBody p(i % 3 == 0 ? Box({-1, -1, -1}, {1, 1, 1}) : GridHull(&random, 9, 3, true));
    const ExactBody q(i % 3 == 1 ? Box({0, 0, 0}, {1, 2, 1}) : GridHull(&random, 9, 3, false));
    const Eigen::Matrix3d rotation = i % 2 == 0 ? CubeRotation(&random) : RoundedRotation(&random);
    const int reach = i % 4 < 2 ? 2 : 7;
    const RelativePose pose = Pose(
        rotation, {double(random.Integer(-reach, reach)), double(random.Integer(-reach, reach)),
                   double(random.Integer(-reach, reach))});
    const PlacedPair pair(p.data(), q.data(), pose, 0, 0);
    const MinkowskiDifference m = ConvexMinkowski(pair);
    const std::optional<ExactPoint> nearest = FindNearest(pair);
    const std::optional<SupportingPlane> facet = NearestFacet(pair);
    bool inside = true, strictly = true;
    std::optional<SupportingPlane> lowest;
    for (const MinkowskiFacet& f : m.facets) {
      const SupportingPlane plane{f.plane.normal, f.plane.offset};
      inside = inside && sgn(plane.height) >= 0;
      strictly = strictly && sgn(plane.height) > 0;
      if (!lowest.has_value() || (strictly && CompareDistances(plane, *lowest) < 0)) lowest = plane;
    }
    EXPECT_EQ(nearest.has_value(), !inside) << i;
    EXPECT_EQ(facet.has_value(), strictly) << i;
    if (strictly) {
      EXPECT_EQ(CompareDistances(*facet, *lowest), 0) << i;
      ++overlap;
    }
    if (!nearest.has_value()) continue;
    ++separate;
    // x is in M, for it is a sum of vertices with weights; and every vertex of M is beyond its
    // plane.
    EXPECT_TRUE(IsNearest(pair, *nearest));
    for (const IntegerVector& v : m.vertices) {
      EXPECT_GE(cmp(Dot(nearest->numerator, v) * nearest->denominator,
                    Dot(nearest->numerator, nearest->numerator)),
                0);
    }
  }
  EXPECT_GT(separate, 20);
  EXPECT_GT(overlap, 20);
}

// Ties, touches and containments, each judged whole.
TEST(JudgedProximity, GridsAndBoxesHaveNoFindings) {
  Random random(63);
  int kinds[3] = {};
  for (int i = 0; i < 450; ++i) {
    const ExactBody p(i % 3 == 0 ? Box({-1, -1, -1}, {1, 1, 1}) : GridHull(&random, 10, 3, true));
    const ExactBody q(i % 3 == 1 ? Box({0, 0, 0}, {1, 2, 1}) : GridHull(&random, 10, 3, false));
    const Eigen::Matrix3d rotation = i % 5 != 0 ? CubeRotation(&random) : RoundedRotation(&random);
    const RelativePose pose =
        Pose(rotation, {double(random.Integer(-5, 5)), double(random.Integer(-5, 5)),
                        double(random.Integer(-5, 5))});
    const ProximityJudgeOptions how{.construct = i % 8 == 0};
    const auto distance = JudgeDistance(p, q, pose, Distance(p.body(), q.body(), pose), how);
    EXPECT_THAT(Kinds(distance), IsEmpty()) << i << ": " << distance[0].detail;
    const PenetrationResult depth = PenetrationDepth(
        p.body(), q.body(), pose, {.certainty = Certainty::kExact, .certificate = true});
    const auto findings = JudgePenetration(p, q, pose, depth, how);
    EXPECT_THAT(Kinds(findings), IsEmpty()) << i << ": " << findings[0].detail;
    ++kinds[static_cast<int>(depth.verdict)];
    Eigen::Vector3d s(random.Integer(-2, 2), random.Integer(-2, 2), random.Integer(-2, 2));
    if (s.isZero(0)) s = random.OnSphere();
    const auto travels =
        JudgeDirection(p, q, pose, s, *DirectionalDistance(p.body(), q.body(), pose, s), how);
    EXPECT_THAT(Kinds(travels), IsEmpty()) << i << ": " << travels[0].detail;
  }
  for (const int count : kinds) EXPECT_GT(count, 20);
}

}  // namespace
}  // namespace touchstone::exact
