// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <limits>

#include "touchstone/tools/suites/line_suite.h"
#include "touchstone/tools/suites/registry.h"
#include "touchstone/tools/suites/shapes.h"

namespace touchstone {
namespace {

constexpr std::array<int, 5> kCounts = {4, 8, 20, 50, 100};

ConvexPolyhedron LatticeHull(Random& random) {
  for (;;) {
    std::vector<Eigen::Vector3d> points;
    const int count = random.Integer(5, 40);
    for (int i = 0; i < count; ++i) {
      Eigen::Vector3d point;
      for (int k = 0; k < 3; ++k) point[k] = random.Integer(-4, 4);
      points.push_back(point);
    }
    StatusOr<ConvexPolyhedron> body = HullBody(points, FacetStyle::kMerged);
    if (body.ok()) return *body;
  }
}

class OffOrthonormalSuite : public LineSuite {
 public:
  std::string_view name() const override { return "off-orthonormal"; }
  std::string_view summary() const override {
    return "rotations off orthonormal by an ulp an entry, by 1e-12 and by 3e-7";
  }
  std::string_view attacks() const override {
    return "the transpose taken for the inverse; normals turned by R where its cofactors are due";
  }

 protected:
  Pair MakePair(Random& random) const override {
    const auto make = [&] {
      return random.OneIn(2) ? LatticeHull(random)
                             : EllipsoidBody(random, random.Pick(kCounts), {8.0, 4.0, 4.0});
    };
    ConvexPolyhedron p = make();
    return {std::move(p), make()};
  }

  Eigen::Matrix3d MakeRotation(Random& random) const override {
    Eigen::Matrix3d r = random.OneIn(2) ? random.AxisRotation() : random.Rotation();
    const int kind = random.Integer(0, 2);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        if (kind == 0) {
          const bool up = random.OneIn(2);
          const double limit = up ? 2.0 : -2.0;
          // A denormal is no ulp that anyone would feel.
          r(i, j) = r(i, j) == 0.0 ? (up ? 0x1p-53 : -0x1p-53) : std::nextafter(r(i, j), limit);
        } else {
          r(i, j) += random.Uniform(-1.0, 1.0) * (kind == 1 ? 1e-12 : 1e-7);
        }
      }
    }
    return r;
  }
};

}  // namespace

std::unique_ptr<Suite> MakeOffOrthonormalSuite() { return std::make_unique<OffOrthonormalSuite>(); }

}  // namespace touchstone
