// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "touchstone/core/convex/support.h"
#include "touchstone/exact/decide.h"
#include "touchstone/tools/engines/enhanced_gjk.h"
#include "touchstone/tools/engines/registry.h"
#include "touchstone/tools/engines/scan_support.h"
#include "touchstone/tools/suites/placement.h"
#include "touchstone/tools/suites/random.h"
#include "touchstone/tools/suites/shapes.h"

namespace touchstone {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

std::vector<EngineDescription> AvailableEngines() {
  std::vector<EngineDescription> engines = AllEngines();
  std::erase_if(engines, [](const EngineDescription& e) { return !e.unavailable.empty(); });
  return engines;
}

// A placed pair in one engine, with what must stay alive for it.
struct Placed {
  Placed(const Engine& engine, const ConvexPolyhedron& p, const ConvexPolyhedron& q,
         const RelativePose& pose)
      : shape_p(engine.Prepare(p)), shape_q(engine.Prepare(q)) {
    pair = engine.Place(*shape_p, *shape_q, pose);
  }
  std::unique_ptr<EngineShape> shape_p, shape_q;
  std::unique_ptr<EnginePair> pair;
};

RelativePose Pose(const Matrix3d& rotation, const Vector3d& translation) {
  return *RelativePose::Make(rotation, translation);
}

TEST(Engines, NamesAreDistinctAndTolerancesListed) {
  std::set<std::string> names;
  for (const EngineDescription& engine : AllEngines()) {
    EXPECT_TRUE(names.insert(engine.name).second) << engine.name;
    EXPECT_FALSE(engine.summary.empty()) << engine.name;
    if (!engine.unavailable.empty()) continue;
    ASSERT_NE(engine.make, nullptr) << engine.name;
    if (engine.tolerances.empty()) continue;
    for (const double tolerance : {engine.default_tolerance, engine.best_tolerance}) {
      EXPECT_NE(std::find(engine.tolerances.begin(), engine.tolerances.end(), tolerance),
                engine.tolerances.end())
          << engine.name << ' ' << tolerance;
    }
  }
  EXPECT_TRUE(names.contains("portal"));
  EXPECT_TRUE(names.contains("enhanced-gjk"));
}

// An adapter that swaps the bodies, transposes a rotation or negates a translation fails here: the
// boxes are long, and the poses are neither symmetric nor their own inverses.
TEST(Engines, AnswerClearPairsOfBoxesRightly) {
  const ConvexPolyhedron p = BoxBody({4, 1, 1});
  const ConvexPolyhedron q = BoxBody({6, 1, 2}, FacetStyle::kTriangulated);
  Matrix3d quarter;
  quarter << 0, -1, 0, 1, 0, 0, 0, 0, 1;  // x to y: Q's long side along P's y
  struct Case {
    Matrix3d rotation;
    Vector3d translation;
    Verdict truth;
  };
  const std::vector<Case> cases = {
      {Matrix3d::Identity(), {9.5, 0, 0}, Verdict::kOverlap},
      {Matrix3d::Identity(), {10.5, 0, 0}, Verdict::kSeparate},
      {Matrix3d::Identity(), {0, -2.5, 0}, Verdict::kSeparate},
      {quarter, {5.5, 0, 0}, Verdict::kSeparate},
      {quarter, {4.5, 6.5, 0}, Verdict::kOverlap},
      {quarter, {-4.5, 7.5, 0}, Verdict::kSeparate},
      {quarter, {0, 0, 2.5}, Verdict::kOverlap},
      {quarter, {0, 0, -3.5}, Verdict::kSeparate},
  };
  for (const EngineDescription& description : AvailableEngines()) {
    for (const double tolerance : {description.default_tolerance, description.best_tolerance}) {
      const std::unique_ptr<Engine> engine = description.make(tolerance);
      for (const Case& c : cases) {
        const Placed placed(*engine, p, q, Pose(c.rotation, c.translation));
        EXPECT_EQ(placed.pair->Ask(nullptr), c.truth)
            << description.name << " at " << c.translation.transpose();
      }
    }
  }
}

// Engines without proofs may miss a verdict near contact; a gap of a tenth of the size is clear.
TEST(Engines, AgreeWithTheExactVerdictOnClearRandomPairs) {
  Random random("engines_test", 1, 0);
  std::vector<EngineDescription> descriptions = AvailableEngines();
  // Known to fail at any gap, and counted elsewhere for it.
  std::erase_if(descriptions, [](const auto& d) { return d.name == "published"; });
  int separate = 0, overlap = 0;
  for (int round = 0; round < 60; ++round) {
    const ConvexPolyhedron p = EllipsoidBody(random, random.Integer(8, 60), {200, 100, 50});
    const ConvexPolyhedron q = EllipsoidBody(random, random.Integer(8, 60), {100, 150, 100});
    const Matrix3d rotation = random.Rotation();
    const ContactLine line = FindContactLine(p, q, rotation, random.SpherePoint());
    for (const double travel : {-10.0, 10.0}) {
      const RelativePose pose = PoseAtTravel(line, travel);
      const Verdict truth = exact::Decide(p, q, pose).verdict;
      ++(truth == Verdict::kSeparate ? separate : overlap);
      for (const EngineDescription& description : descriptions) {
        const std::unique_ptr<Engine> engine = description.make(description.best_tolerance);
        const Placed placed(*engine, p, q, pose);
        EXPECT_EQ(placed.pair->Ask(nullptr), truth) << description.name << ", round " << round;
        // The same with a cache, empty and then filled.
        const std::unique_ptr<EngineCache> cache = engine->MakeCache();
        for (int frame = 0; frame < 2; ++frame) {
          EXPECT_EQ(placed.pair->Ask(cache.get()), truth)
              << description.name << ", round " << round << ", frame " << frame;
        }
      }
    }
  }
  EXPECT_EQ(separate, 60);
  EXPECT_EQ(overlap, 60);
}

TEST(Engines, MeasureKnownDistancesAndDepths) {
  const ConvexPolyhedron p = BoxBody({4, 1, 1});
  const ConvexPolyhedron q = BoxBody({2, 2, 2});
  int distances = 0, depths = 0, travels = 0;
  for (const EngineDescription& description : AvailableEngines()) {
    const std::unique_ptr<Engine> engine = description.make(description.best_tolerance);
    const Placed apart(*engine, p, q, Pose(Matrix3d::Identity(), {0, 5, 0.25}));
    const Placed deep(*engine, p, q, Pose(Matrix3d::Identity(), {0.5, 2.75, 0.125}));
    // Distances and depths of these engines are good to about 1e-4 at worst (EPA in Bullet).
    if (const auto distance = apart.pair->Measure(Quantity::kDistance)) {
      EXPECT_NEAR(distance->value, 2.0, 1e-3) << description.name;
      ++distances;
    }
    if (const auto depth = deep.pair->Measure(Quantity::kDepth)) {
      EXPECT_NEAR(depth->value, 0.25, 1e-3) << description.name;
      ++depths;
    }
    if (const auto travel = apart.pair->Measure(Quantity::kExitTravel)) {
      EXPECT_GT(travel->value, 0.0) << description.name;
      EXPECT_LT(deep.pair->Measure(Quantity::kExitTravel)->value, 0.0) << description.name;
      ++travels;
    }
    EXPECT_FALSE(apart.pair->Measure(Quantity::kDepth)) << description.name;
  }
  EXPECT_GE(travels, 3);    // our searches
  EXPECT_GE(distances, 1);  // enhanced GJK at least
}

// The two flavours of one library have the same names for different functions.
TEST(Engines, FlavoursOfBulletLiveInOneProcess) {
  const ConvexPolyhedron p = BoxBody({4, 1, 1});
  const ConvexPolyhedron q = BoxBody({2, 2, 2});
  const RelativePose pose = Pose(Matrix3d::Identity(), {0, 5 + 1e-9, 0.25});
  for (const EngineDescription& description : AvailableEngines()) {
    if (!description.name.starts_with("bullet")) continue;
    const std::unique_ptr<Engine> engine = description.make(0.0);
    const double distance = Placed(*engine, p, q, pose).pair->Measure(Quantity::kDistance)->value;
    const double error = std::fabs(distance - (2 + 1e-9));
    if (description.single_precision) {
      EXPECT_GT(error, 1e-10);  // half a unit in the last place of a float at 5 is 2.4e-7
    } else {
      EXPECT_LT(error, 1e-12);
    }
  }
}

TEST(IsWrong, HonoursTheConventionForTouch) {
  using Touch = TouchConvention;
  EXPECT_FALSE(IsWrong(Touch::kThreeWay, Verdict::kTouch, Verdict::kTouch));
  EXPECT_TRUE(IsWrong(Touch::kThreeWay, Verdict::kOverlap, Verdict::kTouch));
  EXPECT_TRUE(IsWrong(Touch::kThreeWay, Verdict::kSeparate, Verdict::kTouch));
  EXPECT_FALSE(IsWrong(Touch::kOverlap, Verdict::kOverlap, Verdict::kTouch));
  EXPECT_TRUE(IsWrong(Touch::kOverlap, Verdict::kSeparate, Verdict::kTouch));
  EXPECT_FALSE(IsWrong(Touch::kEither, Verdict::kSeparate, Verdict::kTouch));
  for (const Touch touch : {Touch::kThreeWay, Touch::kOverlap, Touch::kEither}) {
    EXPECT_TRUE(IsWrong(touch, Verdict::kSeparate, Verdict::kOverlap));
    EXPECT_TRUE(IsWrong(touch, Verdict::kOverlap, Verdict::kSeparate));
    EXPECT_FALSE(IsWrong(touch, Verdict::kUndecided, Verdict::kSeparate));
  }
}

TEST(ScanSupport, FindsAVertexAsHighAsThePlainScan) {
  Random random("scan_support", 1, 0);
  for (const int n : {4, 7, 8, 9, 15, 16, 17, 24, 25, 100, 333}) {
    const ConvexPolyhedron body = EllipsoidBody(random, n, {3, 2, 1});
    const ScanSupport scan(body);
    for (int i = 0; i < 200; ++i) {
      const Vector3d direction = random.SpherePoint();
      const int plain = SupportVertexByScan(body, direction);
      EXPECT_NEAR(direction.dot(body.vertex(scan.Find(direction))),
                  direction.dot(body.vertex(plain)), 1e-15 * body.max_coordinate())
          << n;
    }
    const int any = scan.Find(Vector3d::Constant(std::nan("")));
    EXPECT_TRUE(any >= 0 && any < body.vertex_count());
  }
}

TEST(EnhancedGjk, DistanceIsConvergedAndSymmetric) {
  Random random("enhanced_gjk", 1, 0);
  const GjkOptions options{.tolerance = 1e-12, .want_distance = true};
  for (int round = 0; round < 40; ++round) {
    const ConvexPolyhedron p = EllipsoidBody(random, 40, {2, 1, 1});
    const ConvexPolyhedron q = EllipsoidBody(random, 40, {1, 1, 3});
    const Matrix3d rotation = random.Rotation();
    const RelativePose pose =
        PoseAtTravel(FindContactLine(p, q, rotation, random.SpherePoint()), 0.5);
    const GjkResult result = EnhancedGjk(p, q, pose, options);
    ASSERT_EQ(result.verdict, Verdict::kSeparate);
    EXPECT_LE(result.distance, 0.5 + 1e-12);
    const RelativePose inverse =
        Pose(rotation.transpose(), -(rotation.transpose() * pose.translation()));
    EXPECT_NEAR(EnhancedGjk(q, p, inverse, options).distance, result.distance, 1e-10);
  }
}

}  // namespace
}  // namespace touchstone
