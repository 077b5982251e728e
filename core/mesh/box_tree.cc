// SPDX-License-Identifier: MIT
#include "touchstone/core/mesh/box_tree.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <numeric>

#include "touchstone/core/base/vector_clones.h"
#include "touchstone/core/mesh/face_lanes.h"
#include "touchstone/core/mesh/lanes_internal.h"

namespace touchstone {
namespace {

using Eigen::Vector3d;
using internal::Flags;
using internal::Lanes;
using internal::Reals;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

inline Box3 BoxOfFace(std::span<const Vector3d> points, const Triangle& face) {
  const Vector3d &a = points[face[0]], &b = points[face[1]], &c = points[face[2]];
  Box3 box;
  for (int axis = 0; axis < 3; ++axis) {
    box.low[axis] = std::min(std::min(a[axis], b[axis]), c[axis]);
    box.high[axis] = std::max(std::max(a[axis], b[axis]), c[axis]);
  }
  return box;
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

void SetLane(const Box3& box, int lane, BoxNode* node) {
  for (int axis = 0; axis < 3; ++axis) {
    node->low[axis][lane] = box.low[axis];
    node->high[axis][lane] = box.high[axis];
  }
}

void FitWhole(BoxNode* node) {
  for (int axis = 0; axis < 3; ++axis) {
    double low = node->low[axis][0], high = node->high[axis][0];
    for (int lane = 1; lane < node->lane_count; ++lane) {
      low = std::min(low, node->low[axis][lane]);
      high = std::max(high, node->high[axis][lane]);
    }
    node->whole.low[axis] = low;
    node->whole.high[axis] = high;
  }
}

void GatherCorners(std::span<const Vector3d> points, std::span<const Triangle> faces,
                   const BoxNode& leaf, FaceLanes* lanes) {
  for (int lane = 0; lane < kTreeWidth; ++lane) {
    const Triangle& face = faces[~leaf.children[lane < leaf.lane_count ? lane : 0]];
    for (int k = 0; k < 3; ++k) {
      const Vector3d& point = points[face[k]];
      for (int i = 0; i < 3; ++i) lanes->corners[k][i][lane] = point[i];
    }
  }
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
  alone.whole = {{node.low[0][lane], node.low[1][lane], node.low[2][lane]},
                 {node.high[0][lane], node.high[1][lane], node.high[2][lane]}};
  return alone;
}

// Bit j: whether lane j of the node, where it is, meets the box.
TOUCHSTONE_INLINE std::uint64_t MeetingMask(const double low[3], const double high[3],
                                            const BoxNode& node) {
  const auto* lows = reinterpret_cast<const Reals*>(node.low);
  const auto* highs = reinterpret_cast<const Reals*>(node.high);
  const Lanes lanes = {lows[0], lows[1], lows[2], highs[0], highs[1], highs[2]};
  Flags misses;
  internal::FindMisses(lanes, low, high, &misses);
  return internal::ClearLanes(misses) & ((std::uint64_t{1} << node.lane_count) - 1);
}

}  // namespace

TOUCHSTONE_VECTOR_CLONES
void MeetingLanes(const BoxNode& a, const BoxNode& b, const Vector3d& offset, double margin,
                  std::uint8_t masks[kTreeWidth]) {
  // Lanes of A that meet B as a whole.
  const Box3& whole = b.whole;
  const double whole_low[3] = {whole.low[0] + offset[0] - margin, whole.low[1] + offset[1] - margin,
                               whole.low[2] + offset[2] - margin};
  const double whole_high[3] = {whole.high[0] + offset[0] + margin,
                                whole.high[1] + offset[1] + margin,
                                whole.high[2] + offset[2] + margin};
  Lanes lanes;
  internal::Move(b, offset, margin, &lanes);
  Flags meeting = {};
  for (std::uint64_t of_a = MeetingMask(whole_low, whole_high, a); of_a != 0; of_a &= of_a - 1) {
    const int i = std::countr_zero(of_a);
    const double low[3] = {a.low[0][i], a.low[1][i], a.low[2][i]};
    const double high[3] = {a.high[0][i], a.high[1][i], a.high[2][i]};
    Flags misses;
    internal::FindMisses(lanes, low, high, &misses);
    meeting |= ((misses >> 63) - 1) & (std::uint64_t{1} << i);
  }
  const internal::Bytes bytes = __builtin_convertvector(meeting, internal::Bytes);
  std::memcpy(masks, &bytes, sizeof bytes);
  for (int j = b.lane_count; j < kTreeWidth; ++j) masks[j] = 0;
}

namespace {

// The boxes of the leaf's lanes and of all. (From and to arrays of its own: what may overlap is not
// vectorised.)
TOUCHSTONE_VECTOR_CLONES
void FitBoxesOf(const FaceLanes& lanes, BoxNode* leaf) {
  for (int axis = 0; axis < 3; ++axis) {
    double a[kTreeWidth], b[kTreeWidth], c[kTreeWidth], low[kTreeWidth], high[kTreeWidth];
    std::memcpy(a, lanes.corners[0][axis], sizeof a);
    std::memcpy(b, lanes.corners[1][axis], sizeof b);
    std::memcpy(c, lanes.corners[2][axis], sizeof c);
    for (int i = 0; i < kTreeWidth; ++i) {
      const double least = a[i] < b[i] ? a[i] : b[i], most = a[i] < b[i] ? b[i] : a[i];
      low[i] = least < c[i] ? least : c[i];
      high[i] = most < c[i] ? c[i] : most;
    }
    std::memcpy(leaf->low[axis], low, sizeof low);
    std::memcpy(leaf->high[axis], high, sizeof high);
    // Unused lanes repeat the first.
    double lowest, highest;
    internal::FindExtent(low, high, &lowest, &highest);
    leaf->whole.low[axis] = lowest;
    leaf->whole.high[axis] = highest;
    for (int lane = leaf->lane_count; lane < kTreeWidth; ++lane) {
      leaf->low[axis][lane] = kInfinity;
      leaf->high[axis][lane] = -kInfinity;
    }
  }
}

}  // namespace

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
  FitBoxes([&](BoxNode* leaf) {
    for (int lane = 0; lane < leaf->lane_count; ++lane) {
      SetLane(boxes[~leaf->children[lane]], lane, leaf);
    }
    FitWhole(leaf);
  });
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
  if (size == 1) nodes_[index].leaf = leaf_count_++;
  for (std::size_t lane = 0; lane < runs.size(); ++lane) {
    const int child = size == 1 ? ~runs[lane][0] : AddNode(boxes, runs[lane]);
    nodes_[index].children[lane] = child;
  }
  return index;
}

void BoxTree::Fit(std::span<const Vector3d> points, std::span<const Triangle> faces,
                  std::span<FaceLanes> lanes) {
  for (const BoxNode& node : nodes_) {
    if (node.leaf >= 0) GatherCorners(points, faces, node, &lanes[node.leaf]);
  }
  FitBoxes([&](BoxNode* leaf) { FitBoxesOf(lanes[leaf->leaf], leaf); });
}

template <class FitLeaf>
void BoxTree::FitBoxes(const FitLeaf& fit_leaf) {
  for (auto node = nodes_.rbegin(); node != nodes_.rend(); ++node) {
    if (node->leaf >= 0) {
      fit_leaf(&*node);
      continue;
    }
    for (int lane = 0; lane < node->lane_count; ++lane) {
      SetLane(nodes_[node->children[lane]].whole, lane, &*node);
    }
    FitWhole(&*node);
  }
  all_ = nodes_[0].whole;
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
