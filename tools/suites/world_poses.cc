// SPDX-License-Identifier: MIT
#include <array>
#include <cassert>

#include "touchstone/tools/suites/arithmetic.h"
#include "touchstone/tools/suites/line_suite.h"
#include "touchstone/tools/suites/registry.h"
#include "touchstone/tools/suites/shapes.h"

namespace touchstone {
namespace {

constexpr std::array<int, 5> kCounts = {4, 8, 20, 50, 100};
constexpr std::array<double, 4> kDistances = {0.0, 1.0, 1e3, 1e7};

class WorldPosesSuite : public LineSuite {
 public:
  std::string_view name() const override { return "world-poses"; }
  std::string_view summary() const override {
    return "bodies placed in the world by a pose each, up to 1e5 sizes from its origin";
  }
  std::string_view attacks() const override {
    return "the rounding of the relative pose: the truth is that of both exact images";
  }

 protected:
  Pair MakePair(Random& random) const override {
    const Eigen::Vector3d axes(200.0, 100.0, 100.0);
    ConvexPolyhedron p = EllipsoidBody(random, random.Pick(kCounts), axes);
    return {std::move(p), EllipsoidBody(random, random.Pick(kCounts), axes)};
  }

  // The world is the frame in which P's pose is (r, t), and Q's what follows, rounded.
  PlacedPair Finish(PlacedPair pair, Random& block, Random& index) const override {
    WorldPose p, q;
    p.rotation = block.OneIn(3) ? block.AxisRotation() : block.Rotation();
    p.translation = index.Pick(kDistances) * index.SpherePoint();
    for (int j = 0; j < 3; ++j) {
      const Eigen::Vector3d column = PlainRotate(p.rotation, pair.pose.rotation().col(j));
      for (int i = 0; i < 3; ++i) q.rotation(i, j) = column[i];
    }
    const Eigen::Vector3d moved = PlainRotate(p.rotation, pair.pose.translation());
    for (int i = 0; i < 3; ++i) q.translation[i] = moved[i] + p.translation[i];
    const StatusOr<RelativePose> pose = RelativePose::FromWorld(p, q);
    assert(pose.ok());
    return {pair.p, pair.q, *pose};
  }
};

}  // namespace

std::unique_ptr<Suite> MakeWorldPosesSuite() { return std::make_unique<WorldPosesSuite>(); }

}  // namespace touchstone
