// SPDX-License-Identifier: MIT
#include <array>

#include "touchstone/tools/suites/line_suite.h"
#include "touchstone/tools/suites/registry.h"
#include "touchstone/tools/suites/shapes.h"

namespace touchstone {
namespace {

constexpr std::array<double, 5> kAspects = {1e2, 1e3, 1e4, 1e5, 1e6};
constexpr std::array<int, 6> kCounts = {4, 5, 8, 12, 30, 60};

// A long body, a flat one, or one of three different lengths.
Eigen::Vector3d SemiAxes(Random& random) {
  const double aspect = random.Pick(kAspects);
  switch (random.Integer(0, 3)) {
    case 0:
      return {100.0, 100.0 / aspect, 100.0 / aspect};
    case 1:
      return {100.0, 100.0, 100.0 / aspect};
    case 2:
      return {100.0 / aspect, 100.0, 10.0};
    default:
      return {100.0, 100.0, 100.0};
  }
}

class SliversSuite : public LineSuite {
 public:
  std::string_view name() const override { return "slivers"; }
  std::string_view summary() const override {
    return "needles and flakes on 4 to 60 points, 1e2:1 to 1e6:1, against each other and round "
           "bodies";
  }
  std::string_view attacks() const override {
    return "normals from nearly parallel edges; bounds in terms of the size where one side is a "
           "millionth of it";
  }

 protected:
  Pair MakePair(Random& random) const override {
    const Eigen::Vector3d p = SemiAxes(random);
    const Eigen::Vector3d q = SemiAxes(random);
    return {EllipsoidBody(random, random.Pick(kCounts), p),
            EllipsoidBody(random, random.Pick(kCounts), q)};
  }
};

}  // namespace

std::unique_ptr<Suite> MakeSliversSuite() { return std::make_unique<SliversSuite>(); }

}  // namespace touchstone
