// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>

#include "touchstone/tools/suites/line_suite.h"
#include "touchstone/tools/suites/registry.h"
#include "touchstone/tools/suites/shapes.h"

namespace touchstone {
namespace {

constexpr std::array<double, 6> kBulges = {0x1p-50, 0x1p-45, 1e-12, 1e-10, 1e-8, 1e-5};

// A cube whose faces are bulged by a tiny paraboloid over a grid: hundreds of facets, each nearly
// in its neighbour's plane.
ConvexPolyhedron BulgedCube(Random& random) {
  const double bulge = random.Pick(kBulges);
  const int cells = random.Integer(2, 5);
  for (;;) {
    std::vector<Eigen::Vector3d> points;
    for (int axis = 0; axis < 3; ++axis) {
      for (const double side : {-1.0, 1.0}) {
        for (int i = 0; i <= cells; ++i) {
          for (int j = 0; j <= cells; ++j) {
            const double u = 2.0 * i / cells - 1.0;
            const double v = 2.0 * j / cells - 1.0;
            Eigen::Vector3d point;
            point[axis] = side * (1.0 + bulge * ((1.0 - u * u) + (1.0 - v * v)));
            point[(axis + 1) % 3] = u;
            point[(axis + 2) % 3] = v;
            points.push_back(point);
          }
        }
      }
    }
    StatusOr<ConvexPolyhedron> body = HullBody(points, FacetStyle::kMerged);
    if (body.ok()) return *body;
  }
}

// A ball's cap of points on an enormous sphere, closed below by one point.
ConvexPolyhedron FlatCap(Random& random) {
  const double curvature = random.Pick(kBulges);
  const int count = random.Integer(6, 60);
  for (;;) {
    std::vector<Eigen::Vector3d> points = {{0.0, 0.0, -1.0}};
    for (int i = 0; i < count; ++i) {
      const double x = random.Uniform(-1.0, 1.0);
      const double y = random.Uniform(-1.0, 1.0);
      points.emplace_back(x, y, -curvature * (x * x + y * y));
    }
    StatusOr<ConvexPolyhedron> body = HullBody(points, FacetStyle::kMerged);
    if (body.ok()) return *body;
  }
}

class CoplanarSuite : public LineSuite {
 public:
  std::string_view name() const override { return "near-coplanar"; }
  std::string_view summary() const override {
    return "bulged cubes and flat caps: neighbouring facets within 1e-15 to 1e-5 of one plane";
  }
  std::string_view attacks() const override {
    return "climbs that stop on a plateau; arcs of the Gauss map of almost no length";
  }

 protected:
  Pair MakePair(Random& random) const override {
    const auto make = [&] { return random.OneIn(2) ? BulgedCube(random) : FlatCap(random); };
    ConvexPolyhedron p = make();
    return {std::move(p), make()};
  }
  // Flat on flat, half of the time.
  Eigen::Matrix3d MakeRotation(Random& random) const override {
    return random.OneIn(2) ? random.AxisRotation() : random.Rotation();
  }
};

}  // namespace

std::unique_ptr<Suite> MakeCoplanarSuite() { return std::make_unique<CoplanarSuite>(); }

}  // namespace touchstone
