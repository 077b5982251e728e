// SPDX-License-Identifier: MIT
#include "touchstone/core/mesh/box_tree.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>

#include "touchstone/core/base/vector_clones.h"

namespace touchstone {
namespace {

using Eigen::Vector3d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Box3 BoxOfFace(std::span<const Vector3d> points, const Triangle& face) {
  const Vector3d &a = points[face[0]], &b = points[face[1]], &c = points[face[2]];
  return {a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c)};
}

// Parts `members` at `at` by their middles along the axis on which these spread most.
void PartAt(std::span<const Box3> boxes, std::span<int> members, std::ptrdiff_t at) {
  Vector3d low = Vector3d::Constant(kInfinity), high = Vector3d::Constant(-kInfinity);
  for (const int m : members) {
    const Vector3d middle = boxes[m].low + boxes[m].high;
    low = low.cwiseMin(middle);
    high = high.cwiseMax(middle);
  }
  int axis = 0;
  (high - low).maxCoeff(&axis);
  std::nth_element(members.begin(), members.begin() + at, members.end(), [&](int m, int n) {
    const double x = boxes[m].low[axis] + boxes[m].high[axis];
    const double y = boxes[n].low[axis] + boxes[n].high[axis];
    return x != y ? x < y : m < n;
  });
}

// Parts `members` into runs of `size`, the last one shorter, and lists them.
void PartIntoRuns(std::span<const Box3> boxes, std::span<int> members, std::ptrdiff_t size,
                  std::vector<std::span<int>>* runs) {
  const std::ptrdiff_t count = (std::ssize(members) + size - 1) / size;
  if (count <= 1) {
    runs->push_back(members);
    return;
  }
  const std::ptrdiff_t at = count / 2 * size;
  PartAt(boxes, members, at);
  PartIntoRuns(boxes, members.first(at), size, runs);
  PartIntoRuns(boxes, members.subspan(at), size, runs);
}

// A lane alone, as a node, to go against the nodes of a deeper tree.
BoxNode LaneAlone(const BoxNode& node, int lane) {
  BoxNode alone;
  for (int to = 0; to < kTreeWidth; ++to) {
    for (int axis = 0; axis < 3; ++axis) {
      alone.low[axis][to] = to == 0 ? node.low[axis][lane] : kInfinity;
      alone.high[axis][to] = to == 0 ? node.high[axis][lane] : -kInfinity;
    }
    alone.children[to] = node.children[lane];
  }
  alone.lane_count = 1;
  return alone;
}

}  // namespace

// Eight lanes of comparisons without a branch: one or two vector instructions each.
TOUCHSTONE_VECTOR_CLONES
void MeetingLanes(const BoxNode& a, const BoxNode& b, const Vector3d& offset, double margin,
                  std::uint8_t masks[kTreeWidth]) {
  for (int j = 0; j < kTreeWidth; ++j) {
    std::int64_t meets[kTreeWidth];
    for (int i = 0; i < kTreeWidth; ++i) meets[i] = std::int64_t{1} << i;
    for (int axis = 0; axis < 3; ++axis) {
      const double low = b.low[axis][j] + offset[axis] - margin;
      const double high = b.high[axis][j] + offset[axis] + margin;
      for (int i = 0; i < kTreeWidth; ++i) {
        meets[i] = ((a.low[axis][i] <= high) & (a.high[axis][i] >= low)) ? meets[i] : 0;
      }
    }
    std::int64_t mask = 0;
    for (int i = 0; i < kTreeWidth; ++i) mask |= meets[i];
    masks[j] = static_cast<std::uint8_t>(mask);
  }
}

BoxTree::BoxTree(std::span<const Vector3d> points, std::span<const Triangle> faces) {
  std::vector<Box3> boxes;
  boxes.reserve(faces.size());
  for (const Triangle& face : faces) boxes.push_back(BoxOfFace(points, face));
  *this = BoxTree(boxes);
}

BoxTree::BoxTree(std::span<const Box3> boxes) {
  if (boxes.empty()) return;
  std::vector<int> members(boxes.size());
  std::iota(members.begin(), members.end(), 0);
  AddNode(boxes, members);
  FitBoxes([&](int item) { return boxes[item]; });
}

