// SPDX-License-Identifier: MIT
#include <array>
#include <cassert>
#include <cmath>

#include "touchstone/tools/suites/arithmetic.h"
#include "touchstone/tools/suites/recent_cache.h"
#include "touchstone/tools/suites/registry.h"
#include "touchstone/tools/suites/shapes.h"

namespace touchstone {
namespace {

constexpr std::uint64_t kIndicesPerPair = 80;
constexpr std::array<int, 6> kCounts = {4, 8, 14, 30, 60, 120};
constexpr std::array<double, 6> kTurns = {0.0, 1e-15, 1e-12, 1e-9, 1e-6, 1e-2};

struct Bodies {
  ConvexPolyhedron p, q;
};

class NestedSuite : public Suite {
 public:
  std::string_view name() const override { return "nested"; }
  std::string_view summary() const override {
    return "one body inside the other, at its middle or against its wall; the same body twice, "
           "turned and moved by next to nothing, or beside itself";
  }
  std::string_view attacks() const override {
    return "c at o and next to it, where the ray has no direction; depths of many equal faces";
  }

  PlacedPair Generate(std::uint64_t seed, std::uint64_t index) const override {
    thread_local RecentCache<Bodies> cache;
    const std::uint64_t number = index / kIndicesPerPair;
    const Bodies& bodies = cache.Get(name(), seed, number, [&] {
      Random random(name(), seed, 2 * number);
      const double aspect = random.OneIn(2) ? 1.0 : 5.0;
      ConvexPolyhedron p =
          EllipsoidBody(random, random.Pick(kCounts), {100.0 * aspect, 100.0, 100.0});
      const double size = random.OneIn(2) ? 10.0 : 0.1;
      ConvexPolyhedron q = EllipsoidBody(random, random.Pick(kCounts), {size, size, size});
      return Bodies{std::move(p), std::move(q)};
    });
    Random random(name(), seed, 2 * index + 1);
    return index % 2 == 0 ? Twice(random, bodies.p) : Inside(random, bodies);
  }

 private:
  // A rotation by next to nothing about a random axis, to first order.
  static Eigen::Matrix3d SmallTurn(Random& random) {
    const Eigen::Vector3d axis = random.SpherePoint();
    const Eigen::Vector3d w = random.Pick(kTurns) * 0.1 * axis;
    Eigen::Matrix3d r = Eigen::Matrix3d::Identity();
    // To second order, so that the largest is orthonormal to 1e-9.
    const double half = 0.5 * PlainDot(w, w);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) r(i, j) += 0.5 * w[i] * w[j] - (i == j ? half : 0.0);
    }
    r(0, 1) -= w[2], r(1, 0) += w[2];
    r(0, 2) += w[1], r(2, 0) -= w[1];
    r(1, 2) -= w[0], r(2, 1) += w[0];
    return r;
  }

  static RelativePose Pose(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation) {
    StatusOr<RelativePose> pose = RelativePose::Make(rotation, translation);
    assert(pose.ok());
    return *pose;
  }

  static PlacedPair Twice(Random& random, const ConvexPolyhedron& body) {
    const Eigen::Matrix3d rotation = SmallTurn(random);
    static constexpr std::array<double, 8> kMoves = {0.0,  0x1p-50, 1e-12, 1e-9,
                                                     1e-3, 1.0,     150.0, 1e3};
    const double move = random.Pick(kMoves);
    return {body, body, Pose(rotation, move * random.SpherePoint())};
  }

  // Q's middle at a part of the way from P's middle to a corner; at 1 or so it pokes out there.
  static PlacedPair Inside(Random& random, const Bodies& bodies) {
    const Eigen::Matrix3d rotation = random.Rotation();
    const Eigen::Vector3d middle = PlainMean(bodies.p.vertices());
    const Eigen::Vector3d corner = bodies.p.vertex(random.Integer(0, bodies.p.vertex_count() - 1));
    static constexpr std::array<double, 9> kParts = {0.0,  1e-12, 1e-3, 0.5, 0.9,
                                                     0.99, 1.0,   1.1,  1.5};
    const double part = random.Pick(kParts);
    Eigen::Vector3d at;
    for (int i = 0; i < 3; ++i) at[i] = middle[i] + part * (corner[i] - middle[i]);
    return {bodies.p, bodies.q,
            Pose(rotation, at - PlainRotate(rotation, PlainMean(bodies.q.vertices())))};
  }
};

}  // namespace

std::unique_ptr<Suite> MakeNestedSuite() { return std::make_unique<NestedSuite>(); }

}  // namespace touchstone
