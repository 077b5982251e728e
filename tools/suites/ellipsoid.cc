// SPDX-License-Identifier: MIT
#include "touchstone/tools/suites/ellipsoid.h"

#include <vector>

#include "touchstone/tools/suites/placement.h"
#include "touchstone/tools/suites/random.h"
#include "touchstone/tools/suites/recent_cache.h"
#include "touchstone/tools/suites/shapes.h"

namespace touchstone {
namespace {

// A pair of shapes serves this many orientations, each with all placements.
constexpr int kOrientations = 4;

struct Block {
  ConvexPolyhedron p, q;
  std::vector<ContactLine> lines;
};

class EllipsoidSuite : public Suite {
 public:
  EllipsoidSuite(std::string_view name, std::string_view summary, std::span<const double> aspects,
                 std::span<const int> counts)
      : name_(name), summary_(summary), aspects_(aspects), counts_(counts) {}

  std::string_view name() const override { return name_; }
  std::string_view summary() const override { return summary_; }
  std::string_view attacks() const override {
    return "local maxima of the signed distance; verdicts down to one ulp either side of contact";
  }

  PlacedPair Generate(std::uint64_t seed, std::uint64_t index) const override {
    thread_local RecentCache<Block> cache;
    const std::uint64_t line = index / kPlacementCount;
    const Block& block = cache.Get(name_, seed, line / kOrientations,
                                   [&] { return MakeBlock(seed, line / kOrientations); });
    return {block.p, block.q,
            PoseOfPlacement(block.lines[line % kOrientations],
                            static_cast<int>(index % kPlacementCount))};
  }

 private:
  Block MakeBlock(std::uint64_t seed, std::uint64_t number) const {
    Random random(name_, seed, number);
    const double aspect = random.Pick(aspects_);
    const Eigen::Vector3d semi_axes(100.0 * aspect, 100.0, 100.0);
    const int count_p = random.Pick(counts_);
    const int count_q = random.Pick(counts_);
    ConvexPolyhedron p = EllipsoidBody(random, count_p, semi_axes);
    ConvexPolyhedron q = EllipsoidBody(random, count_q, semi_axes);
    std::vector<ContactLine> lines;
    for (int i = 0; i < kOrientations; ++i) {
      const Eigen::Matrix3d rotation = random.Rotation();
      lines.push_back(FindContactLine(p, q, rotation, random.SpherePoint()));
    }
    return {std::move(p), std::move(q), std::move(lines)};
  }

  std::string_view name_, summary_;
  std::span<const double> aspects_;
  std::span<const int> counts_;
};

}  // namespace

std::unique_ptr<Suite> MakeEllipsoidSuite(std::string_view name, std::string_view summary,
                                          std::span<const double> aspects,
                                          std::span<const int> counts) {
  return std::make_unique<EllipsoidSuite>(name, summary, aspects, counts);
}

}  // namespace touchstone
