// SPDX-License-Identifier: MIT
#include "touchstone/core/cpd/mesh_penetration_depth.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "touchstone/core/mesh/membership.h"
#include "touchstone/core/minkowski/boundary.h"
#include "touchstone/core/proximity/penetration_depth.h"
#include "touchstone/tests/cpd/depth_bodies.h"
#include "touchstone/tests/testing/poses.h"
#include "touchstone/tests/testing/random.h"
#include "touchstone/tests/testing/shapes.h"
#include "touchstone/tools/shapes/paper_scenes.h"
#include "touchstone/tools/shapes/shapes.h"

namespace touchstone {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using testing::DepthBodies;
using testing::PoseOf;

Shape ShapeOf(const testing::Mesh& mesh) {
  Shape out;
  out.vertices = mesh.vertices;
  for (const auto& face : testing::Triangulated(mesh).faces) {
    out.faces.push_back({face[0], face[1], face[2]});
  }
  return out;
}

double DistanceToSegment(const Vector3d& a, const Vector3d& b) {
  const Vector3d ab = b - a;
  const double t = std::clamp(-a.dot(ab) / ab.squaredNorm(), 0.0, 1.0);
  return (a + t * ab).norm();
}

double DistanceToTriangle(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d n = (b - a).cross(c - a);
  if (n.dot((b - a).cross(-a)) >= 0 && n.dot((c - b).cross(-b)) >= 0 &&
      n.dot((a - c).cross(-c)) >= 0 && n.norm() > 0) {
    return std::abs(n.dot(a)) / n.norm();
  }
  return std::min({DistanceToSegment(a, b), DistanceToSegment(b, c), DistanceToSegment(c, a)});
}

// From the origin to the whole exact boundary; 0 if the interiors do not meet.
double DepthByBoundary(const MeshPair& pair) {
  if (Membership(pair, Vector3d(Vector3d::Zero())).verdict != Verdict::kOverlap) return 0.0;
  const SumBoundary sum = BuildSumBoundary(pair, GaussMap(pair.a().mesh), GaussMap(pair.b().mesh));
  double depth = std::numeric_limits<double>::infinity();
  const auto& at = sum.vertices;
  for (const auto& [a, b, c] : sum.triangles) {
    depth = std::min(depth, DistanceToTriangle(at[a], at[b], at[c]));
  }
  for (const auto& [a, b, c] : sum.sheets) {
    depth = std::min(depth, DistanceToTriangle(at[a], at[b], at[c]));
  }
  for (const auto& [a, b] : sum.segments) depth = std::min(depth, DistanceToSegment(at[a], at[b]));
  for (const int p : sum.points) depth = std::min(depth, at[p].norm());
  return depth;
}

// What every answer must satisfy, whatever the bodies. The bounds of a certain answer differ by
// steps of 2^-40 of the size, longer where contacts lean against each other: measured 4e-9.
void ExpectSound(const MeshPair& pair, const MeshDepthResult& result) {
  ASSERT_TRUE(result.translation.allFinite());
  EXPECT_LE(result.lower_bound, result.upper_bound);
  const double slack = result.by_boundary ? 1e-11 / pair.scale() : 1e-14 * result.upper_bound;
  EXPECT_NEAR(result.translation.norm(), result.upper_bound, slack);
  if (result.status == MeshDepthStatus::kSeparate) {
    EXPECT_EQ(result.upper_bound, 0.0);
    return;
  }
  if (!result.is_exact && !result.by_boundary) {
    EXPECT_NE(Membership(pair, result.translation).verdict, Verdict::kOverlap);
  }
  if (result.status == MeshDepthStatus::kCertain) {
    EXPECT_LE(result.upper_bound - result.lower_bound, 1e-8 / pair.scale());
  }
}

TEST(MeshPenetrationDepth, BoxInBox) {
  const DepthBodies bodies(Box({0, 0, 0}, {4, 5, 6}), Box({0, 0, 0}, {1, 1, 1}));
  // From x in [1, 2] the way out through x = 0 is 1 + x.
  for (const double x : {0.5, 1.0, 1.25, -0.5}) {
    const RelativePose pose = PoseOf(Matrix3d::Identity(), {x, 2, 2.5});
    const MeshDepthResult result = bodies.Depth(pose);
    ExpectSound(bodies.At(pose), result);
    EXPECT_EQ(result.status, MeshDepthStatus::kCertain);
    EXPECT_NEAR(result.upper_bound, 1.0 + x, 1e-9);
    EXPECT_NEAR(result.translation[0], -1.0 - x, 1e-9);
  }
}

TEST(MeshPenetrationDepth, SeparateAndTouching) {
  const DepthBodies bodies(Box({0, 0, 0}, {1, 1, 1}), Box({0, 0, 0}, {1, 1, 1}));
  for (const Vector3d& t :
       {Vector3d(1, 0, 0), Vector3d(1, 1, 0), Vector3d(1, 1, 1), Vector3d(-1, 0.5, 0.5),
        Vector3d(3, 0, 0), Vector3d(0, 0, 1.0 + 1e-15)}) {
    const MeshDepthResult result = bodies.Depth(PoseOf(Matrix3d::Identity(), t));
    EXPECT_EQ(result.status, MeshDepthStatus::kSeparate);
    EXPECT_EQ(result.upper_bound, 0.0);
    EXPECT_EQ(result.translation, Vector3d(0, 0, 0));
  }
  // One ulp into contact.
  const double touch = std::nextafter(1.0, 0.0);
  const MeshDepthResult result = bodies.Depth(PoseOf(Matrix3d::Identity(), {touch, 0.25, 0.125}));
  EXPECT_NE(result.status, MeshDepthStatus::kSeparate);
  EXPECT_GT(result.upper_bound, 0.0);
  EXPECT_LT(result.upper_bound, 1e-11);
}

TEST(MeshPenetrationDepth, PinInAUAndKeyInSlot) {
  // A pin of width w < 1 in the gap [1, 2] of the U, raised by z: into the wall by s.
  const DepthBodies thin(UShape(), Box({0, 0, 0}, {0.5, 1, 4}));
  const MeshDepthResult wall = thin.Depth(PoseOf(Matrix3d::Identity(), {0.875, 0.25, 1.5}));
  EXPECT_NEAR(wall.upper_bound, 0.125, 1e-9);
  const MeshDepthResult floor = thin.Depth(PoseOf(Matrix3d::Identity(), {1.25, 0, 0.9375}));
  EXPECT_NEAR(floor.upper_bound, 0.0625, 1e-9);
  // The key fills its slot exactly: the way out is the sheet x = 0 of ∂M, with M° on both sides.
  const DepthBodies exact(Slot(), Key());
  const RelativePose pose = PoseOf(Matrix3d::Identity(), {2.25, 0.5, 1.0});
  const MeshDepthResult key = exact.Depth(pose);
  ExpectSound(exact.At(pose), key);
  EXPECT_EQ(key.status, MeshDepthStatus::kCertain);
  EXPECT_TRUE(key.is_exact);
  EXPECT_EQ(key.translation, Vector3d(-0.25, 0, 0));
  EXPECT_NEAR(key.lower_bound, 0.25, 1e-14);
  const MeshDepthResult in_doubles = exact.Depth(pose, {.certainty = Certainty::kFloat});
  EXPECT_LE(in_doubles.lower_bound, 0.25);
  EXPECT_GE(in_doubles.upper_bound, 0.25);
}

TEST(MeshPenetrationDepth, ConfirmedExactly) {
  const DepthBodies bodies(Torus(12, 8, 2.0, 0.75), Star(5));
  testing::Random random(11);
  int confirmed = 0;
  for (int i = 0; i < 10; ++i) {
    const RelativePose pose =
        PoseOf(random.Rotation(), {random.Uniform(1, 2), random.Uniform(-1, 1), 0});
    const MeshDepthResult plain = bodies.Depth(pose);
    const MeshDepthResult result = bodies.Depth(pose, {.confirm_exactly = true});
    if (result.status != MeshDepthStatus::kCertain) continue;
    confirmed += result.is_exact;
    EXPECT_LE(plain.lower_bound, result.upper_bound);
    EXPECT_GE(plain.upper_bound, result.lower_bound);
    if (result.is_exact) {
      EXPECT_LE(result.upper_bound - result.lower_bound, 1e-14 * result.upper_bound);
    }
  }
  EXPECT_GE(confirmed, 8);
}

// Pairs of small bodies of every sort against the whole boundary, cold and warm.
TEST(MeshPenetrationDepth, EqualsTheWholeBoundary) {
  struct Pair {
    std::string name;
    Shape a, b;
    double reach;  // of translations
  };
  const std::vector<Pair> pairs = {
      {"torus/star", Torus(10, 6, 2.0, 0.75), Star(5), 2.0},
      {"axes/l", Axes(4), LShape(), 2.5},
      {"u/u", UShape(), UShape(), 2.0},
      {"hollow/box", HollowBox(), Box({-0.4, -0.4, -0.4}, {0.4, 0.4, 0.4}), 1.0},
      {"dimpled/spiked", Dimpled(6), Spiked(6), 1.0},
      {"cone/axes", Cone(16, 1.5, 4.0), Axes(4), 2.0},
      {"tori/star", InterlockedTori(8, 5), Star(4), 2.0},
      {"slot/key", Slot(), Key(), 2.5},
      {"star/star", Star(7), Star(6), 0.7}};
  int certain = 0, overlapping = 0;
  int kinds[8] = {};
  for (const Pair& pair : pairs) {
    const DepthBodies bodies(pair.a, pair.b);
    testing::Random random(2024);
    MeshDepthCache cache;
    for (int i = 0; i < 12; ++i) {
      const bool is_on_grid = i % 4 == 3;
      Vector3d t;
      for (int k = 0; k < 3; ++k) {
        t[k] = is_on_grid ? 0.25 * random.Int(-4, 8) : random.Uniform(-0.5, 1.0) * pair.reach;
      }
      const RelativePose pose =
          PoseOf(is_on_grid ? Matrix3d(Matrix3d::Identity()) : random.Rotation(), t);
      const MeshPair placed = bodies.At(pose);
      const double expected = DepthByBoundary(placed);
      for (MeshDepthCache* use : {static_cast<MeshDepthCache*>(nullptr), &cache, &cache}) {
        const MeshDepthResult result = MeshPenetrationDepth(placed, bodies.a, bodies.b, {}, use);
        SCOPED_TRACE(pair.name + " " + std::to_string(i));
        ExpectSound(placed, result);
        // Boundary corners are rounded to below 1e-12.
        EXPECT_LE(result.lower_bound, expected + 1e-9);
        EXPECT_GE(result.upper_bound, expected - 1e-9);
        if (result.status == MeshDepthStatus::kCertain) {
          EXPECT_NEAR(result.upper_bound, expected, 1e-7);
        }
        if (use != nullptr) continue;
        overlapping += result.status != MeshDepthStatus::kSeparate;
        certain += result.status == MeshDepthStatus::kCertain;
        ++kinds[static_cast<int>(result.kind)];
      }
    }
  }
  EXPECT_GT(overlapping, 60);
  EXPECT_EQ(certain, overlapping);
  EXPECT_GT(kinds[static_cast<int>(NearestKind::kPlaneFoot)], 5);
  EXPECT_GT(kinds[static_cast<int>(NearestKind::kCrossingFoot)], 5);
}

// Answers so far off that the search goes beyond its first reach and begins at the roots again, as
// where a box all but fills a dent. At the first of these poses a facet was once taken for made
// that had been left out for its group's distance.
TEST(MeshPenetrationDepth, NothingIsLostBeyondTheFirstReach) {
  const DepthBodies bodies(NamedShape("dimpled", 50), NamedShape("spiked", 100));
  Matrix3d turned;
  turned << -0x1.ecd7047308a49p-2, 0x1.c0cca2adddb52p-1, -0x1.2b8a61f97cf35p-10,
      0x1.c0ccb450b0d5bp-1, 0x1.ecd71ecb29fb9p-2, 0x1.4e8b36bbff681p-14, 0x1.44fcc57ad8c57p-11,
      -0x1.f9014c66fe3e1p-11, -0x1.ffffe9fce3d35p-1;
  const Vector3d t(-0x1.037326ba6a572p+0, -0x1.d1accedac81b9p+0, -0x1.ffe7b2b3e9ce3p+0);
  testing::Random random(7);
  int far = 0;
  for (int i = 0; i < 12; ++i) {
    const Vector3d tilt = 0.1 * random.Direction();
    const Matrix3d by = Eigen::AngleAxisd(i == 0 ? 0.0 : tilt.norm(), tilt.normalized()).matrix();
    const Vector3d off = i == 0 ? Vector3d(Vector3d::Zero()) : Vector3d(0.2 * random.Direction());
    const MeshPair pair = bodies.At(PoseOf(by * turned, t + off));
    const MeshDepthResult result = MeshPenetrationDepth(pair, bodies.a, bodies.b);
    SCOPED_TRACE(i);
    ExpectSound(pair, result);
    EXPECT_NEAR(result.upper_bound, DepthByBoundary(pair), 1e-7);
    const double width = pair.a().tree.high()[2] - pair.b().tree.low()[2];
    far += result.upper_bound > 0.25 * width / pair.scale();
  }
  EXPECT_GT(far, 6);
}

// The bodies overlap by less than their boxes are rounded by, which seem to be apart.
TEST(MeshPenetrationDepth, BoxesApartByTheirRounding) {
  const DepthBodies bodies(NamedShape("spiked", 50), NamedShape("fish", 200));
  Matrix3d turned;
  turned << -1, 0, 0, 0, 0, 1, 0, 1, 0;
  const Vector3d t(0x1.3333333333333p+0, -0x1.7333333333333p+1, -0.25);
  const MeshPair pair = bodies.At(PoseOf(turned, t));
  const MeshDepthResult result = MeshPenetrationDepth(pair, bodies.a, bodies.b);
  ASSERT_NE(result.status, MeshDepthStatus::kSeparate);
  EXPECT_LT(result.upper_bound, 1e-11);
  ExpectSound(pair, result);
}

TEST(MeshPenetrationDepth, ConvexPairsAsByTheConvexQuery) {
  testing::Random random(5);
  for (int i = 0; i < 10; ++i) {
    const testing::Mesh p = testing::RoundBody(20, {1, 1, 1}, 10 + i);
    const testing::Mesh q = testing::RoundBody(30, {2, 1, 1}, 40 + i);
    const DepthBodies bodies(ShapeOf(p), ShapeOf(q));
    const RelativePose pose = PoseOf(random.Rotation(), 0.8 * random.Direction());
    const MeshDepthResult result = bodies.Depth(pose);
    const auto convex = PenetrationDepth(testing::MustBuild(p), testing::MustBuild(q), pose);
    ASSERT_EQ(result.status, MeshDepthStatus::kCertain);
    EXPECT_NEAR(result.upper_bound, convex.depth.value, 1e-9);
  }
}

// A round body in a wide slab of height 2: out by the nearer side, whichever way it is turned.
TEST(MeshPenetrationDepth, RoundBodyInASlab) {
  const testing::Mesh round = testing::RoundBody(60, {0.8, 0.8, 0.8}, 3);
  const DepthBodies bodies(Box({-20, -20, -1}, {20, 20, 1}), ShapeOf(round));
  testing::Random random(61);
  for (int i = 0; i < 8; ++i) {
    const Matrix3d r = random.Rotation();
    const Vector3d t(random.Uniform(-2, 2), random.Uniform(-2, 2), random.Uniform(-1.5, 1.5));
    double low = 1e300, high = -1e300;
    for (const Vector3d& v : round.vertices) {
      low = std::min(low, (r * v + t).z());
      high = std::max(high, (r * v + t).z());
    }
    const MeshDepthResult result = bodies.Depth(PoseOf(r, t));
    EXPECT_EQ(result.status, MeshDepthStatus::kCertain);
    EXPECT_NEAR(result.upper_bound, std::min(1.0 - low, 1.0 + high), 1e-9);
  }
}

// Two linked rings whose tubes meet: they part along the line between the tubes, or nearly so.
TEST(MeshPenetrationDepth, LinkedRings) {
  const DepthBodies bodies(Torus(12, 8, 2.0, 0.5), Torus(12, 8, 2.0, 0.5));
  const Matrix3d upright =
      Eigen::AngleAxisd(1.5707963267948966, Vector3d::UnitX()).toRotationMatrix();
  for (const double overlap : {0.02, 0.1, 0.3}) {
    // The second ring passes x = 1 + overlap, where the first one's tube begins at 1.5.
    const RelativePose pose = PoseOf(upright, {3.0 + overlap, 1e-3, 2e-3});
    const MeshDepthResult result = bodies.Depth(pose);
    const double expected = DepthByBoundary(bodies.At(pose));
    ExpectSound(bodies.At(pose), result);
    EXPECT_EQ(result.status, MeshDepthStatus::kCertain);
    EXPECT_NEAR(result.upper_bound, expected, 1e-8);
    EXPECT_LE(result.upper_bound, Vector3d(overlap, 1e-3, 2e-3).norm() + 1e-9);
    EXPECT_GT(result.upper_bound, 0.5 * overlap);
  }
  EXPECT_EQ(bodies.Depth(PoseOf(upright, {2.0, 0, 0})).status, MeshDepthStatus::kSeparate);
}

// A box in the cavity of a hollow one is free; in its wall it is not.
TEST(MeshPenetrationDepth, InACavityAndAroundIt) {
  const DepthBodies bodies(HollowBox(), Box({-0.25, -0.25, -0.25}, {0.25, 0.25, 0.25}));
  const Vector3d cavity(2, 1.78125, 1.5625);
  EXPECT_EQ(bodies.Depth(PoseOf(Matrix3d::Identity(), cavity)).status, MeshDepthStatus::kSeparate);
  double deepest = 0.0;
  for (double x = 0.0; x < 3.0; x += 0.125) {
    const RelativePose pose = PoseOf(Matrix3d::Identity(), cavity + x * Vector3d::UnitX());
    const MeshDepthResult result = bodies.Depth(pose);
    ExpectSound(bodies.At(pose), result);
    EXPECT_NEAR(result.upper_bound, DepthByBoundary(bodies.At(pose)), 1e-8);
    deepest = std::max(deepest, result.upper_bound);
  }
  EXPECT_GT(deepest, 0.2);
}

// Six ways out of the same length, and eight: any of them, the same one every time, warm or cold.
TEST(MeshPenetrationDepth, SymmetricTies) {
  const Shape cube = Box({-1, -1, -1}, {1, 1, 1});
  const DepthBodies cubes(cube, Box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}));
  MeshDepthCache cache;
  const MeshDepthResult first = cubes.Depth(PoseOf(Matrix3d::Identity()), {}, &cache);
  EXPECT_EQ(first.status, MeshDepthStatus::kCertain);
  EXPECT_NEAR(first.upper_bound, 1.5, 1e-11);
  EXPECT_NEAR(first.translation.cwiseAbs().maxCoeff(), 1.5, 1e-11);
  for (int i = 0; i < 3; ++i) {
    const MeshDepthResult again = cubes.Depth(PoseOf(Matrix3d::Identity()), {}, &cache);
    EXPECT_NEAR(again.upper_bound, 1.5, 1e-11);
  }
  const DepthBodies stars(Star(8), Star(8));
  const RelativePose half =
      PoseOf(Eigen::AngleAxisd(0.39269908169872414, Vector3d::UnitZ()).toRotationMatrix());
  const MeshDepthResult star = stars.Depth(half);
  ExpectSound(stars.At(half), star);
  EXPECT_EQ(star.status, MeshDepthStatus::kCertain);
  EXPECT_NEAR(star.upper_bound, DepthByBoundary(stars.At(half)), 1e-8);
}

