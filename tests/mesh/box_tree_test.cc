// SPDX-License-Identifier: MIT
#include "touchstone/core/mesh/box_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "touchstone/core/mesh/face_lanes.h"
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
          for (int j = 0; j < kTreeWidth; ++j) {
            const bool expected = k < node_a.lane_count && j < node_b.lane_count &&
                                  Meet(box_a, LaneOf(node_b, j), offset, margin);
            ASSERT_EQ((masks[j] >> k & 1) != 0, expected);
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

// A run of one item beside runs of eight or 64 is a leaf like the others.
TEST(BoxTree, NodesHoldNodesOrItems) {
  testing::Random random(33);
  for (const int count : {1, 2, 7, 8, 9, 63, 64, 65, 72, 73, 512, 513, 577, 1000}) {
    const BoxTree tree = TreeOnTheGrid(&random, count);
    std::vector<int> times(count, 0);
    int leaves = 0;
    for (const BoxNode& node : tree.nodes()) {
      if (node.leaf >= 0) {
        EXPECT_EQ(node.leaf, leaves++);
      }
      for (int lane = 0; lane < node.lane_count; ++lane) {
        ASSERT_EQ(node.children[lane] < 0, node.leaf >= 0) << count;
        if (node.leaf >= 0) ++times[~node.children[lane]];
      }
    }
    EXPECT_EQ(leaves, tree.leaf_count());
    EXPECT_EQ(std::count(times.begin(), times.end(), 1), count);
  }
}

// The lanes of a leaf are its faces' corners, unused ones those of the first; boxes are of these.
TEST(BoxTree, FitsLanesAndBoxesToFaces) {
  testing::Random random(34);
  for (const int count : {1, 9, 65, 200}) {
    std::vector<Vector3d> points;
    std::vector<Triangle> faces;
    for (int i = 0; i < count + 2; ++i) points.push_back(random.Direction());
    for (int i = 0; i < count; ++i) faces.push_back({i, i + 1, i + 2});
    BoxTree tree(points, faces);
    for (Vector3d& point : points) point = 3.0 * random.Direction();
    std::vector<FaceLanes> lanes(tree.leaf_count());
    tree.Fit(points, faces, lanes);
    std::vector<Vector3d> directions;
    for (std::size_t l = 0; l < lanes.size(); ++l) directions.push_back(random.Direction());
    FindSlabs(directions, lanes);
    for (const BoxNode& node : tree.nodes()) {
      if (node.leaf < 0) continue;
      const FaceLanes& leaf = lanes[node.leaf];
      double low = 1e300, high = -1e300;
      for (int lane = 0; lane < kTreeWidth; ++lane) {
        const Triangle& face = faces[~node.children[lane < node.lane_count ? lane : 0]];
        Box3 box = {points[face[0]], points[face[0]]};
        for (int k = 0; k < 3; ++k) {
          const Vector3d& point = points[face[k]];
          box = {box.low.cwiseMin(point), box.high.cwiseMax(point)};
          for (int i = 0; i < 3; ++i) ASSERT_EQ(leaf.corners[k][i][lane], point[i]);
          const double height = leaf.direction[0] * point[0] + leaf.direction[1] * point[1] +
                                leaf.direction[2] * point[2];
          low = std::min(low, height);
          high = std::max(high, height);
        }
        if (lane >= node.lane_count) continue;
        EXPECT_EQ(LaneOf(node, lane).low, box.low);
        EXPECT_EQ(LaneOf(node, lane).high, box.high);
      }
      EXPECT_EQ(leaf.low, low);
      EXPECT_EQ(leaf.high, high);
      EXPECT_EQ(leaf.length, leaf.direction.cwiseAbs().sum());
    }
  }
}

}  // namespace
}  // namespace touchstone
