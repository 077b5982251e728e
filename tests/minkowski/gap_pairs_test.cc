// SPDX-License-Identifier: MIT
//
// What parts two facets, parts them for as long as it says.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "touchstone/core/minkowski/convolution.h"
#include "touchstone/core/minkowski/gap_pairs_internal.h"
#include "touchstone/core/minkowski/gauss_map.h"
#include "touchstone/tests/minkowski/local_sum_checks.h"
#include "touchstone/tests/testing/random.h"
#include "touchstone/tools/shapes/shapes.h"

namespace touchstone::internal {
namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using touchstone::testing::PoseOf;

std::vector<GapCandidate> AllFacets(const MeshPair& pair) {
  const GaussMap map_a(pair.a().mesh), map_b(pair.b().mesh);
  std::vector<GapCandidate> candidates;
  for (const SumFacet& facet : ReducedConvolution(pair, map_a, map_b).facets) {
    candidates.push_back({facet, true, true});
  }
  return candidates;
}

// B is turned about many axes by nearly as much as a pair's expiry allows. What parted the pair was
// an axis, a plane or an edge, and whichever it was must part it still.
TEST(GapPairs, PartedUntilTheyExpire) {
  touchstone::testing::Random random(71);
  long compared = 0, narrow = 0;
  for (const auto& [name_a, name_b] :
       {std::pair("star", "u"), std::pair("torus", "torus"), std::pair("fish", "l"),
        std::pair("box", "box"), std::pair("cone", "axes")}) {
    SCOPED_TRACE(name_a);
    const TriangleMesh a = MustBuild(NamedShape(name_a, 40)), b = MustBuild(NamedShape(name_b, 40));
    for (const bool is_aligned : {false, true}) {
      const Matrix3d rotation = is_aligned ? Matrix3d::Identity() : random.Rotation();
      MeshPair pair(a, b, PoseOf(rotation));
      const std::vector<GapCandidate> candidates = AllFacets(pair);
      GapPairs listed, turned;
      listed.Begin(pair, candidates, 10.0, 1e300);
      for (std::size_t i = 0; i < candidates.size(); ++i) {
        listed.List(static_cast<int>(i), candidates[i].facet);
      }
      std::vector<GapPair> pairs(listed.pairs().begin(), listed.pairs().end());
      ASSERT_GT(pairs.size(), 100u);
      for (int k = 0; k < 300; ++k) {
        const auto count = static_cast<int>(pairs.size());
        const GapPair& one = pairs[static_cast<std::size_t>(random.Int(0, count - 1))];
        if (!(one.expiry > 0.0)) continue;
        // The 2-norm of the change of a rotation by an angle is twice the sine of half of it.
        const double change = std::min(0.999 * one.expiry, 1.9);
        const double angle = 2.0 * std::asin(0.5 * change);
        for (int turn = 0; turn < 6; ++turn) {
          pair.Place(PoseOf(AngleAxisd(angle, random.Direction()).toRotationMatrix() * rotation));
          turned.Begin(pair, candidates, 0.0, 0.0);
          GapPair again = one;
          const SumFacet &x = candidates[static_cast<std::size_t>(one.i)].facet,
                         &y = candidates[static_cast<std::size_t>(one.j)].facet;
          ASSERT_TRUE(turned.IsParted(x, y, &again)) << one.i << ' ' << one.j << ' ' << change;
          ++compared;
          narrow += change < 0.2;
        }
      }
    }
  }
  EXPECT_GT(compared, 5000);
  EXPECT_GT(narrow, 500) << "nothing was close";
}

}  // namespace
}  // namespace touchstone::internal
