// SPDX-License-Identifier: MIT
#include <array>
#include <cassert>
#include <vector>

#include "touchstone/tools/suites/arithmetic.h"
#include "touchstone/tools/suites/recent_cache.h"
#include "touchstone/tools/suites/registry.h"
#include "touchstone/tools/suites/shapes.h"

namespace touchstone {
namespace {

constexpr std::uint64_t kIndicesPerPair = 64;

struct Bodies {
  ConvexPolyhedron p, q;
};

RelativePose MakePose(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation) {
  StatusOr<RelativePose> pose = RelativePose::Make(rotation, translation);
  assert(pose.ok());
  return *pose;
}

// Bodies symmetric about the origin, so that with Q moved by t the line from the middle of M (at
// -t) through o is the line through t: aimed at vertices, edges and faces of M by choice of t.
class TiesSuite : public Suite {
 public:
  std::string_view name() const override { return "ties"; }
  std::string_view summary() const override {
    return "the ray through a vertex or an edge of M, c = o, the same body twice, deep containment";
  }
  std::string_view attacks() const override {
    return "searches that need the exit face to be unique, or c to differ from o";
  }

  PlacedPair Generate(std::uint64_t seed, std::uint64_t index) const override {
    thread_local RecentCache<Bodies> cache;
    const std::uint64_t number = index / kIndicesPerPair;
    const Bodies& bodies = cache.Get(name(), seed, number, [&] {
      Random random(name(), seed, 2 * number);
      ConvexPolyhedron p = Symmetric(random);
      ConvexPolyhedron q = Symmetric(random);
      return Bodies{std::move(p), std::move(q)};
    });
    Random random(name(), seed, 2 * index + 1);
    switch (index % 8) {
      case 0:
        return Twice(random, bodies.p);
      case 1:
        return {bodies.p, bodies.q, MakePose(random.AxisRotation(), Eigen::Vector3d::Zero()),
                Verdict::kOverlap};
      case 2:
        return Contained(random, bodies.p);
      default:
        return Aimed(random, bodies);
    }
  }

 private:
  static ConvexPolyhedron Symmetric(Random& random) {
    const FacetStyle style = random.OneIn(3) ? FacetStyle::kTriangulated : FacetStyle::kMerged;
    switch (random.Integer(0, 3)) {
      case 0:
        return BoxBody(
            {1.0 * random.Integer(1, 8), 1.0 * random.Integer(1, 8), 1.0 * random.Integer(1, 8)},
            style);
      case 1: {
        const double x = random.Integer(1, 8);
        const double y = random.Integer(1, 8);
        const std::vector<Eigen::Vector2d> diamond = {{x, 0.0}, {0.0, y}, {-x, 0.0}, {0.0, -y}};
        return BipyramidBody(diamond, random.Integer(1, 8), style);
      }
      case 2: {
        const int radius = random.OneIn(2) ? 12 : 20;
        const std::vector<Eigen::Vector2d> circle =
            LatticePolygon(random, radius);  // all points of a circle
        return PrismBody(circle, random.Integer(1, 30), false, style);
      }
      default:
        return MirroredCloud(random, style);
    }
  }

  static ConvexPolyhedron MirroredCloud(Random& random, FacetStyle style) {
    for (;;) {
      std::vector<Eigen::Vector3d> points;
      const int count = random.Integer(3, 60);
      const int extent = random.OneIn(2) ? 4 : 60;
      for (int i = 0; i < count; ++i) {
        Eigen::Vector3d point;
        for (int k = 0; k < 3; ++k) point[k] = random.Integer(-extent, extent);
        points.push_back(point);
        points.push_back(-point);
      }
      StatusOr<ConvexPolyhedron> body = HullBody(points, style);
      if (body.ok()) return *body;
    }
  }

