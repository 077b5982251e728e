// SPDX-License-Identifier: GPL-3.0-or-later
//
// The judge can fail: each planted fault is found, under its own name, and sound results pass.
#include "touchstone/exact/judge.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "touchstone/exact/convert.h"
#include "touchstone/exact/decide.h"
#include "touchstone/exact/exit_values.h"
#include "touchstone/exact/phase_maxima.h"
#include "touchstone/exact/support.h"
#include "touchstone/tests/exact/shapes.h"

namespace touchstone::exact {

void PrintTo(FindingKind kind, std::ostream* out) { *out << ToString(kind); }

namespace {

using testing::Contains;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

std::vector<FindingKind> Kinds(const std::vector<Finding>& findings) {
  std::vector<FindingKind> kinds;
  for (const Finding& finding : findings) kinds.push_back(finding.kind);
  return kinds;
}

class JudgeTest : public testing::Test {
 protected:
  JudgeTest()
      : random_(31),
        p_(EllipsoidHull(&random_, 20, {2, 1, 1})),
        q_(EllipsoidHull(&random_, 20, {1, 2, 1})),
        apart_(Pose(RoundedRotation(&random_), {2.5, 2.0, 0.5})),
        overlapping_(Pose(RoundedRotation(&random_), {0.5, 0.25, 0.5})) {}

  CollideResult Good(const RelativePose& pose) {
    CollideResult result = GoodResult(p_, q_, pose);
    AddPhaseMaxima(p_, q_, pose, &result);
    return result;
  }
  std::vector<FindingKind> Kinds(const RelativePose& pose, const CollideResult& result,
                                 const JudgeOptions& options = {}) {
    return exact::Kinds(Judge(p_, q_, pose, result, options));
  }

