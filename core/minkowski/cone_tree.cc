// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/cone_tree.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>

#include "touchstone/core/base/vector_clones.h"
#include "touchstone/core/minkowski/normal_cone_internal.h"

namespace touchstone {
namespace {

using Eigen::Vector3d;
using internal::ConeRound;
using internal::SineOf;

// Cosines and sines are moved by this much towards wider cones: poses may be off orthonormal by
// 1e-6, directions off unit length by as much.
constexpr double kPadding = 1e-5;

// Parts `items` at `at` along the axis on which the cones' axes spread most.
void PartAt(std::span<const NormalCone> cones, std::span<int> items, std::ptrdiff_t at) {
  Vector3d low = Vector3d::Constant(2.0), high = Vector3d::Constant(-2.0);
  for (const int k : items) {
    low = low.cwiseMin(cones[k].axis);
    high = high.cwiseMax(cones[k].axis);
  }
  int axis = 0;
  (high - low).maxCoeff(&axis);
  std::nth_element(items.begin(), items.begin() + at, items.end(), [&](int i, int j) {
    const double x = cones[i].axis[axis], y = cones[j].axis[axis];
    return x != y ? x < y : i < j;
  });
}

void PartIntoRuns(std::span<const NormalCone> cones, std::span<int> items, std::ptrdiff_t size,
                  std::vector<std::span<int>>* runs) {
  const std::ptrdiff_t count = (std::ssize(items) + size - 1) / size;
  if (count <= 1) {
    runs->push_back(items);
    return;
  }
  const std::ptrdiff_t at = count / 2 * size;
  PartAt(cones, items, at);
  PartIntoRuns(cones, items.first(at), size, runs);
  PartIntoRuns(cones, items.subspan(at), size, runs);
}

}  // namespace

ConeTree::ConeTree(std::span<const NormalCone> cones, std::vector<int> items) {
  if (!items.empty()) AddNode(cones, items);
}

NormalCone ConeTree::AddNode(std::span<const NormalCone> cones, std::span<int> items) {
  const std::size_t index = nodes_.size();
  nodes_.emplace_back();
  std::ptrdiff_t size = 1;
  while (size * kWidth < std::ssize(items)) size *= kWidth;
  std::vector<std::span<int>> runs;
  PartIntoRuns(cones, items, size, &runs);
  NormalCone all;
  for (int lane = 0; lane < kWidth; ++lane) {
    NormalCone cone{Vector3d::Zero(), 1.0};
    int child = 0;
    if (lane < static_cast<int>(runs.size())) {
      const std::span<int> run = runs[lane];
      child = run.size() == 1 ? ~run[0] : static_cast<int>(nodes_.size());
      cone = run.size() == 1 ? cones[run[0]] : AddNode(cones, run);
      all = lane == 0 ? cone : ConeRound(all, cone);
    }
    Node& node = nodes_[index];
    for (int i = 0; i < 3; ++i) node.axis[i][lane] = cone.axis[i];
    node.cosine[lane] = cone.cosine <= 0.0 ? -2.0 : cone.cosine - kPadding;
    node.sine[lane] = cone.cosine <= 0.0 ? 2.0 : SineOf(cone.cosine) + kPadding;
    node.children[lane] = child;
  }
  nodes_[index].lane_count = static_cast<int>(runs.size());
  return all;
}

ConeTree ConeTree::Turned(const Eigen::Matrix3d& rotation) const {
  ConeTree turned = *this;
  for (Node& node : turned.nodes_) {
    for (int lane = 0; lane < node.lane_count; ++lane) {
      const Vector3d axis(node.axis[0][lane], node.axis[1][lane], node.axis[2][lane]);
      const Vector3d after = rotation * axis;
      for (int i = 0; i < 3; ++i) node.axis[i][lane] = after[i];
    }
  }
  return turned;
}

TOUCHSTONE_VECTOR_CLONES
std::uint8_t ConeTree::LanesAlong(const Node& node, const Vector3d& direction) {
  std::int64_t holds[kWidth];
  for (int i = 0; i < kWidth; ++i) {
    const double cosine = node.axis[0][i] * direction[0] + node.axis[1][i] * direction[1] +
                          node.axis[2][i] * direction[2];
    holds[i] = cosine >= node.cosine[i] ? std::int64_t{1} << i : 0;
  }
  std::int64_t mask = 0;
  for (int i = 0; i < kWidth; ++i) mask |= holds[i];
  return static_cast<std::uint8_t>(mask);
}

// Cones of angles s and t meet iff their axes make an angle of at most s + t, of cosine
// cos s cos t - sin s sin t; always, where that is a half-space or more.
TOUCHSTONE_VECTOR_CLONES
void ConeTree::MeetingCones(const Node& a, const Node& b, std::uint8_t masks[kWidth]) {
  for (int j = 0; j < kWidth; ++j) {
    std::int64_t meets[kWidth];
    for (int i = 0; i < kWidth; ++i) {
      const double cosine =
          a.axis[0][i] * b.axis[0][j] + a.axis[1][i] * b.axis[1][j] + a.axis[2][i] * b.axis[2][j];
      const double least = a.cosine[i] * b.cosine[j] - a.sine[i] * b.sine[j];
      meets[i] = ((cosine >= least) | (a.cosine[i] < -1.0) | (b.cosine[j] < -1.0))
                     ? std::int64_t{1} << i
                     : 0;
    }
    std::int64_t mask = 0;
    for (int i = 0; i < kWidth; ++i) mask |= meets[i];
    masks[j] = static_cast<std::uint8_t>(mask);
  }
}

void ConeTree::Along(const Vector3d& direction, std::vector<int>* items) const {
  if (nodes_.empty()) return;
  int stack[kWidth * 12];  // 2^31 items make eleven levels
  int size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const Node& node = nodes_[stack[--size]];
    unsigned mask = LanesAlong(node, direction) & ((1u << node.lane_count) - 1);
    for (; mask != 0; mask &= mask - 1) {
      const int child = node.children[std::countr_zero(mask)];
      if (child < 0) {
        items->push_back(~child);
      } else {
        stack[size++] = child;
      }
    }
  }
}

