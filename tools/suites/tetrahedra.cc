// SPDX-License-Identifier: MIT
#include <array>
#include <vector>

#include "touchstone/tools/suites/contact.h"
#include "touchstone/tools/suites/recent_cache.h"
#include "touchstone/tools/suites/registry.h"
#include "touchstone/tools/suites/shapes.h"

namespace touchstone {
namespace {

// A pair of tetrahedra serves 40 indices: half of them random small integer translations, as in the
// family where ties alone defeat the published search; half exact contacts and offsets from them.
constexpr std::uint64_t kIndicesPerPair = 2 * kContactOffsetCount;

struct Bodies {
  ConvexPolyhedron p, q;
};

class TetrahedraSuite : public Suite {
 public:
  std::string_view name() const override { return "tetrahedra"; }
  std::string_view summary() const override {
    return "tetrahedra of small integers, 1:1:1 to 40:3:3, moved by small integers or in exact "
           "contact";
  }
  std::string_view attacks() const override {
    return "the strict inequalities of the arc test: ties among very few faces";
  }

  PlacedPair Generate(std::uint64_t seed, std::uint64_t index) const override {
    thread_local RecentCache<Bodies> cache;
    const std::uint64_t number = index / kIndicesPerPair;
    const Eigen::Vector3i extents = Extents(number);
    const Bodies& bodies = cache.Get(name(), seed, number, [&] {
      Random random(name(), seed, 2 * number);
      return Bodies{Tetrahedron(random, extents), Tetrahedron(random, extents)};
    });
    Random random(name(), seed, 2 * index + 1);
    const Eigen::Matrix3d rotation =
        random.OneIn(2) ? Eigen::Matrix3d::Identity() : random.AxisRotation();
    const int step = static_cast<int>(index % kIndicesPerPair);
    if (step >= kContactOffsetCount) {
      const ContactFeatures contact =
          DrawContact(random, bodies.p, bodies.q, rotation, [](int, int) { return true; });
      return PlaceAtContact(random, bodies.p, bodies.q, rotation, contact,
                            step - kContactOffsetCount);
    }
    Eigen::Vector3d translation;
    for (int i = 0; i < 3; ++i) translation[i] = random.Integer(-extents[i], extents[i]);
    return {bodies.p, bodies.q, *RelativePose::Make(rotation, translation)};
  }

 private:
  static Eigen::Vector3i Extents(std::uint64_t number) {
    switch (number % 4) {
      case 0:
        return {3, 3, 3};
      case 1:
        return {10, 10, 10};
      default:
        return {40, 3, 3};
    }
  }

  static ConvexPolyhedron Tetrahedron(Random& random, const Eigen::Vector3i& extents) {
    for (;;) {
      std::vector<Eigen::Vector3d> points(4);
      for (Eigen::Vector3d& point : points) {
        for (int i = 0; i < 3; ++i) point[i] = random.Integer(-extents[i], extents[i]);
      }
      StatusOr<ConvexPolyhedron> body = HullBody(points, FacetStyle::kMerged);
      if (body.ok()) return *body;  // flat ones are drawn again
    }
  }
};

}  // namespace

std::unique_ptr<Suite> MakeTetrahedraSuite() { return std::make_unique<TetrahedraSuite>(); }

}  // namespace touchstone
