// SPDX-License-Identifier: MIT
#include <array>
#include <cassert>
#include <cmath>
#include <optional>

#include "touchstone/tools/suites/line_suite.h"
#include "touchstone/tools/suites/registry.h"
#include "touchstone/tools/suites/shapes.h"

namespace touchstone {
namespace {

constexpr std::array<int, 5> kCounts = {4, 8, 20, 50, 100};
// Coordinates of 1 to 1000 times 2^-331 to 2^321 reach from 1e-100 to 1e100.
constexpr int kLeastExponent = -331, kMostExponent = 321;

// Scaled by a power of two, so that the question is the same, bit for bit, and so is the answer.
class ScalesSuite : public LineSuite {
 public:
  std::string_view name() const override { return "scales"; }
  std::string_view summary() const override {
    return "hulls of 4 to 100 points at sizes from 1e-100 to 1e100, up to 1e6 between the two";
  }
  std::string_view attacks() const override {
    return "overflow and underflow of products; constants that are lengths in disguise";
  }

 protected:
  Pair MakePair(Random& random) const override {
    const double aspect = random.OneIn(2) ? 1.0 : 8.0;
    const double ratio = random.OneIn(2) ? 1.0 : std::ldexp(1.0, -random.Integer(1, 20));
    const Eigen::Vector3d axes(100.0 * aspect, 100.0, 100.0);
    ConvexPolyhedron p = EllipsoidBody(random, random.Pick(kCounts), axes);
    ConvexPolyhedron q = EllipsoidBody(random, random.Pick(kCounts), axes);
    StatusOr<ConvexPolyhedron> small =
        MapBody(q, [&](const Eigen::Vector3d& v) { return Eigen::Vector3d(ratio * v); });
    assert(small.ok());
    if (random.OneIn(2)) return {std::move(*small), std::move(p)};
    return {std::move(p), std::move(*small)};
  }

  PlacedPair Finish(PlacedPair pair, Random& block, Random&) const override {
    // Where one body is the smaller, its size keeps to the least, too.
    const double scale = std::ldexp(1.0, block.Integer(kLeastExponent + 20, kMostExponent));
    thread_local std::optional<Scaled> recent;
    if (!recent || recent->scale != scale ||
        recent->of.vertices().data() != pair.p.vertices().data()) {
      recent.emplace(Scaled{scale, pair.p, Scale(pair.p, scale), Scale(pair.q, scale)});
    }
    const StatusOr<RelativePose> pose =
        RelativePose::Make(pair.pose.rotation(), scale * pair.pose.translation());
    assert(pose.ok());
    return {recent->p, recent->q, *pose};
  }

 private:
  struct Scaled {
    double scale;
    ConvexPolyhedron of, p, q;  // P unscaled, held alive; both scaled
  };

  static ConvexPolyhedron Scale(const ConvexPolyhedron& body, double scale) {
    StatusOr<ConvexPolyhedron> scaled =
        MapBody(body, [&](const Eigen::Vector3d& v) { return Eigen::Vector3d(scale * v); });
    assert(scaled.ok());
    return *scaled;
  }
};

}  // namespace

std::unique_ptr<Suite> MakeScalesSuite() { return std::make_unique<ScalesSuite>(); }

}  // namespace touchstone
