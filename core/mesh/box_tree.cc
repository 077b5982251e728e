// SPDX-License-Identifier: MIT
#include "touchstone/core/mesh/box_tree.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "touchstone/core/base/vector_clones.h"

namespace touchstone {
namespace {

using Eigen::Vector3d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Vector3d Middle(std::span<const Vector3d> points, const Triangle& face) {
  return points[face[0]] + points[face[1]] + points[face[2]];
}

// Parts `members` at `at` by their middles along the axis on which these spread most.
void PartAt(std::span<const Vector3d> points, std::span<const Triangle> faces,
            std::span<int> members, std::ptrdiff_t at) {
  Vector3d low = Vector3d::Constant(kInfinity), high = Vector3d::Constant(-kInfinity);
  for (const int f : members) {
    const Vector3d middle = Middle(points, faces[f]);
    low = low.cwiseMin(middle);
    high = high.cwiseMax(middle);
  }
  int axis = 0;
  (high - low).maxCoeff(&axis);
  std::nth_element(members.begin(), members.begin() + at, members.end(), [&](int f, int g) {
    const double x = Middle(points, faces[f])[axis], y = Middle(points, faces[g])[axis];
    return x != y ? x < y : f < g;
  });
}

// Parts `members` into runs of `size`, the last one shorter, and lists where they end.
void PartIntoRuns(std::span<const Vector3d> points, std::span<const Triangle> faces,
                  std::span<int> members, std::ptrdiff_t size, std::vector<std::span<int>>* runs) {
  const std::ptrdiff_t count = (std::ssize(members) + size - 1) / size;
  if (count <= 1) {
    runs->push_back(members);
    return;
  }
  const std::ptrdiff_t at = count / 2 * size;
  PartAt(points, faces, members, at);
  PartIntoRuns(points, faces, members.first(at), size, runs);
  PartIntoRuns(points, faces, members.subspan(at), size, runs);
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
        meets[i] = (a.low[axis][i] <= high) & (a.high[axis][i] >= low) ? meets[i] : 0;
      }
    }
    std::int64_t mask = 0;
    for (int i = 0; i < kTreeWidth; ++i) mask |= meets[i];
    masks[j] = static_cast<std::uint8_t>(mask);
  }
}

BoxTree::BoxTree(std::span<const Vector3d> points, std::span<const Triangle> faces) {
  std::vector<int> members(faces.size());
  std::iota(members.begin(), members.end(), 0);
  AddNode(points, faces, members);
  Fit(points, faces);
}

int BoxTree::AddNode(std::span<const Vector3d> points, std::span<const Triangle> faces,
                     std::span<int> members) {
  const int index = static_cast<int>(nodes_.size());
  nodes_.emplace_back();
  // Runs of the largest power of eight that leaves more than one: nodes below are full.
  std::ptrdiff_t size = 1;
  while (size * kTreeWidth < std::ssize(members)) size *= kTreeWidth;
  std::vector<std::span<int>> runs;
  PartIntoRuns(points, faces, members, size, &runs);
  nodes_[index].lane_count = static_cast<int>(runs.size());
  for (int lane = 0; lane < kTreeWidth; ++lane) {
    for (int axis = 0; axis < 3; ++axis) {
      nodes_[index].low[axis][lane] = kInfinity;
      nodes_[index].high[axis][lane] = -kInfinity;
    }
    nodes_[index].children[lane] = 0;
  }
  for (std::size_t lane = 0; lane < runs.size(); ++lane) {
    const int child = runs[lane].size() == 1 ? ~runs[lane][0] : AddNode(points, faces, runs[lane]);
    nodes_[index].children[lane] = child;
  }
  return index;
}

void BoxTree::Fit(std::span<const Vector3d> points, std::span<const Triangle> faces) {
  const auto box_of = [&](const BoxNode& node) {
    for (int axis = 0; axis < 3; ++axis) {
      low_[axis] = *std::min_element(node.low[axis], node.low[axis] + node.lane_count);
      high_[axis] = *std::max_element(node.high[axis], node.high[axis] + node.lane_count);
    }
  };
  for (auto node = nodes_.rbegin(); node != nodes_.rend(); ++node) {
    for (int lane = 0; lane < node->lane_count; ++lane) {
      const int child = node->children[lane];
      if (child < 0) {
        const Triangle& face = faces[~child];
        low_ = points[face[0]].cwiseMin(points[face[1]]).cwiseMin(points[face[2]]);
        high_ = points[face[0]].cwiseMax(points[face[1]]).cwiseMax(points[face[2]]);
      } else {
        box_of(nodes_[child]);
      }
      for (int axis = 0; axis < 3; ++axis) {
        node->low[axis][lane] = low_[axis];
        node->high[axis][lane] = high_[axis];
      }
    }
  }
  box_of(nodes_[0]);
}

}  // namespace touchstone