// Bodies of 1000 to 2000 faces, against the whole exact boundary. (Of 60 moments of each the worst
// is off by 4e-9, of a size of 250.)
TEST(MeshPenetrationDepth, PaperScenesAgainstWholeBoundaries) {
  for (const PaperScene& scene : AllPaperScenes()) {
    const DepthBodies bodies(scene.a, scene.b);
    MeshDepthCache cache;
    for (const double s : {0.03, 0.27, 0.61}) {
      const RelativePose pose = scene.PoseAt(s);
      const MeshDepthResult result = bodies.Depth(pose, {}, &cache);
      ExpectSound(bodies.At(pose), result);
      EXPECT_EQ(result.status, MeshDepthStatus::kCertain) << scene.name << ' ' << s;
      EXPECT_NEAR(result.upper_bound, DepthByBoundary(bodies.At(pose)), 2e-8)
          << scene.name << ' ' << s;
    }
  }
}

// Both bodies moved rigidly: vertices are rounded anew, by 1e-16 of the size.
TEST(MeshPenetrationDepth, UnchangedByARigidMotionOfBoth) {
  const Shape torus = Torus(12, 8, 2.0, 0.75), star = Star(5);
  testing::Random random(71);
  for (int i = 0; i < 6; ++i) {
    const Matrix3d r = random.Rotation(), turn = random.Rotation();
    const Vector3d t = 1.7 * random.Direction(), shift = 3.0 * random.Direction();
    Shape moved = torus;
    for (Vector3d& v : moved.vertices) v = turn * v + shift;
    const double depth = DepthBodies(torus, star).Depth(PoseOf(r, t)).upper_bound;
    const double other =
        DepthBodies(moved, star).Depth(PoseOf(turn * r, turn * t + shift)).upper_bound;
    EXPECT_NEAR(depth, other, 1e-8);
  }
}

