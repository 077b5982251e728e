// SPDX-License-Identifier: MIT
#include "touchstone/tools/suites/seldom.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "touchstone/tools/suites/line_suite.h"
#include "touchstone/tools/suites/random.h"
#include "touchstone/tools/suites/recent_cache.h"
#include "touchstone/tools/suites/seldom_cases.h"

namespace touchstone {
namespace {

// Enough for every draw of a campaign's samples to come up with either half.
constexpr std::uint64_t kIndicesPerCase = 80;
constexpr std::uint64_t kSeedOfCases = 1;
constexpr int kMostExponent = 60;
// Moves that leave the path as it is but where it hangs on a tie of the ray, over the size.
constexpr double kMove = 0x1p-24;

class SeldomSuite : public Suite {
 public:
  explicit SeldomSuite(std::vector<std::unique_ptr<Suite>> others) : others_(std::move(others)) {}

  std::string_view name() const override { return "seldom"; }
  std::string_view summary() const override {
    return "cases of the other suites for every way a search can end, scaled by powers of two, "
           "every other one moved by next to nothing";
  }
  std::string_view attacks() const override {
    return "the combinations of class, phase, verdict, termination and tier that chance seldom "
           "brings up";
  }

  PlacedPair Generate(std::uint64_t seed, std::uint64_t index) const override {
    thread_local RecentCache<Scaled> cache;
    const std::uint64_t block = index / kIndicesPerCase;
    const Scaled& scaled = cache.Get(name(), seed, block, [&] {
      Random random(name(), seed, 2 * block);
      return Scale(CaseOf(block), std::ldexp(1.0, random.Integer(-kMostExponent, kMostExponent)));
    });
    if (index % 2 == 0) return scaled.pair;
    Random random(name(), seed, 2 * index + 1);
    return Moved(scaled, random);
  }

 private:
  struct Scaled {
    PlacedPair pair;
    double size;
  };

  PlacedPair CaseOf(std::uint64_t block) const {
    const std::span<const SeldomCase> cases = SeldomCases();
    const SeldomCase& chosen = cases[block % cases.size()];
    for (const std::unique_ptr<Suite>& suite : others_) {
      if (suite->name() != chosen.suite) continue;
      PlacedPair pair = suite->Generate(kSeedOfCases, chosen.index);
      if (chosen.shift == Eigen::Vector3d::Zero().eval()) return pair;
      return {pair.p, pair.q, Pose(pair.pose.rotation(), pair.pose.translation() + chosen.shift)};
    }
    assert(false);
    return others_.front()->Generate(kSeedOfCases, chosen.index);
  }

  // Powers of two change no bit but the exponents'.
  static Scaled Scale(const PlacedPair& pair, double scale) {
    const auto scaled = [&](const ConvexPolyhedron& body) {
      StatusOr<ConvexPolyhedron> result =
          MapBody(body, [&](const Eigen::Vector3d& v) { return Eigen::Vector3d(scale * v); });
      assert(result.ok());
      return *result;
    };
    ConvexPolyhedron p = scaled(pair.p);
    const bool twice = pair.p.vertices().data() == pair.q.vertices().data();
    ConvexPolyhedron q = twice ? p : scaled(pair.q);
    const double size = std::max(p.max_coordinate(), q.max_coordinate());
    return {{std::move(p), std::move(q),
             Pose(pair.pose.rotation(), scale * pair.pose.translation()), pair.expected},
            size};
  }

  static PlacedPair Moved(const Scaled& scaled, Random& random) {
    const Eigen::Vector3d move = kMove * scaled.size * random.SpherePoint();
    return {scaled.pair.p, scaled.pair.q,
            Pose(scaled.pair.pose.rotation(), scaled.pair.pose.translation() + move)};
  }

  static RelativePose Pose(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation) {
    StatusOr<RelativePose> pose = RelativePose::Make(rotation, translation);
    assert(pose.ok());
    return *pose;
  }

  std::vector<std::unique_ptr<Suite>> others_;
};

}  // namespace

std::unique_ptr<Suite> MakeSeldomSuite(std::vector<std::unique_ptr<Suite>> others) {
  return std::make_unique<SeldomSuite>(std::move(others));
}

}  // namespace touchstone
