// SPDX-License-Identifier: GPL-3.0-or-later
//
// Answers given under every rounding mode, with denormals kept or flushed, judged in the ordinary
// mode: none may be wrong, none undecided under kExact, no bound exceeded.
#include "touchstone/tests/testing/host_modes.h"

#include <gmock/gmock.h>

#include <cfenv>
#include <string>

#include "touchstone/core/cd_dual/cd_dual.h"
#include "touchstone/exact/judge.h"
#include "touchstone/tests/exact/shapes.h"

namespace touchstone::exact {
namespace {

using ::testing::IsEmpty;

struct Placed {
  ConvexPolyhedron p, q;
  RelativePose pose;
};

// Exact touches and ties, rounded contacts, far and deep pairs, poses with denormal entries.
std::vector<Placed> Pairs() {
  Random random(91);
  std::vector<Placed> pairs;
  for (int i = 0; i < 30; ++i) {
    const ConvexPolyhedron box = Box({0, 0, 0}, {1, 2, 3});
    const ConvexPolyhedron grid = GridHull(&random, 9, 2, false);
    const ConvexPolyhedron round = EllipsoidHull(&random, 40, {2, 1, 1});
    const Eigen::Vector3d whole(random.Integer(-3, 3), random.Integer(-3, 3),
                                random.Integer(-3, 3));
    pairs.push_back({box, grid, Pose(CubeRotation(&random), whole)});
    pairs.push_back(
        {grid, grid, Pose(CubeRotation(&random), whole + Eigen::Vector3d(0, 5e-310, 0))});
    const Eigen::Matrix3d turned = RoundedRotation(&random);
    const Eigen::Vector3d away = 4.0 * random.OnSphere();
    const CollideResult far = Collide(round, round, Pose(turned, away));
    for (const double gap : {-1e-3, -1e-13, 1e-13, 1e-3}) {
      const double move = far.exit_travel->value - gap;
      pairs.push_back(
          {round, round, Pose(turned, away + move * far.interior_difference.normalized())});
    }
  }
  return pairs;
}

TEST(HostModes, NoAnswerDependsOnThem) {
  long judged = 0;
  for (const Placed& x : Pairs()) {
    const ExactBody p(x.p), q(x.q);
    for (const int mode : {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
      for (const bool flush : {false, true}) {
        for (const bool early_exit : {false, true}) {
          const Search search = judged % 3 == 0 ? Search::kPhased : Search::kPortal;
          CollideResult result;
          {
            const ::touchstone::testing::HostMode set(mode, flush);
            result = Collide(x.p, x.q, x.pose, {.search = search, .early_exit = early_exit});
          }
          ++judged;
          EXPECT_THAT(Judge(p, q, x.pose, result, {.search = search, .early_exit = early_exit}),
                      IsEmpty())
              << "mode " << mode << (flush ? ", flushing" : "");
        }
      }
    }
  }
  EXPECT_GT(judged, 2000);
}

}  // namespace
}  // namespace touchstone::exact
