// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <thread>
#include <utility>
#include <vector>

#include "touchstone/core/cd_dual/cd_dual.h"
#include "touchstone/tests/cd_dual/brute_force.h"
#include "touchstone/tests/cd_dual/placements.h"
#include "touchstone/tests/testing/shapes.h"

namespace touchstone::testing {
namespace {

constexpr Search kProven[] = {Search::kPhased, Search::kPortal};

CollideOptions Ask(Search search, Certainty certainty = Certainty::kExact,
                   bool early_exit = false) {
  CollideOptions options;
  options.search = search;
  options.certainty = certainty;
  options.early_exit = early_exit;
  return options;
}

// |claimed - exact| <= error, with exact = (num / den): compared in exact arithmetic, for values
// that are rational. d and g carry a factor |c|, so their squares are compared through s instead:
// the test uses the doubles of the exact parameter, good to 2 ulp, and allows for that.
void ExpectValues(const CollideResult& result, const Fraction& s) {
  ASSERT_TRUE(result.exit_travel && result.signed_distance && result.exit_point);
  const double length = result.interior_difference.norm();
  // 1 - s and (1 - s) / s to full relative accuracy, by exact subtraction first.
  const double one_minus_s = RatioToDouble(s.denominator - s.numerator, s.denominator);
  const double d = RatioToDouble(s.denominator - s.numerator, s.numerator) / length;
  const double g = one_minus_s * length;
  // interior_difference is c rounded: a few ulp of the size of the bodies, relative to |c|.
  const double slack_g = 1e-14 * std::abs(g) + 1e-12 * std::abs(g) / std::min(1.0, length);
  const double slack_d = 1e-14 * std::abs(d) + 1e-12 * std::abs(d) / std::min(1.0, length);
  EXPECT_LE(std::abs(result.exit_travel->value - g), result.exit_travel->error + slack_g);
  EXPECT_LE(std::abs(result.signed_distance->value - d), result.signed_distance->error + slack_d);
  if (result.exit_travel->value != 0.0) {
    EXPECT_LE(result.exit_travel->error,
              1e-12 * result.exit_travel->condition * std::abs(result.exit_travel->value));
  }
  const Eigen::Vector3d exit =
      (1.0 - RatioToDouble(s.numerator, s.denominator)) * result.interior_difference;
  EXPECT_LE((*result.exit_point - exit).norm(), result.exit_point_error + 1e-11);
}

TEST(Collide, AgreesWithBruteForceOverAllFacesOfM) {
  std::map<std::pair<Verdict, FaceClass>, int> met;
  for (const Placement& x : SmallPlacements(/*seed=*/1, 1200)) {
    for (const Search search : kProven) {
      const CollideResult result = Collide(x.p, x.q, x.pose, Ask(search));
      const BruteForceExit truth =
          FindExitByBruteForce(x.p, x.q, x.pose, result.interior_p, result.interior_q);
      ASSERT_EQ(result.verdict, truth.verdict) << x.name << ", " << ToString(search);
      ASSERT_TRUE(result.face) << x.name;
      EXPECT_EQ(result.termination, Termination::kOptimal);
      ExpectValues(result, truth.parameter);
      ++met[{result.verdict, result.face->face_class}];
    }
  }
  for (const Verdict verdict : {Verdict::kSeparate, Verdict::kTouch, Verdict::kOverlap}) {
    for (const FaceClass c : {FaceClass::kFaceVertex, FaceClass::kVertexFace, FaceClass::kEdgeEdge,
                              FaceClass::kFaceEdge, FaceClass::kEdgeFace, FaceClass::kFaceFace}) {
      // A touch that no parallel features share takes luck.
      if (verdict == Verdict::kTouch && c <= FaceClass::kEdgeEdge) continue;
      EXPECT_GT((met[{verdict, c}]), 0) << ToString(verdict) << " by " << ToString(c);
    }
  }
}

TEST(Collide, FloatIsNeverWrongAndUndecidedOnlyAtContact) {
  int undecided = 0, touches = 0;
  for (const Placement& x : SmallPlacements(/*seed=*/2, 1200)) {
    for (const Search search : kProven) {
      for (const bool early_exit : {false, true}) {
        const CollideResult result =
            Collide(x.p, x.q, x.pose, Ask(search, Certainty::kFloat, early_exit));
        const Verdict truth = Collide(x.p, x.q, x.pose, Ask(search)).verdict;
        if (result.verdict == Verdict::kUndecided) {
          ++undecided;
          EXPECT_EQ(truth, Verdict::kTouch) << x.name << ", " << ToString(search);
        } else {
          EXPECT_EQ(result.verdict, truth) << x.name << ", " << ToString(search);
          EXPECT_NE(result.tier, Tier::kExact);
        }
        EXPECT_EQ(result.exact_signs, 0);
        touches += truth == Verdict::kTouch;
      }
    }
  }
  EXPECT_GT(touches, 0);
  EXPECT_EQ(undecided, touches) << "doubles cannot prove a touch";
}

TEST(Collide, EarlyExitChangesNoVerdict) {
  int early = 0;
  for (const Placement& x : SmallPlacements(/*seed=*/3, 1200)) {
    const Verdict truth = Collide(x.p, x.q, x.pose).verdict;
    for (const Search search : kProven) {
      const CollideResult result = Collide(x.p, x.q, x.pose, Ask(search, Certainty::kExact, true));
      EXPECT_EQ(result.verdict, truth) << x.name << ", " << ToString(search);
      EXPECT_NE(result.certificate.kind, CertificateKind::kNone);
      early += result.termination == Termination::kEarlyExit;
    }
  }
  EXPECT_GT(early, 1200);
}

TEST(Collide, SwappingTheBodiesChangesNoVerdict) {
  for (const Placement& x : SmallPlacements(/*seed=*/4, 600)) {
    if (!(x.pose.rotation() * x.pose.rotation().transpose()).isIdentity(0.0)) continue;
    // Only for rotations whose inverse is exact: then the swapped placement is the same truth.
    const Eigen::Matrix3d inverse = x.pose.rotation().transpose();
    const Eigen::Vector3d back = -(inverse * x.pose.translation());
    if ((x.pose.rotation() * back + x.pose.translation()).norm() != 0.0) continue;
    for (const Search search : kProven) {
      EXPECT_EQ(Collide(x.p, x.q, x.pose, Ask(search)).verdict,
                Collide(x.q, x.p, MustPose(inverse, back), Ask(search)).verdict)
          << x.name;
    }
  }
}

TEST(Collide, MovingBothBodiesChangesNoVerdict) {
  Random random(5);
  for (const Placement& x : SmallPlacements(/*seed=*/5, 600)) {
    WorldPose world_p, world_q;
    world_p.rotation = AxisRotation(&random);
    world_p.translation = Eigen::Vector3d(3, -7, 11);
    world_q.rotation = world_p.rotation * x.pose.rotation();
    world_q.translation = world_p.rotation * x.pose.translation() + world_p.translation;
    // The sum is exact for lattice translations only.
    if (x.name != "boxes on a lattice" && x.name != "lattice tetrahedra") continue;
    const auto moved = RelativePose::FromWorld(world_p, world_q);
    ASSERT_TRUE(moved.ok());
    for (const Search search : kProven) {
      EXPECT_EQ(Collide(x.p, x.q, x.pose, Ask(search)).verdict,
                Collide(x.p, x.q, *moved, Ask(search)).verdict)
          << x.name;
    }
  }
}

TEST(Collide, ScalingByPowersOfTwoScalesEverything) {
  const auto base = [](const Mesh& mesh) { return MustBuild(mesh); };
  const Mesh mesh_p = RoundBody(40, {2, 1, 1}, 7), mesh_q = RoundBody(40, {1, 1, 3}, 8);
  Random random(6);
  for (int i = 0; i < 60; ++i) {
    const Eigen::Matrix3d rotation = random.Rotation();
    const Eigen::Vector3d translation = 4.0 * random.Unit() * random.Direction();
    for (const Search search : kProven) {
      const CollideResult one =
          Collide(base(mesh_p), base(mesh_q), MustPose(rotation, translation), Ask(search));
      for (const int exponent : {-330, -40, 40, 330}) {
        const double factor = std::ldexp(1.0, exponent);
        const CollideResult scaled =
            Collide(base(Placed(mesh_p, factor)), base(Placed(mesh_q, factor)),
                    MustPose(rotation, factor * translation), Ask(search));
        ASSERT_EQ(scaled.verdict, one.verdict);
        ASSERT_EQ(scaled.face->triangle, one.face->triangle);
        EXPECT_EQ(scaled.exit_travel->value, factor * one.exit_travel->value);
        EXPECT_EQ(scaled.signed_distance->value * factor, one.signed_distance->value);
      }
    }
  }
}

TEST(Collide, BodiesOfVeryDifferentScales) {
  const ConvexPolyhedron huge = MustBuild(Placed(Box({1, 1, 1}), 1e100));
  const ConvexPolyhedron tiny = MustBuild(Placed(RoundBody(20, {1, 1, 1}, 3), 4e-100));
  for (const Search search : kProven) {
    EXPECT_EQ(Collide(huge, tiny, RelativePose(), Ask(search)).verdict, Verdict::kOverlap);
    EXPECT_EQ(Collide(tiny, huge, RelativePose(), Ask(search)).verdict, Verdict::kOverlap);
    // The tiny body's middle on the face of the huge one.
    const RelativePose on_face = MustPose(Eigen::Matrix3d::Identity(), {1e100, 0, 0});
    EXPECT_EQ(Collide(huge, tiny, on_face, Ask(search)).verdict, Verdict::kOverlap);
  }
}

TEST(Collide, IdenticalBodiesAndDeepContainment) {
  for (const NamedMesh& shape : AllShapes()) {
    if (shape.mesh.vertices.size() > 500) continue;
    const ConvexPolyhedron body = MustBuild(shape.mesh);
    for (const Search search : kProven) {
      const CollideResult full = Collide(body, body, RelativePose(), Ask(search));
      EXPECT_EQ(full.verdict, Verdict::kOverlap) << shape.name;
      EXPECT_TRUE(full.face) << shape.name;
      const CollideResult early =
          Collide(body, body, RelativePose(), Ask(search, Certainty::kExact, true));
      EXPECT_EQ(early.termination, Termination::kCoincident) << shape.name;
      EXPECT_EQ(early.certificate.kind, CertificateKind::kCoincidentInterior);
    }
  }
  const ConvexPolyhedron box = MustBuild(Box({100, 100, 100}));
  const ConvexPolyhedron pebble = MustBuild(Placed(RoundBody(30, {1, 1, 1}, 4), 1e-3));
  for (const Search search : kProven) {
    EXPECT_EQ(
        Collide(box, pebble, MustPose(Eigen::Matrix3d::Identity(), {3, 4, 5}), Ask(search)).verdict,
        Verdict::kOverlap);
  }
}

TEST(Collide, BoxesOneUlpApartTouchingAndOneUlpInto) {
  const ConvexPolyhedron box = MustBuild(Box({1, 1, 1}));
  const double contact = 2.0;
  struct Case {
    double at;
    Verdict verdict;
  };
  for (const Case& c :
       {Case{std::nextafter(contact, 3.0), Verdict::kSeparate}, Case{contact, Verdict::kTouch},
        Case{std::nextafter(contact, 1.0), Verdict::kOverlap}}) {
    for (int axis = 0; axis < 3; ++axis) {
      // Face on face, edge on edge (shifted to the rim) and vertex on vertex.
      for (const double second : {0.25, 2.0}) {
        for (const double third : {0.5, 2.0}) {
          Eigen::Vector3d t;
          t[axis] = c.at;
          t[(axis + 1) % 3] = second;
          t[(axis + 2) % 3] = third;
          for (const Search search : kProven) {
            for (const bool early : {false, true}) {
              const bool rim = second == 2.0 || third == 2.0;
              const Verdict expected =
                  c.verdict == Verdict::kOverlap && rim ? Verdict::kTouch : c.verdict;
              EXPECT_EQ(Collide(box, box, MustPose(Eigen::Matrix3d::Identity(), t),
                                Ask(search, Certainty::kExact, early))
                            .verdict,
                        expected)
                  << t.transpose() << " " << ToString(search);
            }
          }
        }
      }
    }
  }
}

TEST(Collide, CoplanarFacesAndVerticesWithinEdgesAreNoObstacle) {
  std::vector<ConvexPolyhedron> cubes = {
      MustBuild(Box({1, 1, 1})), MustBuild(SubdividedCube(3, false)),
      MustBuild(SubdividedCube(2, true)), MustBuild(CubeWithSplitEdges(2))};
  Random random(9);
  for (int i = 0; i < 300; ++i) {
    const Eigen::Matrix3d rotation = i % 2 ? AxisRotation(&random) : random.Rotation();
    Eigen::Vector3d t(random.Int(-8, 8) / 4.0, random.Int(-8, 8) / 4.0, random.Int(-8, 8) / 4.0);
    const Verdict expected = Collide(cubes[0], cubes[0], MustPose(rotation, t)).verdict;
    for (const auto& p : cubes) {
      for (const auto& q : cubes) {
        for (const Search search : kProven) {
          const CollideResult result = Collide(p, q, MustPose(rotation, t), Ask(search));
          ASSERT_EQ(result.verdict, expected) << t.transpose();
          ASSERT_TRUE(result.face);
        }
      }
    }
  }
}

TEST(Collide, PublishedSearchAnswersLikeThePaper) {
  // Two boxes far apart and one in the other: what the paper does get right.
  const ConvexPolyhedron box = MustBuild(Box({1, 2, 3}));
  const CollideResult apart =
      Collide(box, box, MustPose(Eigen::Matrix3d::Identity(), {9, 1, 1}), Ask(Search::kPublished));
  EXPECT_EQ(apart.verdict, Verdict::kSeparate);
  EXPECT_EQ(apart.tier, Tier::kNone);
  EXPECT_EQ(apart.certificate.kind, CertificateKind::kNone);
  const CollideResult inside = Collide(
      box, box, MustPose(Eigen::Matrix3d::Identity(), {0.5, 0.25, 0}), Ask(Search::kPublished));
  EXPECT_EQ(inside.verdict, Verdict::kOverlap);
}

TEST(Collide, TraceListsEveryFaceTheCountsSay) {
  for (const Placement& x : SmallPlacements(/*seed=*/7, 300)) {
    for (const Search search : {Search::kPublished, Search::kPhased}) {
      CollideOptions options = Ask(search);
      options.trace = true;
      const CollideResult result = Collide(x.p, x.q, x.pose, options);
      std::array<long, kPhaseCount> visited{};
      for (const TraceStep& step : result.trace) ++visited[static_cast<int>(step.phase)];
      for (const Phase phase : {Phase::kFaceVertex, Phase::kVertexFace, Phase::kEdgeEdge}) {
        const int i = static_cast<int>(phase);
        EXPECT_EQ(visited[i], result.counts[i].faces_visited) << ToString(phase);
        const PhaseReport& report = result.phases[i - static_cast<int>(Phase::kFaceVertex)];
        if (report.claim != PhaseClaim::kLocal) continue;
        double best = -HUGE_VAL;
        for (const TraceStep& step : result.trace) {
          if (step.phase == phase) best = std::max(best, step.signed_distance);
        }
        if (search == Search::kPublished) {
          EXPECT_EQ(report.signed_distance, best) << ToString(phase);
        }
      }
      options.trace = false;
      EXPECT_TRUE(Collide(x.p, x.q, x.pose, options).trace.empty());
    }
  }
}

TEST(Collide, ThreadsShareBodiesAndAgreeToTheBit) {
  const ConvexPolyhedron p = MustBuild(RoundBody(60, {3, 1, 1}, 41));
  const ConvexPolyhedron q = MustBuild(SubdividedCube(2, false));
  Random random(42);
  std::vector<RelativePose> poses;
  for (int i = 0; i < 400; ++i) {
    poses.push_back(MustPose(i % 2 ? random.Rotation() : AxisRotation(&random),
                             4.0 * random.Unit() * random.Direction()));
  }
  const auto answer = [&] {
    std::vector<std::pair<Verdict, double>> answers;
    for (const RelativePose& pose : poses) {
      const CollideResult result = Collide(p, q, pose);
      answers.emplace_back(result.verdict, result.exit_travel->value);
    }
    return answers;
  };
  const auto expected = answer();
  constexpr int kThreads = 8;
  std::vector<std::vector<std::pair<Verdict, double>>> answers(kThreads);
  std::vector<std::thread> threads;
  for (auto& slot : answers) threads.emplace_back([&] { slot = answer(); });
  for (std::thread& thread : threads) thread.join();
  for (const auto& slot : answers) EXPECT_EQ(slot, expected);
}

TEST(Collide, LargerBodiesAgreeAcrossSearchesAtEveryGap) {
  Random random(11);
  int exact = 0, queries = 0;
  for (const int n : {100, 400}) {
    for (const double stretch : {1.0, 10.0}) {
      const ConvexPolyhedron p = MustBuild(RoundBody(n, {stretch, 1, 1}, random.Bits()));
      const ConvexPolyhedron q = MustBuild(RoundBody(n, {stretch, 1, 1}, random.Bits()));
      for (int i = 0; i < 40; ++i) {
        const Eigen::Matrix3d rotation = random.Rotation();
        const Eigen::Vector3d direction = random.Direction();
        const CollideResult start =
            Collide(p, q, MustPose(rotation, 0.3 * direction), Ask(Search::kPortal));
        // c is not along t exactly, so move along c: the exit travel says where contact is.
        const Eigen::Vector3d along = start.interior_difference.normalized();
        const Eigen::Vector3d contact = 0.3 * direction + start.exit_travel->value * along;
        for (const double gap : {-1e-1, -1e-6, -1e-12, 1e-12, 1e-6, 1e-1}) {
          const Eigen::Vector3d t = contact - gap * along;
          const Verdict expected = gap > 0.0 ? Verdict::kSeparate : Verdict::kOverlap;
          for (const Search search : kProven) {
            const CollideResult result = Collide(p, q, MustPose(rotation, t), Ask(search));
            ++queries;
            exact += result.tier == Tier::kExact;
            EXPECT_EQ(result.verdict, expected) << gap;
          }
        }
      }
    }
  }
  // Rates beside their bounds: measured 0 of 1920 on these seeds.
  EXPECT_LE(exact, queries / 100);
}

// Beyond no face of either body by more than its error, which stays near the rounding of
// coordinates however thin the tetrahedron that the point comes from.
TEST(Collide, NamesACommonPointOnRequest) {
  int named = 0;
  for (const Placement& x : SmallPlacements(/*seed=*/8, 600)) {
    for (const bool early_exit : {false, true}) {
      CollideOptions options = Ask(Search::kPortal, Certainty::kExact, early_exit);
      EXPECT_FALSE(Collide(x.p, x.q, x.pose, options).common_point);
      options.common_point = true;
      const CollideResult result = Collide(x.p, x.q, x.pose, options);
      ASSERT_EQ(result.common_point.has_value(), result.verdict != Verdict::kSeparate) << x.name;
      if (!result.common_point) continue;
      ++named;
      const auto& [point, error] = *result.common_point;
      const double size =
          x.p.max_coordinate() + x.q.max_coordinate() + x.pose.translation().cwiseAbs().maxCoeff();
      EXPECT_LE(error, 1e-12 * size);
      const Eigen::Vector3d in_q = x.pose.rotation().transpose() * (point - x.pose.translation());
      for (const auto& [body, at] : {std::pair{&x.p, point}, std::pair{&x.q, in_q}}) {
        for (int f = 0; f < body->face_count(); ++f) {
          const Eigen::Vector3d n = body->face_normal(f).normalized();
          EXPECT_LE(n.dot(at - body->vertex(body->face(f)[0])), error + 1e-14 * size) << x.name;
        }
      }
    }
  }
  EXPECT_GT(named, 300);
}

}  // namespace
}  // namespace touchstone::testing
