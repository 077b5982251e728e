// SPDX-License-Identifier: MIT
//
// The proofs decline what is not so, and the filters never contradict exact signs.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "touchstone/core/cd_dual/certify.h"
#include "touchstone/core/cd_dual/exact_portal.h"
#include "touchstone/core/cd_dual/portal.h"
#include "touchstone/tests/cd_dual/brute_force.h"
#include "touchstone/tests/cd_dual/placements.h"
#include "touchstone/tests/testing/shapes.h"

namespace touchstone::testing {
namespace {

TEST(Signs, FilterNeverContradictsExactSigns) {
  Random random(31);
  long settled = 0, asked = 0;
  for (int i = 0; i < 300; ++i) {
    // Near-degenerate on purpose: lattice bodies moved by a few ulp and scaled.
    const double scale = std::ldexp(1.0, random.Int(-300, 300));
    const Mesh p = Placed(Box(Eigen::Vector3d(1, 2, 3)), scale);
    const Mesh q = i % 2 ? Placed(Box(Eigen::Vector3d(2, 1, 1)), scale)
                         : Placed(RoundBody(12, {3, 1, 1}, i), scale);
    Eigen::Vector3d t(random.Int(-4, 4), random.Int(-4, 4), random.Int(-4, 4));
    for (int axis = 0; axis < 3; ++axis) t[axis] *= 1.0 + random.Int(-3, 3) * 0x1p-52;
    const ConvexPolyhedron body_p = MustBuild(p), body_q = MustBuild(q);
    const RelativePose pose =
        MustPose(i % 3 ? AxisRotation(&random) : random.Rotation(), scale * t);
    MinkowskiDifference m(body_p, body_q, pose);
    ChooseInteriorDifference(&m);
    Signs in_doubles(m, Certainty::kFloat), exact(m, Certainty::kExact);
    const auto pair = [&] {
      return VertexPair{random.Int(0, body_p.vertex_count() - 1),
                        random.Int(0, body_q.vertex_count() - 1)};
    };
    for (int k = 0; k < 300; ++k) {
      const VertexPair x = pair(), y = pair(), z = k % 4 ? pair() : kInteriorDifference;
      ++asked;
      if (const auto sign = in_doubles.Determinant(x, y, z)) {
        ++settled;
        const ExactDifference& big = exact.exact();
        ASSERT_EQ(*sign, Determinant(big.Point(x), big.Point(y), big.Point(z)).sign());
      }
      const Eigen::Vector3d n =
          k % 2 ? Eigen::Vector3d(random.Int(-2, 2), random.Int(-2, 2), 1) : random.Direction();
      ++asked;
      if (const auto sign = in_doubles.AlongDirection(n, x)) {
        ++settled;
        ASSERT_EQ(*sign, Dot(ToDyadic(n), exact.exact().Point(x)).sign());
      }
      FacetPlane plane = in_doubles.Plane({x, y, pair()});
      FacetPlane plane_exact = exact.Plane(plane.points);
      for (const Body body : {Body::kP, Body::kQ}) {
        const int to = body == Body::kP ? z.p : z.q, from = body == Body::kP ? x.p : x.q;
        if (to < 0) continue;
        ++asked;
        if (const auto sign = in_doubles.AlongNormal(&plane, body, to, from)) {
          ++settled;
          if (to == from) continue;
          const ExactDifference& big = exact.exact();
          const DyadicVector o = big.Point(plane.points[0]);
          const DyadicVector normal =
              Cross(big.Point(plane.points[1]) - o, big.Point(plane.points[2]) - o);
          ASSERT_EQ(*sign, Dot(normal, big.Edge(body, to, from)).sign());
        }
      }
    }
    EXPECT_EQ(in_doubles.exact_count(), 0);
  }
  EXPECT_GT(settled, asked / 2) << "the filter should settle something";
}

std::optional<Tier> Proves(Signs* signs, const Eigen::Vector3d& direction, CornerPair support) {
  return ProveSeparatingDirection(signs, direction, &support);
}

TEST(ProveSeparatingDirection, DeclinesADirectionThatDoesNotSeparate) {
  const ConvexPolyhedron box = MustBuild(Box({1, 1, 1}));
  const RelativePose apart = MustPose(Eigen::Matrix3d::Identity(), {3, 0, 0});
  MinkowskiDifference m(box, box, apart);
  Signs signs(m, Certainty::kExact);
  PhaseCounts counts;
  const auto support = [&](const Eigen::Vector3d& n) {
    return m.Corners(m.Support(n, {}, &counts));
  };
  const Eigen::Vector3d good(1, 0.1, 0.01), bad(0, 1, 0.1);
  EXPECT_TRUE(Proves(&signs, good, support(good)));
  EXPECT_FALSE(Proves(&signs, bad, support(bad)));
  EXPECT_FALSE(Proves(&signs, -good, support(-good)));
}

TEST(ProveSeparatingDirection, TiesCostNoScanWhereTheMarginSuffices) {
  // Along a face's normal a whole face of the box is level with the support; the corner's margin,
  // 1/sqrt(3), shows that rounding hides less than 1e-13 of the size.
  const ConvexPolyhedron box = MustBuild(Box({1, 1, 1}));
  const Eigen::Matrix3d turned = Random(32).Rotation();
  const RelativePose pose = MustPose(turned, turned * Eigen::Vector3d(0, 0, 3));
  MinkowskiDifference m(box, box, pose);
  Signs signs(m, Certainty::kExact);
  PhaseCounts counts;
  const Eigen::Vector3d n = turned * Eigen::Vector3d(0, 0, 1);
  for (int v = 0; v < 8; ++v) EXPECT_NEAR(box.corner_margin(v), 1.0 / std::sqrt(3.0), 1e-12);
  const auto tier = Proves(&signs, n, m.Corners(m.Support(n, {}, &counts)));
  ASSERT_TRUE(tier);
  EXPECT_EQ(*tier, Tier::kBound);
}

TEST(ProveSeparatingDirection, DeclinesAFalseSupportThatWouldSeparate) {
  // Some vertices of M are on the far side though the direction does not separate: the proof must
  // not believe that one of them is extreme.
  int tried = 0;
  for (const Placement& x : SmallPlacements(/*seed=*/33, 300)) {
    MinkowskiDifference m(x.p, x.q, x.pose);
    ChooseInteriorDifference(&m);
    Signs signs(m, Certainty::kExact);
    const Eigen::Vector3d n(0.3, -0.5, 0.9);
    for (int a = 0; a < x.p.vertex_count(); ++a) {
      for (int b = 0; b < x.q.vertex_count(); ++b) {
        if (!(n.dot(m.Point(VertexPair{a, b})) < -1e-9)) continue;
        ++tried;
        const bool proven = Proves(&signs, n, m.Corners({a, b})).has_value();
        bool truly = true;
        for (int i = 0; i < x.p.vertex_count() && truly; ++i) {
          for (int j = 0; j < x.q.vertex_count() && truly; ++j) {
            truly = Dot(ToDyadic(n), signs.exact().Point({i, j})).sign() < 0;
          }
        }
        if (proven) {
          ASSERT_TRUE(truly) << x.name;
        }
      }
    }
  }
  EXPECT_GT(tried, 1000);
}

TEST(SupportingFeature, DeclinesAVertexWithinAFacetThatTheBodyRisesAbove) {
  // All neighbours of a vertex within a facet are level with it along the facet's normal, inward as
  // well as outward; only outward is it extreme. Within an edge of a cube whose faces are single
  // polygons, both neighbours are level along every direction across the edge.
  for (const ConvexPolyhedron& cube :
       {MustBuild(SubdividedCube(3, false)), MustBuild(CubeWithSplitEdges(2))}) {
    const RelativePose pose;
    MinkowskiDifference m(cube, cube, pose);
    Signs signs(m, Certainty::kExact);
    for (int v = 0; v < cube.vertex_count(); ++v) {
      if (cube.is_corner(v)) continue;
      for (int f = 0; f < cube.face_count(); ++f) {
        const auto& x = cube.face_plane(f);
        // Inward along face f of P, with one vertex of Q: a plane that cuts or misses P's support.
        FacetPlane plane = signs.Plane({VertexPair{x[0], 0}, {x[2], 0}, {x[1], 0}});
        EXPECT_FALSE(SupportingFeature(&signs, &plane, Body::kP, v)) << v << " along -" << f;
      }
    }
  }
}

TEST(ProveExitFace, DeclinesEveryTriangleButTheExit) {
  int proven = 0, declined = 0;
  for (const Placement& x : SmallPlacements(/*seed=*/34, 120)) {
    MinkowskiDifference m(x.p, x.q, x.pose);
    ChooseInteriorDifference(&m);
    const BruteForceExit truth =
        FindExitByBruteForce(x.p, x.q, x.pose, m.interior_p(), m.interior_q());
    Signs signs(m, Certainty::kExact);
    Random random(35);
    PhaseCounts counts;
    const std::array<VertexPair, 3> exit = FindExactExit(&signs, {}, &counts).triangle;
    for (int k = 0; k < 200; ++k) {
      std::array<VertexPair, 3> triangle = exit;
      for (int i = 0; i < 3; ++i) {
        if (random.Int(0, 2)) continue;
        triangle[i] = {random.Int(0, x.p.vertex_count() - 1),
                       random.Int(0, x.q.vertex_count() - 1)};
      }
      if (random.Int(0, 3) == 0) std::swap(triangle[0], triangle[1]);  // turned inside out
      const auto face = ProveExitFace(&signs, triangle);
      if (!face) {
        ++declined;
        continue;
      }
      ++proven;
      // Then its plane must be the exit plane: the exact parameter along the ray is the least.
      const ExactDifference& big = signs.exact();
      const DyadicVector v = big.Point(triangle[0]), c = big.Point(kInteriorDifference);
      const DyadicVector n = Cross(big.Point(triangle[1]) - v, big.Point(triangle[2]) - v);
      const Fraction s{Dot(n, v - c), -Dot(n, c)};
      ASSERT_EQ(Compare(s, truth.parameter), 0) << x.name;
    }
    ASSERT_TRUE(ProveExitFace(&signs, exit)) << x.name;
  }
  EXPECT_GT(proven, 100);
  EXPECT_GT(declined, 1000);
}

TEST(ProveEnclosingTetrahedron, HoldsOnlyForOverlap) {
  int proven = 0;
  for (const Placement& x : SmallPlacements(/*seed=*/36, 600)) {
    MinkowskiDifference m(x.p, x.q, x.pose);
    ChooseInteriorDifference(&m);
    Signs signs(m, Certainty::kExact);
    const BruteForceExit truth =
        FindExitByBruteForce(x.p, x.q, x.pose, m.interior_p(), m.interior_q());
    Random random(37);
    for (int k = 0; k < 50; ++k) {
      std::array<VertexPair, 3> triangle;
      for (VertexPair& v : triangle) {
        v = {random.Int(0, x.p.vertex_count() - 1), random.Int(0, x.q.vertex_count() - 1)};
      }
      if (!ProveEnclosingTetrahedron(&signs, triangle)) continue;
      ++proven;
      ASSERT_EQ(truth.verdict, Verdict::kOverlap) << x.name;
    }
  }
  EXPECT_GT(proven, 100);  // measured: 229
}

TEST(FindExactExit, FindsTheExitFromAnyStart) {
  for (const Placement& x : SmallPlacements(/*seed=*/38, 300)) {
    MinkowskiDifference m(x.p, x.q, x.pose);
    ChooseInteriorDifference(&m);
    const BruteForceExit truth =
        FindExitByBruteForce(x.p, x.q, x.pose, m.interior_p(), m.interior_q());
    Signs signs(m, Certainty::kExact);
    Random random(39);
    for (int k = 0; k < 5; ++k) {
      std::array<VertexPair, 3> start;
      for (VertexPair& v : start) {
        v = {random.Int(0, x.p.vertex_count() - 1), random.Int(0, x.q.vertex_count() - 1)};
      }
      PhaseCounts counts;
      const ExactExit exit = FindExactExit(&signs, start, &counts);
      const int expected = truth.verdict == Verdict::kOverlap ? 1
                           : truth.verdict == Verdict::kTouch ? 0
                                                              : -1;
      EXPECT_EQ(exit.side_of_origin, expected) << x.name;
      EXPECT_TRUE(ProveExitFace(&signs, exit.triangle)) << x.name;
    }
  }
}

TEST(FindExactExit, RayThroughAVertexOfM) {
  // c straight below a vertex of M: P's corner (1,1,1) against Q's corner (-1,-1,-1), c along the
  // diagonal. Every sign that the ray's own position decides is zero.
  const ConvexPolyhedron p = MustBuild(Octahedron()), q = MustBuild(Octahedron());
  for (const double shift : {1.5, 2.0, 2.5}) {
    const RelativePose pose = MustPose(Eigen::Matrix3d::Identity(), {shift, 0, 0});
    MinkowskiDifference m(p, q, pose);
    m.ChooseInterior(0, 0);  // equal shapes: c = -t exactly, so the ray runs along the axis
    Signs signs(m, Certainty::kExact);
    PhaseCounts counts;
    const ExactExit exit = FindExactExit(&signs, {}, &counts);
    EXPECT_EQ(exit.side_of_origin, shift < 2.0 ? 1 : shift == 2.0 ? 0 : -1);
    EXPECT_TRUE(ProveExitFace(&signs, exit.triangle));
  }
}

}  // namespace
}  // namespace touchstone::testing
