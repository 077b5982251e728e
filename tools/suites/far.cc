// SPDX-License-Identifier: MIT
#include <array>

#include "touchstone/tools/suites/line_suite.h"
#include "touchstone/tools/suites/registry.h"
#include "touchstone/tools/suites/shapes.h"

namespace touchstone {
namespace {

constexpr std::array<double, 3> kOffsets = {1e4, 1e6, 1e8};
constexpr std::array<int, 5> kCounts = {4, 8, 14, 30, 80};

// A hull of points about `center`, where the coordinates of doubles are coarse.
ConvexPolyhedron BodyAt(Random& random, const Eigen::Vector3d& center) {
  const int count = random.Pick(kCounts);
  for (;;) {
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < count; ++i) points.push_back(center + random.SpherePoint());
    StatusOr<ConvexPolyhedron> body = HullBody(points, FacetStyle::kMerged);
    if (body.ok()) return *body;
  }
}

class FarSuite : public LineSuite {
 public:
  std::string_view name() const override { return "far"; }
  std::string_view summary() const override {
    return "unit bodies whose coordinates are 1e4 to 1e8 from the origin, each in its own frame";
  }
  std::string_view attacks() const override {
    return "cancellation: the size of the coordinates is not the size of the bodies";
  }

 protected:
  Pair MakePair(Random& random) const override {
    const double offset = random.Pick(kOffsets);
    const Eigen::Vector3d p = offset * random.SpherePoint();
    const Eigen::Vector3d q =
        random.OneIn(3) ? Eigen::Vector3d::Zero() : Eigen::Vector3d(offset * random.SpherePoint());
    ConvexPolyhedron body_p = BodyAt(random, p);
    return {std::move(body_p), BodyAt(random, q)};
  }
};

}  // namespace

std::unique_ptr<Suite> MakeFarSuite() { return std::make_unique<FarSuite>(); }

}  // namespace touchstone