  // The same body, moved not at all, by an ulp, or by its own coordinates.
  static PlacedPair Twice(Random& random, const ConvexPolyhedron& body) {
    const Eigen::Matrix3d rotation =
        random.OneIn(2) ? Eigen::Matrix3d::Identity() : random.AxisRotation();
    Eigen::Vector3d translation = Eigen::Vector3d::Zero();
    switch (random.Integer(0, 2)) {
      case 0:
        break;
      case 1:
        translation[random.Integer(0, 2)] = random.OneIn(2) ? 0x1p-50 : -0x1p-50;
        break;
      default:
        translation = body.vertex(random.Integer(0, body.vertex_count() - 1));
        break;
    }
    return {body, body, MakePose(rotation, translation)};
  }

  // A small box well inside: near the middle, or anywhere a mixture of two corners leads.
  static PlacedPair Contained(Random& random, const ConvexPolyhedron& body) {
    static const ConvexPolyhedron kSmall = BoxBody({1.0, 1.0, 1.0});
    const Eigen::Matrix3d rotation = random.AxisRotation();
    const Eigen::Vector3d& a = body.vertex(random.Integer(0, body.vertex_count() - 1));
    const Eigen::Vector3d& b = body.vertex(random.Integer(0, body.vertex_count() - 1));
    Eigen::Vector3d translation;
    for (int i = 0; i < 3; ++i) translation[i] = 0.375 * a[i] + 0.375 * b[i];
    const PlacedPair in{body, kSmall, MakePose(rotation, translation), Verdict::kOverlap};
    if (random.OneIn(2)) return in;
    // Seen from the small body: R and t inverted, exactly.
    const Eigen::Matrix3d back = rotation.transpose();
    return {kSmall, body, MakePose(back, -PlainRotate(back, translation)), Verdict::kOverlap};
  }

  // t at a vertex of M or between two of them, or shorter or longer by dyadic factors and ulps.
  static PlacedPair Aimed(Random& random, const Bodies& bodies) {
    const Eigen::Matrix3d rotation = random.AxisRotation();
    const Eigen::Vector3d direction = random.SpherePoint();
    Eigen::Vector3d target = Extreme(bodies, rotation, direction);
    if (random.OneIn(2)) {
      // Towards another vertex nearby: often an edge's middle, or a point of a face.
      const Eigen::Vector3d turned = direction + 0.5 * random.SpherePoint();
      target = (target + Extreme(bodies, rotation, turned)) / 2.0;
    }
    static constexpr std::array<double, 8> kFactors = {1.0,     1.0,     1.0, 0.5,
                                                       0.96875, 1.03125, 2.0, 0x1p-40};
    Eigen::Vector3d translation;
    const double factor = random.Pick(kFactors);
    for (int i = 0; i < 3; ++i) translation[i] = target[i] * factor;
    if (random.OneIn(4)) {
      const int axis = LongestAxis(translation);
      translation[axis] =
          StepUlp(translation[axis], random.OneIn(2), PlainMaxCoordinate(bodies.p.vertices()));
    }
    return {bodies.p, bodies.q, MakePose(rotation, translation)};
  }

  // The vertex of M that is extreme along `direction`.
  static Eigen::Vector3d Extreme(const Bodies& bodies, const Eigen::Matrix3d& rotation,
                                 const Eigen::Vector3d& direction) {
    const Eigen::Vector3d* best_p = nullptr;
    for (const Eigen::Vector3d& v : bodies.p.vertices()) {
      if (best_p == nullptr || PlainDot(direction, v) > PlainDot(direction, *best_p)) best_p = &v;
    }
    Eigen::Vector3d best_q = PlainRotate(rotation, bodies.q.vertex(0));
    for (const Eigen::Vector3d& w : bodies.q.vertices()) {
      const Eigen::Vector3d rotated = PlainRotate(rotation, w);
      if (PlainDot(direction, rotated) < PlainDot(direction, best_q)) best_q = rotated;
    }
    return *best_p - best_q;
  }
};

}  // namespace

std::unique_ptr<Suite> MakeTiesSuite() { return std::make_unique<TiesSuite>(); }

}  // namespace touchstone
