// SPDX-License-Identifier: GPL-3.0-or-later
//
// The hull tier, the Nef tier, the proof tier's class maxima and Decide, held against each other.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <map>

#include "touchstone/exact/convex_minkowski.h"
#include "touchstone/exact/decide.h"
#include "touchstone/exact/judge.h"
#include "touchstone/exact/nef_minkowski.h"
#include "touchstone/exact/phase_maxima.h"
#include "touchstone/tests/exact/shapes.h"

namespace touchstone::exact {
namespace {

bool Same(const std::optional<Ratio>& a, const std::optional<Ratio>& b) {
  return a.has_value() == b.has_value() && (!a.has_value() || Compare(*a, *b) == 0);
}

struct Placed {
  ExactBody p, q;
  RelativePose pose;
};

// Small pairs of every kind: boxes, grid hulls with many parallel features, ellipsoid hulls; turned
// by the cube's rotations, by rounded ones, or placed by two world poses.
Placed SmallPair(Random* random, int round) {
  const auto body = [&]() -> ConvexPolyhedron {
    switch (round % 4) {
      case 0:
        return Box({0, 0, 0}, {1.0 * random->Integer(1, 3), 1.0 * random->Integer(1, 3), 1});
      case 1:
        return GridHull(random, 8, 2, true);
      case 2:
        return GridHull(random, 8, 2, false);
      default:
        return EllipsoidHull(random, 7, {3, 2, 1});
    }
  };
  const ConvexPolyhedron p = body(), q = body();
  const bool whole = round % 3 != 0;
  const Eigen::Matrix3d r = whole ? CubeRotation(random) : RoundedRotation(random);
  const Eigen::Vector3d t = whole ? Eigen::Vector3d(random->Integer(-3, 3), random->Integer(-3, 3),
                                                    random->Integer(-3, 3))
                                  : Eigen::Vector3d(3 * random->OnSphere());
  if (round % 7 == 0) {
    return {p, q, RelativePose::FromWorld({RoundedRotation(random), t}, {r, -t}).value()};
  }
  return {p, q, Pose(r, t)};
}

void CompareProofWithHull(const Placed& placed, const PlacedPair& pair,
                          const MinkowskiDifference& m) {
  EXPECT_TRUE(Same(m.FaceVertexMaximum(), FaceVertexMaximum(pair)));
  EXPECT_TRUE(Same(m.VertexFaceMaximum(), VertexFaceMaximum(pair)));
  EXPECT_TRUE(Same(m.EdgeEdgeMaximum(), EdgeEdgeMaximum(pair)));
  const ExactDecision decision = Decide(placed.p, placed.q, placed.pose);
  ASSERT_TRUE(decision.exit.has_value());
  EXPECT_EQ(ToRational(m.ExitRatio()), 1 / decision.exit->parameter);
  // Euler's formula needs edges; every vertex lies on at least three facets and every facet has
  // three.
  for (const MinkowskiFacet& facet : m.facets) {
    const auto on = std::count_if(
        m.vertices.begin(), m.vertices.end(),
        [&](const IntegerVector& x) { return Dot(facet.plane.normal, x) == facet.plane.offset; });
    EXPECT_GE(on, 3);
  }
}

TEST(Tiers, HullProofAndDecideAgree) {
  Random random(21);
  std::map<FaceClass, int> classes;
  std::map<Verdict, int> verdicts;
  for (int round = 0; round < 600; ++round) {
    SCOPED_TRACE(round);
    const Placed placed = SmallPair(&random, round);
    const PlacedPair pair(placed.p.data(), placed.q.data(), placed.pose, 0, 0);
    if (IsZero(pair.c())) continue;
    const MinkowskiDifference m = ConvexMinkowski(pair);
    CompareProofWithHull(placed, pair, m);
    for (const auto& [face_class, count] : m.ClassCounts()) classes[face_class] += count;
    ++verdicts[Decide(placed.p, placed.q, placed.pose).verdict];
    CollideResult good = GoodResult(placed.p, placed.q, placed.pose);
    AddPhaseMaxima(placed.p, placed.q, placed.pose, &good);
    const std::vector<Finding> findings =
        Judge(placed.p, placed.q, placed.pose, good, {.construct = true});
    for (const Finding& f : findings) ADD_FAILURE() << ToString(f.kind) << ": " << f.detail;
  }
  EXPECT_EQ(classes.size(), 6u);
  for (const auto& [face_class, count] : classes) {
    std::printf("%s %d\n", std::string(ToString(face_class)).c_str(), count);
  }
  EXPECT_GE(verdicts[Verdict::kTouch], 20);
  EXPECT_GE(verdicts[Verdict::kOverlap], 100);
  EXPECT_GE(verdicts[Verdict::kSeparate], 100);
}

TEST(Tiers, HullAndNefAgree) {
  Random random(22);
  for (int round = 0; round < 60; ++round) {
    SCOPED_TRACE(round);
    const Placed placed = SmallPair(&random, round);
    const PlacedPair pair(placed.p.data(), placed.q.data(), placed.pose, 0, 0);
    if (IsZero(pair.c())) continue;
    const MinkowskiDifference hull = ConvexMinkowski(pair), nef = NefMinkowski(pair);
    EXPECT_EQ(hull.vertices, nef.vertices);
    ASSERT_EQ(hull.facets.size(), nef.facets.size());
    for (std::size_t i = 0; i < hull.facets.size(); ++i) {
      EXPECT_EQ(hull.facets[i].plane, nef.facets[i].plane);
      EXPECT_EQ(hull.facets[i].face_class, nef.facets[i].face_class);
    }
  }
}

}  // namespace
}  // namespace touchstone::exact
