// SPDX-License-Identifier: MIT
#include <array>

#include "touchstone/tools/suites/arithmetic.h"
#include "touchstone/tools/suites/line_suite.h"
#include "touchstone/tools/suites/registry.h"
#include "touchstone/tools/suites/shapes.h"

namespace touchstone {
namespace {

constexpr std::array<double, 4> kSteps = {1e-12, 1e-9, 1e-6, 1e-3};

// Points on a sphere of radius 100, each with companions a few ulps, or up to 1e-3, away.
ConvexPolyhedron Clustered(Random& random) {
  const int count = random.Integer(4, 20);
  const int companions = random.Integer(1, 4);
  for (;;) {
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < count; ++i) {
      const Eigen::Vector3d point = 100.0 * random.SpherePoint();
      points.push_back(point);
      for (int k = 0; k < companions; ++k) {
        Eigen::Vector3d near = point;
        if (random.OneIn(2)) {
          for (int c = 0; c < 3; ++c) {
            for (int step = random.Integer(0, 3); step > 0; --step)
              near[c] = StepUlp(near[c], point[c] > 0.0, 1.0);
          }
        } else {
          const Eigen::Vector3d direction = random.SpherePoint();
          near += random.Pick(kSteps) * direction;
        }
        points.push_back(near);
      }
    }
    StatusOr<ConvexPolyhedron> body = HullBody(points, FacetStyle::kMerged);
    if (body.ok()) return *body;
  }
}

class DuplicatesSuite : public LineSuite {
 public:
  std::string_view name() const override { return "near-duplicates"; }
  std::string_view summary() const override {
    return "hulls of 8 to 100 points in clusters one ulp to 1e-3 wide";
  }
  std::string_view attacks() const override {
    return "edges of a few ulps: lengths and normals that are mostly rounding";
  }

 protected:
  Pair MakePair(Random& random) const override {
    ConvexPolyhedron p = Clustered(random);
    return {std::move(p), Clustered(random)};
  }
};

}  // namespace

std::unique_ptr<Suite> MakeDuplicatesSuite() { return std::make_unique<DuplicatesSuite>(); }

}  // namespace touchstone
