// SPDX-License-Identifier: MIT
#include <array>
#include <vector>

#include "touchstone/tools/suites/lattice_contact.h"
#include "touchstone/tools/suites/registry.h"
#include "touchstone/tools/suites/shapes.h"

namespace touchstone {
namespace {

class GridSuite : public LatticeContactSuite {
 public:
  std::string_view name() const override { return "grid"; }
  std::string_view summary() const override {
    return "hulls of integer grid points and of grid balls, facets merged or triangulated";
  }
  std::string_view attacks() const override {
    return "many coplanar and parallel faces: ties in every comparison, zero-length arcs";
  }

 protected:
  ConvexPolyhedron MakeBody(Random& random) const override {
    for (;;) {
      const std::vector<Eigen::Vector3d> points = random.OneIn(4) ? Ball(random) : Cloud(random);
      const FacetStyle style = random.OneIn(2) ? FacetStyle::kMerged : FacetStyle::kTriangulated;
      StatusOr<ConvexPolyhedron> body = HullBody(points, style);
      if (body.ok()) return *body;  // flat clouds are drawn again
    }
  }
  bool Wants(int, int) const override { return true; }

 private:
  static std::vector<Eigen::Vector3d> Cloud(Random& random) {
    static constexpr std::array<int, 5> kExtents = {1, 2, 3, 5, 9};
    const int extent = random.Pick(kExtents);
    const int count = random.Integer(5, 60);
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < count; ++i) {
      Eigen::Vector3d point;
      for (int k = 0; k < 3; ++k) point[k] = random.Integer(-extent, extent);
      points.push_back(point);
    }
    return points;
  }

  // Every grid point of a ball: 50 to 250 corners.
  static std::vector<Eigen::Vector3d> Ball(Random& random) {
    const int radius = random.Integer(4, 13);
    const int squared = radius * radius + random.Integer(0, radius);
    std::vector<Eigen::Vector3d> points;
    for (int x = -radius; x <= radius; ++x) {
      for (int y = -radius; y <= radius; ++y) {
        // The outermost of each column suffice.
        int z = 0;
        while (x * x + y * y + (z + 1) * (z + 1) <= squared) ++z;
        if (x * x + y * y + z * z > squared) continue;
        points.emplace_back(x, y, z);
        points.emplace_back(x, y, -z);
      }
    }
    return points;
  }
};

}  // namespace

std::unique_ptr<Suite> MakeGridSuite() { return std::make_unique<GridSuite>(); }

}  // namespace touchstone