  Random random_;
  ExactBody p_, q_;
  RelativePose apart_, overlapping_;
};

TEST_F(JudgeTest, SoundResultsPass) {
  ASSERT_EQ(Good(apart_).verdict, Verdict::kSeparate);
  ASSERT_EQ(Good(overlapping_).verdict, Verdict::kOverlap);
  EXPECT_THAT(Kinds(apart_, Good(apart_)), IsEmpty());
  EXPECT_THAT(Kinds(overlapping_, Good(overlapping_)), IsEmpty());
}

TEST_F(JudgeTest, WrongVerdict) {
  CollideResult result = Good(apart_);
  result.verdict = Verdict::kOverlap;
  EXPECT_THAT(Kinds(apart_, result),
              UnorderedElementsAre(FindingKind::kBadCertificate, FindingKind::kWrongVerdict));
  result = Good(overlapping_);
  result.verdict = Verdict::kTouch;
  EXPECT_THAT(Kinds(overlapping_, result), Contains(FindingKind::kWrongVerdict));
}

TEST_F(JudgeTest, FlippedCertificates) {
  CollideResult result = Good(apart_);
  std::swap(result.certificate.points[0], result.certificate.points[1]);
  EXPECT_THAT(Kinds(apart_, result), UnorderedElementsAre(FindingKind::kBadCertificate));

  result = Good(apart_);
  result.certificate.kind = CertificateKind::kSeparatingDirection;
  const ExactDecision decision = Decide(p_, q_, apart_);
  const PlacedPair pair(p_.data(), q_.data(), apart_, 0, 0);
  const auto& t = decision.exit->triangle;
  const IntegerVector a = pair.FromC(t[0]);
  const Eigen::Vector3d n = ToDirection(Cross(pair.FromC(t[1]) - a, pair.FromC(t[2]) - a));
  result.certificate.direction = n;
  EXPECT_THAT(Kinds(apart_, result), IsEmpty());
  result.certificate.direction = -n;
  EXPECT_THAT(Kinds(apart_, result), UnorderedElementsAre(FindingKind::kBadCertificate));
  result.certificate.direction.setZero();
  EXPECT_THAT(Kinds(apart_, result), UnorderedElementsAre(FindingKind::kBadCertificate));
  result.certificate.direction.setConstant(std::numeric_limits<double>::infinity());
  EXPECT_THAT(Kinds(apart_, result), UnorderedElementsAre(FindingKind::kBadCertificate));

  result = Good(overlapping_);
  result.certificate.points[2] = result.certificate.points[1];
  EXPECT_THAT(Kinds(overlapping_, result), UnorderedElementsAre(FindingKind::kBadCertificate));
  result.certificate.kind = CertificateKind::kCoincidentInterior;
  EXPECT_THAT(Kinds(overlapping_, result), UnorderedElementsAre(FindingKind::kBadCertificate));
  result.certificate.points[2].p = 1000;
  result.certificate.kind = CertificateKind::kEnclosingTetrahedron;
  EXPECT_THAT(Kinds(overlapping_, result), Contains(FindingKind::kBadCertificate));
}

// The tetrahedron of c and the exit facet, of a separate pair: the ray leaves it before o.
TEST_F(JudgeTest, ATetrahedronThatEndsBeforeTheOrigin) {
  CollideResult result = Good(apart_);
  result.verdict = Verdict::kOverlap;
  result.certificate.kind = CertificateKind::kEnclosingTetrahedron;
  EXPECT_THAT(Kinds(apart_, result),
              UnorderedElementsAre(FindingKind::kBadCertificate, FindingKind::kWrongVerdict));
}

TEST_F(JudgeTest, InteriorPointsAreProvenAgain) {
  const ExactBody outside(p_.body(), {5, 5, 5}, {5, 5, 5});
  EXPECT_THAT(exact::Kinds(Judge(outside, q_, overlapping_, Good(overlapping_))),
              UnorderedElementsAre(FindingKind::kBadCertificate));
}

TEST_F(JudgeTest, AFaceNotOnM) {
  CollideResult result = Good(apart_);
  result.face->triangle[1] = {(result.face->triangle[1].p + 7) % 20, result.face->triangle[1].q};
  EXPECT_THAT(Kinds(apart_, result), Contains(FindingKind::kNotAFace));
  result = Good(apart_);
  std::swap(result.face->triangle[1], result.face->triangle[2]);
  EXPECT_THAT(Kinds(apart_, result), Contains(FindingKind::kNotAFace));
  result = Good(apart_);
  result.face->triangle[1] = result.face->triangle[2];
  EXPECT_THAT(Kinds(apart_, result), Contains(FindingKind::kNotAFace));
}

// The best face of a class that the exit is not of: a facet of M, with its true features.
TEST_F(JudgeTest, AnotherFacetThanTheExit) {
  CollideResult result = Good(apart_);
  const bool by_q = result.face->face_class == FaceClass::kFaceVertex;
  const PhaseReport report = result.phases[by_q ? 1 : 0];
  result.face->face_class = *report.face_class;
  result.face->feature_p = report.feature_p;
  result.face->feature_q = report.feature_q;
  for (int i = 0; i < 3; ++i) {
    // Reflection turns the loops of Q around.
    result.face->triangle[i] =
        by_q ? VertexPair{report.feature_p.index, q_.body().face(report.feature_q.index)[2 - i]}
             : VertexPair{p_.body().face(report.feature_p.index)[i], report.feature_q.index};
  }
  EXPECT_THAT(Kinds(apart_, result), Contains(FindingKind::kNotOptimal));
}

TEST_F(JudgeTest, WrongClass) {
  for (const RelativePose& pose : {apart_, overlapping_}) {
    for (const FaceClass wrong :
         {FaceClass::kFaceVertex, FaceClass::kVertexFace, FaceClass::kEdgeEdge,
          FaceClass::kFaceEdge, FaceClass::kEdgeFace, FaceClass::kFaceFace}) {
      CollideResult result = Good(pose);
      if (result.face->face_class == wrong) continue;
      result.face->face_class = wrong;
      EXPECT_THAT(Kinds(pose, result), UnorderedElementsAre(FindingKind::kWrongClass));
    }
    CollideResult result = Good(pose);
    result.face->feature_p.index = (result.face->feature_p.index + 1) % 10;
    EXPECT_THAT(Kinds(pose, result), UnorderedElementsAre(FindingKind::kWrongClass));
  }
}

TEST(JudgeClass, AFinerClaimStandsWhereItsPartHoldsTheExitPoint) {
  const ExactBody box(Box({-1, -1, -1}, {1, 1, 1}), {0, 0, 0}, {0, 0, 0.25});
  const RelativePose pose = Pose(Eigen::Matrix3d::Identity(), {4, 0.5, 0.25});
  CollideResult result = GoodResult(box, box, pose);
  ASSERT_EQ(result.face->face_class, FaceClass::kFaceFace);
  EXPECT_THAT(Judge(box, box, pose, result), IsEmpty());
  const Feature face_p = result.face->feature_p;
  int fine = 0;
  for (int v = 0; v < 8; ++v) {
    result.face->face_class = FaceClass::kFaceVertex;
    result.face->feature_p = face_p;
    result.face->feature_q = {FeatureKind::kVertex, v};
    const auto kinds = Kinds(Judge(box, box, pose, result));
    if (kinds.empty()) {
      ++fine;
    } else {
      EXPECT_THAT(kinds, UnorderedElementsAre(FindingKind::kWrongClass));
    }
  }
  // The exit point (-2, -y, -z) of the square of side 4 lies in the part of one corner of Q alone.
  EXPECT_EQ(fine, 1);
  int edge_pairs = 0;
  for (int e_p = 0; e_p < 12; ++e_p) {
    for (int e_q = 0; e_q < 12; ++e_q) {
      result.face->face_class = FaceClass::kEdgeEdge;
      result.face->feature_p = {FeatureKind::kEdge, e_p};
      result.face->feature_q = {FeatureKind::kEdge, e_q};
      if (Judge(box, box, pose, result).empty()) ++edge_pairs;
    }
  }
  EXPECT_EQ(edge_pairs, 2);  // one part for each way to cross the edges
}

TEST_F(JudgeTest, ValuesOffByMoreThanTheirClaim) {
  CollideResult result = Good(apart_);
  result.signed_distance->value += 3 * result.signed_distance->error;
  EXPECT_THAT(Kinds(apart_, result), UnorderedElementsAre(FindingKind::kValueOutOfBounds));
  result = Good(overlapping_);
  result.exit_travel->value -= 3 * result.exit_travel->error;
  EXPECT_THAT(Kinds(overlapping_, result), UnorderedElementsAre(FindingKind::kValueOutOfBounds));
  result = Good(apart_);
  result.exit_travel->error = 0;
  EXPECT_THAT(Kinds(apart_, result), UnorderedElementsAre(FindingKind::kValueOutOfBounds));
  result = Good(apart_);
  result.exit_point->x() += 1e-12;
  EXPECT_THAT(Kinds(apart_, result), UnorderedElementsAre(FindingKind::kValueOutOfBounds));
  result = Good(apart_);
  result.interior_difference.x() += 1e-12;
  EXPECT_THAT(Kinds(apart_, result), UnorderedElementsAre(FindingKind::kValueOutOfBounds));
  result = Good(apart_);
  result.signed_distance->value = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(Kinds(apart_, result), Contains(FindingKind::kValueOutOfBounds));
}

TEST_F(JudgeTest, LooseBounds) {
  CollideResult result = Good(apart_);
  result.signed_distance->error = 1e-6;
  EXPECT_THAT(Kinds(apart_, result), UnorderedElementsAre(FindingKind::kLooseBound));
  result = Good(apart_);
  result.exit_travel->condition *= 1e4;
  EXPECT_THAT(Kinds(apart_, result), UnorderedElementsAre(FindingKind::kLooseBound));
  result = Good(apart_);
  result.exit_point_error = 1e-3;
  EXPECT_THAT(Kinds(apart_, result), UnorderedElementsAre(FindingKind::kLooseBound));
  result = Good(apart_);
  result.exit_travel->error = std::numeric_limits<double>::infinity();
  EXPECT_THAT(Kinds(apart_, result), UnorderedElementsAre(FindingKind::kLooseBound));
}

// Another face of the class with its true features and distance: below the maximum, and a finding
// only where it is claimed to be the maximum.
TEST_F(JudgeTest, SubMaximalPhases) {
  const PlacedPair pair(p_.data(), q_.data(), apart_, 0, 0);
  const CollideResult good = Good(apart_);
  for (int phase = 0; phase < 3; ++phase) {
    SCOPED_TRACE(phase);
    CollideResult planted = good;
    PhaseReport& report = planted.phases[phase];
    IntegerVector n;
    if (phase == 0) {
      report.feature_p.index = (report.feature_p.index + 5) % p_.body().face_count();
      n = FaceVertexNormal(pair, report.feature_p.index);
      report.feature_q.index = SupportingPair(pair, n).q;
    } else if (phase == 1) {
      report.feature_q.index = (report.feature_q.index + 5) % q_.body().face_count();
      n = VertexFaceNormal(pair, report.feature_q.index);
      report.feature_p.index = SupportingPair(pair, n).p;
    } else {
      do {
        report.feature_q.index = (report.feature_q.index + 1) % q_.edge_count();
        if (report.feature_q.index == 0) ++report.feature_p.index;
      } while (!ArcsCross(pair, report.feature_p.index, report.feature_q.index));
      n = EdgeEdgeNormal(pair, report.feature_p.index, report.feature_q.index);
    }
    report.signed_distance = ValuesAt(pair, n, RatioOf(pair, n)).signed_distance.ToDouble();
    EXPECT_THAT(Kinds(apart_, planted), UnorderedElementsAre(FindingKind::kPhaseNotMaximal));
    report.claim = PhaseClaim::kLocal;
    EXPECT_THAT(Kinds(apart_, planted), IsEmpty());
    report.claim = PhaseClaim::kMaximum;
    report.signed_distance += 0.1;
    EXPECT_THAT(Kinds(apart_, planted), Contains(FindingKind::kValueOutOfBounds));
  }
}

TEST_F(JudgeTest, PhasesThatNameNoFaceOfM) {
  CollideResult planted = Good(apart_);
  planted.phases[0].feature_q.index = (planted.phases[0].feature_q.index + 1) % 20;
  EXPECT_THAT(Kinds(apart_, planted), UnorderedElementsAre(FindingKind::kPhaseNotMaximal));
  planted.phases[0].feature_q.index = -1;
  EXPECT_THAT(Kinds(apart_, planted), UnorderedElementsAre(FindingKind::kPhaseNotMaximal));
}

TEST_F(JudgeTest, BadCounters) {
  const TraceStep step{Phase::kOverlay, FaceClass::kEdgeEdge, {}, {}, 1.0, true};
  CollideResult result = Good(apart_);
  result.trace = {step};
  EXPECT_THAT(Kinds(apart_, result), UnorderedElementsAre(FindingKind::kBadCounters));
  result.counts[static_cast<int>(Phase::kOverlay)].faces_visited = 1;
  EXPECT_THAT(Kinds(apart_, result), IsEmpty());
  result.trace.push_back(step);
  result.counts[static_cast<int>(Phase::kOverlay)].faces_visited = 2;
  EXPECT_THAT(Kinds(apart_, result), UnorderedElementsAre(FindingKind::kBadCounters));
  result.trace[1].accepted = false;
  EXPECT_THAT(Kinds(apart_, result), IsEmpty());
  // Portal searches visit triangles: they count and leave no trace.
  result.counts[static_cast<int>(Phase::kPortal)].faces_visited = 7;
  EXPECT_THAT(Kinds(apart_, result), IsEmpty());
  result.trace.back().phase = Phase::kPortal;
  result.counts[static_cast<int>(Phase::kOverlay)].faces_visited = 1;
  EXPECT_THAT(Kinds(apart_, result), UnorderedElementsAre(FindingKind::kBadCounters));

  result = Good(apart_);
  result.counts[0].support_calls = -1;
  EXPECT_THAT(Kinds(apart_, result), UnorderedElementsAre(FindingKind::kBadCounters));
  result = Good(apart_);
  result.phase = Phase::kStart;
  EXPECT_THAT(Kinds(apart_, result), UnorderedElementsAre(FindingKind::kBadCounters));
  result = Good(apart_);
  result.tier = Tier::kNone;
  EXPECT_THAT(Kinds(apart_, result), UnorderedElementsAre(FindingKind::kBadCounters));
  result = Good(apart_);
  result.phases[0].face_class.reset();
  EXPECT_THAT(Kinds(apart_, result), Contains(FindingKind::kBadCounters));
}

TEST_F(JudgeTest, EarlyExits) {
  CollideResult result = Good(apart_);
  result.termination = Termination::kEarlyExit;
  result.face.reset();
  result.signed_distance.reset();
  result.exit_travel.reset();
  result.exit_point.reset();
  EXPECT_THAT(Kinds(apart_, result), UnorderedElementsAre(FindingKind::kUnentitledExit));
  EXPECT_THAT(Kinds(apart_, result, {.early_exit = true}), IsEmpty());
  result.certificate.kind = CertificateKind::kNone;
  EXPECT_THAT(Kinds(apart_, result, {.early_exit = true}),
              UnorderedElementsAre(FindingKind::kMissingPart, FindingKind::kUnentitledExit));
}

TEST_F(JudgeTest, MissingParts) {
  CollideResult result = Good(apart_);
  result.face.reset();
  EXPECT_THAT(Kinds(apart_, result), UnorderedElementsAre(FindingKind::kMissingPart));
  result = Good(apart_);
  result.certificate.kind = CertificateKind::kNone;
  EXPECT_THAT(Kinds(apart_, result), UnorderedElementsAre(FindingKind::kMissingPart));
}

TEST_F(JudgeTest, Undecided) {
  CollideResult result;
  result.interior_difference = Good(apart_).interior_difference;
  EXPECT_THAT(Kinds(apart_, result), UnorderedElementsAre(FindingKind::kUndecided));
  EXPECT_THAT(Kinds(apart_, result, {.certainty = Certainty::kFloat}),
              UnorderedElementsAre(FindingKind::kUndecided));
  const ExactBody box(Box({-1, -1, -1}, {1, 1, 1}));
  const RelativePose touching = Pose(Eigen::Matrix3d::Identity(), {2, 0.5, 0.25});
  result.interior_difference = GoodResult(box, box, touching).interior_difference;
  EXPECT_THAT(exact::Kinds(Judge(box, box, touching, result, {.certainty = Certainty::kFloat})),
              IsEmpty());
  EXPECT_THAT(exact::Kinds(Judge(box, box, touching, result)),
              UnorderedElementsAre(FindingKind::kUndecided));
}

// All four c and an edge of M in the plane x = y: no determinant in doubles tells the ray's side.
TEST(JudgeUndecided, StandsInDoublesWhereEveryRayMeetsAnEdgeOfAnOverlap) {
  const ConvexPolyhedron cube = Box({-1, -1, -1}, {1, 1, 1});
  const ExactBody body(cube, {0, 0, 0}, {0.25, 0.25, 0});
  const auto kinds = [&](const Eigen::Vector3d& translation, Certainty certainty) {
    CollideResult result;
    result.interior_difference = -translation;
    return exact::Kinds(Judge(body, body, Pose(Eigen::Matrix3d::Identity(), translation), result,
                              {.certainty = certainty}));
  };
  EXPECT_THAT(kinds({0.5, 0.5, 0}, Certainty::kFloat), IsEmpty());
  EXPECT_THAT(kinds({0.5, 0.5, 0}, Certainty::kExact),
              UnorderedElementsAre(FindingKind::kUndecided));
  // Next to the edge; a face; apart.
  for (const Eigen::Vector3d& translation :
       {Eigen::Vector3d(0.5, 0.5 + 0x1p-34, 0), {0.5, 0.25, 0}, {3, 3, 0}}) {
    EXPECT_THAT(kinds(translation, Certainty::kFloat),
                UnorderedElementsAre(FindingKind::kUndecided));
  }
}

TEST(JudgeCoincident, OnlyUnderEarlyExit) {
  const ExactBody box(Box({-1, -1, -1}, {1, 1, 1}));
  CollideResult result;
  result.verdict = Verdict::kOverlap;
  result.tier = Tier::kExact;
  result.phase = Phase::kStart;
  result.termination = Termination::kCoincident;
  result.certificate.kind = CertificateKind::kCoincidentInterior;
  EXPECT_THAT(Kinds(Judge(box, box, RelativePose(), result, {.early_exit = true})), IsEmpty());
  EXPECT_THAT(Kinds(Judge(box, box, RelativePose(), result)),
              UnorderedElementsAre(FindingKind::kMissingPart));
  EXPECT_THAT(Kinds(Judge(box, box, Pose(Eigen::Matrix3d::Identity(), {1e-9, 0, 0}), result,
                          {.early_exit = true})),
              Contains(FindingKind::kBadCertificate));
}

TEST(JudgeTouch, TheWitnessMustHoldTheOrigin) {
  const ExactBody box(Box({-1, -1, -1}, {1, 1, 1}));
  const RelativePose pose = Pose(Eigen::Matrix3d::Identity(), {2, 0.5, 0.25});
  CollideResult result = GoodResult(box, box, pose);
  ASSERT_EQ(result.verdict, Verdict::kTouch);
  EXPECT_THAT(Judge(box, box, pose, result), IsEmpty());
  CollideResult overlap = result;
  overlap.verdict = Verdict::kOverlap;
  EXPECT_THAT(Kinds(Judge(box, box, pose, overlap)), Contains(FindingKind::kWrongVerdict));
  CollideResult separate = result;
  separate.verdict = Verdict::kSeparate;
  separate.certificate.kind = CertificateKind::kSeparatingFacet;  // not strict
  EXPECT_THAT(Kinds(Judge(box, box, pose, separate)),
              UnorderedElementsAre(FindingKind::kBadCertificate, FindingKind::kWrongVerdict));
}

TEST(FindingKinds, HaveNames) {
  for (int i = 0; i < kFindingKindCount; ++i) EXPECT_NE(ToString(static_cast<FindingKind>(i)), "?");
}

}  // namespace
}  // namespace touchstone::exact