TEST(MeshPenetrationDepth, Invariances) {
  const DepthBodies bodies(Torus(12, 8, 2.0, 0.75), Fish(9, 6));
  const DepthBodies swapped(Fish(9, 6), Torus(12, 8, 2.0, 0.75));
  testing::Random random(17);
  for (int i = 0; i < 10; ++i) {
    const Matrix3d r = random.Rotation();
    const Vector3d t = 1.5 * random.Direction();
    const MeshDepthResult result = bodies.Depth(PoseOf(r, t));
    const MeshDepthResult other = swapped.Depth(PoseOf(r.transpose(), -(r.transpose() * t)));
    EXPECT_NEAR(result.upper_bound, other.upper_bound, 1e-8);
    // The depth changes no faster than B moves.
    const Vector3d step = 0.05 * random.Direction();
    const MeshDepthResult moved = bodies.Depth(PoseOf(r, t + step));
    EXPECT_LE(std::abs(moved.upper_bound - result.upper_bound), step.norm() + 1e-8);
  }
}

TEST(MeshPenetrationDepth, FarScalesAndNoise) {
  const Shape torus = Torus(10, 6, 2.0, 0.75), star = Star(5);
  testing::Random random(3);
  const Matrix3d r = random.Rotation();
  const Vector3d t(1.5, 0.25, 0.125);
  const double depth = DepthBodies(torus, star).Depth(PoseOf(r, t)).upper_bound;
  ASSERT_GT(depth, 0.05);
  for (const double scale : {0x1p-330, 0x1p-40, 0x1p40, 0x1p320}) {
    const DepthBodies scaled(Moved(torus, scale, Vector3d::Zero()),
                             Moved(star, scale, Vector3d::Zero()));
    EXPECT_EQ(scaled.Depth(PoseOf(r, scale * t)).upper_bound, scale * depth) << scale;
  }
  for (int i = 0; i < 5; ++i) {
    Shape noisy = torus;
    for (Vector3d& v : noisy.vertices) {
      for (int k = 0; k < 3; ++k) v[k] += random.Uniform(-1e-15, 1e-15);
    }
    EXPECT_NEAR(DepthBodies(noisy, star).Depth(PoseOf(r, t)).upper_bound, depth, 1e-8);
  }
}

