// SPDX-License-Identifier: MIT
#include "touchstone/core/mesh/box_tree.h"

#include <gtest/gtest.h>

#include <vector>

#include "touchstone/tests/testing/random.h"

namespace touchstone {
namespace {

using Eigen::Vector3d;

Box3 LaneOf(const BoxNode& node, int lane) {
  return {{node.low[0][lane], node.low[1][lane], node.low[2][lane]},
          {node.high[0][lane], node.high[1][lane], node.high[2][lane]}};
}

bool Meet(const Box3& a, const Box3& b, const Vector3d& offset, double margin) {
  for (int axis = 0; axis < 3; ++axis) {
    if (a.low[axis] > b.high[axis] + offset[axis] + margin) return false;
    if (a.high[axis] < b.low[axis] + offset[axis] - margin) return false;
  }
  return true;
}

// Corners on a grid, so that boxes touch as often as they overlap.
BoxTree TreeOnTheGrid(testing::Random* random, int count) {
  std::vector<Box3> boxes;
  for (int i = 0; i < count; ++i) {
    const Vector3d low(random->Int(0, 8), random->Int(0, 8), random->Int(0, 8));
    boxes.push_back({low, low + Vector3d(random->Int(0, 3), random->Int(0, 3), random->Int(0, 3))});
  }
  return BoxTree(boxes);
}

// The lanes in vectors against the same, one by one.
TEST(BoxTree, LanesMeetAsBoxesDo) {
  testing::Random random(31);
  int meeting = 0, missing = 0;
  for (int i = 0; i < 200; ++i) {
    const BoxTree a = TreeOnTheGrid(&random, random.Int(1, 40)),
                  b = TreeOnTheGrid(&random, random.Int(1, 40));
    const Vector3d offset(random.Int(-6, 6), random.Int(-6, 6), random.Int(-6, 6));
    const double margin = random.Int(0, 2);
    for (const BoxNode& node_a : a.nodes()) {
      for (const BoxNode& node_b : b.nodes()) {
        std::uint8_t masks[kTreeWidth];
        MeetingLanes(node_a, node_b, offset, margin, masks);
        for (int k = 0; k < kTreeWidth; ++k) {
          const Box3 box_a = LaneOf(node_a, k);
          const unsigned alone =
              k < node_a.lane_count ? MeetingLanes(box_a, node_b, offset, margin) : 0;
          for (int j = 0; j < kTreeWidth; ++j) {
            const bool expected = k < node_a.lane_count && j < node_b.lane_count &&
                                  Meet(box_a, LaneOf(node_b, j), offset, margin);
            ASSERT_EQ((masks[j] >> k & 1) != 0, expected);
            ASSERT_EQ((alone >> j & 1) != 0, expected);
            ++(expected ? meeting : missing);
          }
        }
      }
    }
  }
  EXPECT_GT(meeting, 10000);
  EXPECT_GT(missing, 10000);
}

TEST(BoxTree, ANodeKnowsTheBoxOfAllItsLanes) {
  testing::Random random(32);
  const BoxTree tree = TreeOnTheGrid(&random, 500);
  for (const BoxNode& node : tree.nodes()) {
    Box3 all = LaneOf(node, 0);
    for (int lane = 1; lane < node.lane_count; ++lane) {
      all.low = all.low.cwiseMin(LaneOf(node, lane).low);
      all.high = all.high.cwiseMax(LaneOf(node, lane).high);
    }
    EXPECT_EQ(node.whole.low, all.low);
    EXPECT_EQ(node.whole.high, all.high);
  }
}

}  // namespace
}  // namespace touchstone
