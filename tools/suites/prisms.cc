// SPDX-License-Identifier: MIT
#include <array>

#include "touchstone/tools/suites/lattice_contact.h"
#include "touchstone/tools/suites/registry.h"
#include "touchstone/tools/suites/shapes.h"

namespace touchstone {
namespace {

class PrismSuite : public LatticeContactSuite {
 public:
  std::string_view name() const override { return "prisms"; }
  std::string_view summary() const override {
    return "prisms, antiprisms, bipyramids on 3 to 108 cocircular points in exact contact, flat to "
           "long";
  }
  std::string_view attacks() const override {
    return "large polygons, vertices of high degree, parallel faces and edges at exact contact";
  }

 protected:
  ConvexPolyhedron MakeBody(Random& random) const override {
    static constexpr std::array<int, 11> kCorners = {3, 4, 5, 6, 7, 12, 20, 30, 60, 100, 108};
    const int corners = random.Pick(kCorners);
    const std::vector<Eigen::Vector2d> polygon = LatticePolygon(random, corners);
    static constexpr std::array<int, 5> kHeights = {1, 4, 20, 150, 1000};
    const double height = random.Pick(kHeights);
    const FacetStyle style = random.OneIn(4) ? FacetStyle::kTriangulated : FacetStyle::kMerged;
    switch (random.Integer(0, 3)) {
      case 0:
        return PrismBody(polygon, height, true, style);
      case 1:
        return BipyramidBody(polygon, height, style);
      default:
        return PrismBody(polygon, height, false, style);
    }
  }
  bool Wants(int, int) const override { return true; }
};

}  // namespace

std::unique_ptr<Suite> MakePrismsSuite() { return std::make_unique<PrismSuite>(); }

}  // namespace touchstone