// Rates by central differences, where the contacts are the same on both sides.
TEST(MeshPenetrationDepth, RatesAreDerivatives) {
  const DepthBodies bodies(Torus(12, 8, 2.0, 0.75), Fish(9, 6));
  testing::Random random(29);
  constexpr double kH = 1e-5;
  int compared = 0;
  for (int i = 0; i < 30; ++i) {
    const Matrix3d r = random.Rotation();
    const Vector3d t = 1.6 * random.Direction();
    const MeshDepthOptions options{.confirm_exactly = true};
    const MeshDepthResult result = bodies.Depth(PoseOf(r, t), options);
    if (!result.rate_of_rotation) continue;
    const Vector3d axis = random.Direction();
    const auto rate = [&](const auto& pose_at, double by_contacts) {
      const MeshDepthResult after = bodies.Depth(pose_at(kH), options);
      const MeshDepthResult before = bodies.Depth(pose_at(-kH), options);
      if (after.kind != result.kind || before.kind != result.kind) return;
      if (after.contacts[0].features != before.contacts[0].features) return;
      ++compared;
      EXPECT_NEAR((after.upper_bound - before.upper_bound) / (2.0 * kH), by_contacts, 1e-3);
    };
    rate([&](double h) { return PoseOf(r, t + h * axis); }, result.rate_of_translation->dot(axis));
    rate([&](double h) { return PoseOf(Eigen::AngleAxisd(h, axis).toRotationMatrix() * r, t); },
         result.rate_of_rotation->dot(axis));
  }
  EXPECT_GT(compared, 20);
}

