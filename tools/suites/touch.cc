// SPDX-License-Identifier: MIT
//
//   here        meaning
//   R           a rotation rounded to multiples of 2^-22: orthonormal to 1e-6, and exact on the
//               lattice
//   P = R P0    the exact image of a lattice body, in doubles
#include <array>
#include <cassert>
#include <cmath>

#include "touchstone/tools/suites/arithmetic.h"
#include "touchstone/tools/suites/contact.h"
#include "touchstone/tools/suites/line_suite.h"
#include "touchstone/tools/suites/recent_cache.h"
#include "touchstone/tools/suites/registry.h"
#include "touchstone/tools/suites/shapes.h"

namespace touchstone {
namespace {

constexpr std::uint64_t kIndicesPerBodies = 3 * kContactOffsetCount;
// The first offsets of contact.h are the touch itself.
constexpr int kTouchOffsets = 10;
// Coordinates below 2^12, sixteenths of them, times multiples of 2^-22 and added up in threes: 12 +
// 4 + 22 + 2 bits, exact in doubles.
constexpr double kGrain = 0x1p22;

struct TouchClass {
  std::string_view name, summary;
  int dimension_p, dimension_q;
};
constexpr std::array<TouchClass, 6> kClasses = {{
    {"touch-face-vertex", "exact touches in oblique poses, a face of P on a vertex of Q", 2, 0},
    {"touch-vertex-face", "the same, a vertex of P on a face of Q", 0, 2},
    {"touch-edge-edge", "the same, an edge on an edge", 1, 1},
    {"touch-face-edge", "the same, a face of P on an edge of Q", 2, 1},
    {"touch-edge-face", "the same, an edge of P on a face of Q", 1, 2},
    {"touch-face-face", "the same, a face on a face", 2, 2},
}};

struct Bodies {
  ConvexPolyhedron p0, q, p;
  Eigen::Matrix3d grain;  // R
};

class TouchSuite : public Suite {
 public:
  explicit TouchSuite(const TouchClass& touch_class) : class_(touch_class) {}

  std::string_view name() const override { return class_.name; }
  std::string_view summary() const override { return class_.summary; }
  std::string_view attacks() const override {
    return "touch without an axis to lean on: no double is round, and yet nothing is rounded";
  }

  // The lattice contact P0, Q, (A, t) seen in a frame turned by R: P = R P0 and the pose (R A, R t)
  // ask the same question. What is moved off the contact is rounded, and its verdict the judge's.
  PlacedPair Generate(std::uint64_t seed, std::uint64_t index) const override {
    thread_local RecentCache<Bodies> cache;
    const std::uint64_t number = index / kIndicesPerBodies;
    const Bodies& bodies = cache.Get(name(), seed, number, [&] {
      Random random(name(), seed, 2 * number);
      return MakeBodies(random);
    });
    Random random(name(), seed, 2 * index + 1);
    const Eigen::Matrix3d axes = random.AxisRotation();
    const ContactFeatures contact = DrawContact(
        random, bodies.p0, bodies.q, axes,
        [this](int p, int q) { return p == class_.dimension_p && q == class_.dimension_q; });
    const int offset = static_cast<int>(index % kContactOffsetCount);
    const PlacedPair lattice = PlaceAtContact(random, bodies.p0, bodies.q, axes, contact, offset);
    Eigen::Matrix3d rotation;
    for (int j = 0; j < 3; ++j) {
      const Eigen::Vector3d column = PlainRotate(bodies.grain, axes.col(j));
      for (int i = 0; i < 3; ++i) rotation(i, j) = column[i];
    }
    const StatusOr<RelativePose> pose =
        RelativePose::Make(rotation, PlainRotate(bodies.grain, lattice.pose.translation()));
    assert(pose.ok());
    PlacedPair pair{bodies.p, bodies.q, *pose};
    if (offset < kTouchOffsets) pair.expected = lattice.expected;
    return pair;
  }

 private:
  static Bodies MakeBodies(Random& random) {
    ConvexPolyhedron p0 = LatticeBody(random);
    ConvexPolyhedron q = random.OneIn(6) ? p0 : LatticeBody(random);
    Eigen::Matrix3d grain = random.Rotation();
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) grain(i, j) = std::nearbyint(grain(i, j) * kGrain) / kGrain;
    }
    StatusOr<ConvexPolyhedron> p =
        MapBody(p0, [&](const Eigen::Vector3d& v) { return PlainRotate(grain, v); });
    assert(p.ok());
    return {std::move(p0), std::move(q), *p, grain};
  }

  static ConvexPolyhedron LatticeBody(Random& random) {
    const FacetStyle style = random.OneIn(3) ? FacetStyle::kTriangulated : FacetStyle::kMerged;
    switch (random.Integer(0, 3)) {
      case 0:
        return BoxBody(
            {1.0 * random.Integer(1, 9), 1.0 * random.Integer(1, 9), 1.0 * random.Integer(1, 9)},
            style);
      case 1: {
        const std::vector<Eigen::Vector2d> polygon = LatticePolygon(random, random.Integer(3, 12));
        const bool anti = random.OneIn(2);
        return PrismBody(polygon, random.Integer(1, 40), anti, style);
      }
      case 2: {
        const std::vector<Eigen::Vector2d> polygon = LatticePolygon(random, random.Integer(3, 30));
        return BipyramidBody(polygon, random.Integer(1, 40), style);
      }
      default:
        return Cloud(random, style);
    }
  }

  static ConvexPolyhedron Cloud(Random& random, FacetStyle style) {
    const int extent = random.OneIn(2) ? 2 : 6;
    for (;;) {
      std::vector<Eigen::Vector3d> points;
      const int count = random.Integer(4, 40);
      for (int i = 0; i < count; ++i) {
        Eigen::Vector3d point;
        for (int k = 0; k < 3; ++k) point[k] = random.Integer(-extent, extent);
        points.push_back(point);
      }
      StatusOr<ConvexPolyhedron> body = HullBody(points, style);
      if (body.ok()) return *body;
    }
  }

  const TouchClass& class_;
};

}  // namespace

std::vector<std::unique_ptr<Suite>> MakeTouchSuites() {
  std::vector<std::unique_ptr<Suite>> suites;
  for (const TouchClass& touch_class : kClasses)
    suites.push_back(std::make_unique<TouchSuite>(touch_class));
  return suites;
}

}  // namespace touchstone