int BoxTree::AddNode(std::span<const Box3> boxes, std::span<int> members) {
  const int index = static_cast<int>(nodes_.size());
  nodes_.emplace_back();
  // Runs of the largest power of eight that leaves more than one: nodes below are full.
  std::ptrdiff_t size = 1;
  while (size * kTreeWidth < std::ssize(members)) size *= kTreeWidth;
  std::vector<std::span<int>> runs;
  PartIntoRuns(boxes, members, size, &runs);
  nodes_[index].lane_count = static_cast<int>(runs.size());
  for (int lane = 0; lane < kTreeWidth; ++lane) {
    for (int axis = 0; axis < 3; ++axis) {
      nodes_[index].low[axis][lane] = kInfinity;
      nodes_[index].high[axis][lane] = -kInfinity;
    }
    nodes_[index].children[lane] = 0;
  }
  for (std::size_t lane = 0; lane < runs.size(); ++lane) {
    const int child = runs[lane].size() == 1 ? ~runs[lane][0] : AddNode(boxes, runs[lane]);
    nodes_[index].children[lane] = child;
  }
  return index;
}

void BoxTree::Fit(std::span<const Vector3d> points, std::span<const Triangle> faces) {
  FitBoxes([&](int item) { return BoxOfFace(points, faces[item]); });
}

template <class BoxOf>
void BoxTree::FitBoxes(const BoxOf& box_of) {
  const auto box_of_node = [](const BoxNode& node) {
    Box3 box;
    for (int axis = 0; axis < 3; ++axis) {
      box.low[axis] = *std::min_element(node.low[axis], node.low[axis] + node.lane_count);
      box.high[axis] = *std::max_element(node.high[axis], node.high[axis] + node.lane_count);
    }
    return box;
  };
  for (auto node = nodes_.rbegin(); node != nodes_.rend(); ++node) {
    for (int lane = 0; lane < node->lane_count; ++lane) {
      const int child = node->children[lane];
      const Box3 box = child < 0 ? box_of(~child) : box_of_node(nodes_[child]);
      for (int axis = 0; axis < 3; ++axis) {
        node->low[axis][lane] = box.low[axis];
        node->high[axis][lane] = box.high[axis];
      }
    }
  }
  all_ = box_of_node(nodes_[0]);
}

void BoxTree::MeetingItems(std::vector<std::pair<int, int>>* pairs) const {
  if (nodes_.empty()) return;
  // A node, or ~(8 node + lane) for a lane that holds an item.
  std::vector<std::pair<int, int>> stack = {{0, 0}};
  BoxNode alone;
  while (!stack.empty()) {
    const auto [i, j] = stack.back();
    stack.pop_back();
    if (i < 0) alone = LaneAlone(nodes_[~i / kTreeWidth], ~i % kTreeWidth);
    if (j < 0) alone = LaneAlone(nodes_[~j / kTreeWidth], ~j % kTreeWidth);
    const BoxNode &a = i < 0 ? alone : nodes_[i], &b = j < 0 ? alone : nodes_[j];
    std::uint8_t masks[kTreeWidth];
    MeetingLanes(a, b, Vector3d::Zero(), 0.0, masks);
    for (int k = 0; k < b.lane_count; ++k) {
      for (unsigned mask = masks[k]; mask != 0; mask &= mask - 1) {
        const int lane = std::countr_zero(mask);
        if (i == j && lane > k) continue;  // each two lanes of one node once
        const int child_a = a.children[lane], child_b = b.children[k];
        if (child_a < 0 && child_b < 0) {
          if (child_a != child_b) pairs->push_back(std::minmax(~child_a, ~child_b));
          continue;
        }
        stack.emplace_back(child_a >= 0 ? child_a
                           : i < 0      ? i
                                        : ~(kTreeWidth * i + lane),
                           child_b >= 0 ? child_b
                           : j < 0      ? j
                                        : ~(kTreeWidth * j + k));
      }
    }
  }
}

}  // namespace touchstone