TEST(MeshPenetrationDepth, LimitKeepsBounds) {
  const DepthBodies bodies(Torus(12, 8, 2.0, 0.75), Star(5));
  const RelativePose pose = PoseOf(testing::Random(3).Rotation(), {1.5, 0.25, 0.125});
  const double depth = bodies.Depth(pose).upper_bound;
  const MeshDepthResult cut = bodies.Depth(pose, {.piece_limit = 1});
  EXPECT_LE(cut.lower_bound, depth);
  EXPECT_GE(cut.upper_bound, depth);
}

TEST(MeshPenetrationDepth, PaperScenesAreCertain) {
  for (const PaperScene& scene : AllPaperScenes()) {
    const DepthBodies bodies(scene.a, scene.b);
    MeshDepthCache cache;
    for (int i = 0; i < 5; ++i) {
      const MeshPair pair = bodies.At(scene.PoseAt(0.1 + 0.2 * i));
      const MeshDepthResult cold = MeshPenetrationDepth(pair, bodies.a, bodies.b);
      const MeshDepthResult warm = MeshPenetrationDepth(pair, bodies.a, bodies.b, {}, &cache);
      ExpectSound(pair, cold);
      EXPECT_EQ(cold.status, MeshDepthStatus::kCertain) << scene.name;
      EXPECT_NEAR(cold.upper_bound, warm.upper_bound, 1e-6);
    }
  }
}

}  // namespace
}  // namespace touchstone
