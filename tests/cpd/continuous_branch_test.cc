// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "touchstone/core/cpd/continuous_penetration_depth.h"
#include "touchstone/tests/testing/random.h"
#include "touchstone/tools/shapes/shapes.h"

namespace touchstone {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Steps of a motion, held against the same motion in 64 steps each.
struct Ends {
  int steps = 0, told = 0, untold = 0, told_of_none = 0, others = 0, in_parts = 0;
};

Ends CountEnds(const char* name, double degrees, double slide, double sure_reach,
               std::uint64_t seed) {
  testing::Random random(seed);
  const TriangleMesh a = MustBuild(NamedShape("torus", 200)), b = MustBuild(NamedShape(name, 100));
  Ends ends;
  for (int i = 0; i < 5; ++i) {
    const Matrix3d r = random.Rotation();
    const Vector3d t = random.Uniform(0.5, 1.7) * random.Direction(), axis = random.Direction(),
                   along = slide * random.Direction();
    const auto at = [&](double s) {
      const Matrix3d turn = Eigen::AngleAxisd(0.0174533 * degrees * s, axis).toRotationMatrix();
      return *RelativePose::Make(turn * r, t + s * along);
    };
    ContinuousPenetrationDepth coarse(a, b, {.sure_reach = sure_reach}), fine(a, b);
    coarse.Update(at(0));
    for (int k = 1; k <= 12; ++k) {
      const auto state = coarse.state();
      const ContinuousDepthResult result = coarse.Update(at(k));
      if (!state || !state->was_found || result.status != ContinuousDepthStatus::kFound) continue;
      EXPECT_EQ(result.branch_ended, result.branch != state->branch);
      EXPECT_EQ(coarse.state()->branch, result.branch);
      EXPECT_LE(result.parts, 1024);
      EXPECT_TRUE(coarse.patch().has_value());
      fine.set_state(state);
      ContinuousDepthResult last;
      for (int j = 1; j <= 64; ++j) {
        last = fine.Update(at(k - 1 + j / 64.0));
        if (last.branch != state->branch) break;
      }
      const bool ended = last.branch != state->branch;
      ++ends.steps;
      ends.in_parts += result.parts > 1;
      ends.told += ended && result.branch_ended;
      ends.untold += ended && !result.branch_ended;
      ends.told_of_none += !ended && result.branch_ended;
      ends.others +=
          !ended && !result.branch_ended && (last.translation - result.translation).norm() > 1e-6;
    }
  }
  return ends;
}

void Add(const Ends& ends, Ends* sum) {
  sum->steps += ends.steps;
  sum->told += ends.told;
  sum->untold += ends.untold;
  sum->told_of_none += ends.told_of_none;
  sum->others += ends.others;
  sum->in_parts += ends.in_parts;
}

// Without a turn ∂M stands still: a branch ends by a fold, where it meets one of the other index,
// and only so.
TEST(ContinuousBranch, TellsThatItEndsByAFold) {
  Ends sum;
  for (const char* name : {"fish", "star", "torus"}) {
    Add(CountEnds(name, 0.0, 0.06, 0.25, 43), &sum);
  }
  EXPECT_GT(sum.steps, 120);
  // Measured 4 of 6; past the others is one of the same index within 5e-3, a few parts away.
  EXPECT_GE(sum.told, 4);
  EXPECT_LE(sum.untold, 2);
  EXPECT_EQ(sum.told_of_none, 0);
  EXPECT_EQ(sum.others, 0);
  EXPECT_LT(sum.in_parts, sum.steps / 5);  // measured 21 of 156
}

// With a turn ∂M's triangles change as well: what leaps by less than the reach is not told.
TEST(ContinuousBranch, TellsMoreOfItsEndsByHalving) {
  Ends rarely, often;
  for (const char* name : {"fish", "star"}) {
    Add(CountEnds(name, 1.0, 0.01, 2.0, 47), &rarely);
    Add(CountEnds(name, 1.0, 0.01, 0.25, 47), &often);
  }
  EXPECT_GT(often.steps, 100);
  EXPECT_GE(often.told, 2 * rarely.told);  // measured 14 and 4, of 25
  EXPECT_GE(often.told, often.untold);
  EXPECT_EQ(often.told_of_none + rarely.told_of_none, 0);
  EXPECT_EQ(often.others + rarely.others, 0);
  EXPECT_LT(often.in_parts, often.steps / 4);  // measured 21 of 120
}

}  // namespace
}  // namespace touchstone