// A lane alone, as a node, to go against the nodes of a deeper tree.
ConeTree::Node ConeTree::LaneAlone(const Node& node, int lane) {
  Node alone;
  for (int to = 0; to < kWidth; ++to) {
    for (int i = 0; i < 3; ++i) alone.axis[i][to] = node.axis[i][lane];
    alone.cosine[to] = node.cosine[lane];
    alone.sine[to] = node.sine[lane];
    alone.children[to] = node.children[lane];
  }
  alone.lane_count = 1;
  return alone;
}

void ConeTree::Pairs(const ConeTree& other, std::vector<std::pair<int, int>>* pairs) const {
  if (nodes_.empty() || other.nodes_.empty()) return;
  // A node, or ~(8 node + lane) for a lane that holds an item.
  std::vector<std::pair<int, int>> stack = {{0, 0}};
  Node alone;
  while (!stack.empty()) {
    const auto [i, j] = stack.back();
    stack.pop_back();
    if (i < 0) alone = LaneAlone(nodes_[~i / kWidth], ~i % kWidth);
    if (j < 0) alone = LaneAlone(other.nodes_[~j / kWidth], ~j % kWidth);
    const Node &a = i < 0 ? alone : nodes_[i], &b = j < 0 ? alone : other.nodes_[j];
    std::uint8_t masks[kWidth];
    MeetingCones(a, b, masks);
    for (int k = 0; k < b.lane_count; ++k) {
      unsigned mask = masks[k] & ((1u << a.lane_count) - 1);
      for (; mask != 0; mask &= mask - 1) {
        const int lane = std::countr_zero(mask);
        const int child_a = a.children[lane], child_b = b.children[k];
        if (child_a < 0 && child_b < 0) {
          pairs->emplace_back(~child_a, ~child_b);
          continue;
        }
        const int next_a = child_a >= 0 ? child_a : i < 0 ? i : ~(kWidth * i + lane);
        const int next_b = child_b >= 0 ? child_b : j < 0 ? j : ~(kWidth * j + k);
        stack.emplace_back(next_a, next_b);
      }
    }
  }
}

}  // namespace touchstone
