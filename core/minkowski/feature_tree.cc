// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/feature_tree.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "touchstone/core/base/vector_clones.h"
#include "touchstone/core/minkowski/normal_cone_internal.h"

namespace touchstone {
namespace {

using Eigen::Vector3d;
using internal::ConeRound;
using internal::SineOf;

constexpr int kWidth = kFeatureTreeWidth;
constexpr double kPadding = 1e-5;
// Measured on the paper's scenes: anything from 2 to 8 does.
constexpr double kNormalWeight = 4.0;

// Parts `items` at `at` by place, or by normal where these spread over more of the sphere than
// places over the body's size.
void PartAt(std::span<const FeatureBound> bounds, double size, std::span<int> items,
            std::ptrdiff_t at) {
  Vector3d low[2], high[2];
  for (int k = 0; k < 2; ++k) low[k].setConstant(1e300), high[k].setConstant(-1e300);
  for (const int item : items) {
    const Vector3d* values[] = {&bounds[item].centre, &bounds[item].cone.axis};
    for (int k = 0; k < 2; ++k) {
      low[k] = low[k].cwiseMin(*values[k]);
      high[k] = high[k].cwiseMax(*values[k]);
    }
  }
  int place = 0, normal = 0;
  const double extent = (high[0] - low[0]).maxCoeff(&place);
  const double spread = (high[1] - low[1]).maxCoeff(&normal);
  const bool is_by_normal = spread * size > kNormalWeight * extent;
  const auto value = [&](int item) {
    return is_by_normal ? bounds[item].cone.axis[normal] : bounds[item].centre[place];
  };
  std::nth_element(items.begin(), items.begin() + at, items.end(), [&](int i, int j) {
    const double x = value(i), y = value(j);
    return x != y ? x < y : i < j;
  });
}

void PartIntoRuns(std::span<const FeatureBound> bounds, double extent, std::span<int> items,
                  std::ptrdiff_t size, std::vector<std::span<int>>* runs) {
  const std::ptrdiff_t count = (std::ssize(items) + size - 1) / size;
  if (count <= 1) {
    runs->push_back(items);
    return;
  }
  const std::ptrdiff_t at = count / 2 * size;
  PartAt(bounds, extent, items, at);
  PartIntoRuns(bounds, extent, items.first(at), size, runs);
  PartIntoRuns(bounds, extent, items.subspan(at), size, runs);
}

}  // namespace

FeatureTree::FeatureTree(std::span<const FeatureBound> bounds, std::vector<int> items) {
  if (items.empty()) return;
  Vector3d low = bounds[items[0]].centre, high = low;
  for (const int item : items) {
    low = low.cwiseMin(bounds[item].centre);
    high = high.cwiseMax(bounds[item].centre);
  }
  extent_ = (high - low).maxCoeff();
  AddNode(bounds, items);
}

FeatureBound FeatureTree::AddNode(std::span<const FeatureBound> bounds, std::span<int> items) {
  const std::size_t index = nodes_.size();
  nodes_.emplace_back();
  std::ptrdiff_t size = 1;
  while (size * kWidth < std::ssize(items)) size *= kWidth;
  std::vector<std::span<int>> runs;
  PartIntoRuns(bounds, extent_, items, size, &runs);
  FeatureBound lanes[kWidth];
  for (std::size_t lane = 0; lane < kWidth; ++lane) {
    int child = 0;
    if (lane < runs.size()) {
      const std::span<int> run = runs[lane];
      child = run.size() == 1 ? ~run[0] : static_cast<int>(nodes_.size());
      lanes[lane] = run.size() == 1 ? bounds[run[0]] : AddNode(bounds, run);
    }
    const FeatureBound& bound = lanes[lane];
    FeatureNode& node = nodes_[index];
    for (int i = 0; i < 3; ++i) {
      node.centre[i][lane] = bound.centre[i];
      node.axis[i][lane] = bound.cone.axis[i];
    }
    node.radius[lane] = bound.radius * (1.0 + kPadding);
    node.cosine[lane] = bound.cone.cosine <= 0.0 ? -2.0 : bound.cone.cosine - kPadding;
    node.sine[lane] = bound.cone.cosine <= 0.0 ? 2.0 : SineOf(bound.cone.cosine) + kPadding;
    node.children[lane] = child;
  }
  nodes_[index].lane_count = static_cast<int>(runs.size());
  FeatureBound all = lanes[0];
  Vector3d low = lanes[0].centre, high = low;
  for (std::size_t lane = 0; lane < runs.size(); ++lane) {
    if (lane > 0) all.cone = ConeRound(all.cone, lanes[lane].cone);
    low = low.cwiseMin(Vector3d(lanes[lane].centre.array() - lanes[lane].radius));
    high = high.cwiseMax(Vector3d(lanes[lane].centre.array() + lanes[lane].radius));
  }
  all.centre = 0.5 * (low + high);
  all.radius = 0.0;
  for (std::size_t lane = 0; lane < runs.size(); ++lane) {
    all.radius = std::max(
        all.radius, (lanes[lane].centre - all.centre).norm() * (1.0 + 1e-12) + lanes[lane].radius);
  }
  return all;
}

void PlacedFeatureTree::Place(const FeatureTree& tree, const Eigen::Matrix3d& rotation,
                              const Vector3d& translation, double scale, double distance,
                              double angle) {
  tree_ = &tree;
  rotation_ = rotation;
  translation_ = translation;
  scale_ = scale;
  distance_ = distance;
  cosine_ = std::cos(angle);
  sine_ = std::sin(angle);
  nodes_.resize(tree.nodes().size());
  stamps_.resize(nodes_.size(), stamp_);
  ++stamp_;
}

void PlacedFeatureTree::PlaceNode(int i) {
  const FeatureNode& from = tree_->nodes()[i];
  FeatureNode& to = nodes_[i];
  stamps_[i] = stamp_;
  for (int k = 0; k < 3; ++k) {
    for (int lane = 0; lane < kWidth; ++lane) {
      to.centre[k][lane] = scale_ * (rotation_(k, 0) * from.centre[0][lane] +
                                     rotation_(k, 1) * from.centre[1][lane] +
                                     rotation_(k, 2) * from.centre[2][lane] + translation_[k]);
      to.axis[k][lane] = rotation_(k, 0) * from.axis[0][lane] +
                         rotation_(k, 1) * from.axis[1][lane] +
                         rotation_(k, 2) * from.axis[2][lane];
    }
  }
  for (int lane = 0; lane < kWidth; ++lane) {
    to.radius[lane] = scale_ * from.radius[lane] + 0x1p-46 + distance_;
    const double cosine = from.cosine[lane] * cosine_ - from.sine[lane] * sine_;
    const bool is_wide = from.cosine[lane] < -1.0 || cosine <= 0.0;
    to.cosine[lane] = is_wide ? -2.0 : cosine;
    to.sine[lane] = is_wide ? 2.0 : from.sine[lane] * cosine_ + from.cosine[lane] * sine_;
    to.children[lane] = from.children[lane];
  }
  to.lane_count = from.lane_count;
}

// Cones meet if the angle between A's axis and minus B's is at most the sum of their angles. Of the
// normals within a cone the one nearest to the centre c of the sums rises above the plane across it
// by |c| cos(θ - α), θ the angle between c and the axis, or more: with p = c.axis cos α + radius,
// the origin is below all planes unless p < 0 and p^2 > |c x axis|^2 sin^2 α.
//
// Lanes of X run in vectors, those of Y one after the other. X may be either body's: seen from B, c
// and the cones turn to their negatives. In the compiler's own vectors, for left to itself it runs
// the lanes one by one at -O2; and what fails is told by sign bits, for it does so with comparisons
// of such vectors in clones.
using Reals = double __attribute__((vector_size(8 * kWidth)));
using Flags = std::int64_t __attribute__((vector_size(8 * kWidth)));

TOUCHSTONE_INLINE void Load(const double* from, Reals* to) { std::memcpy(to, from, sizeof *to); }

// Byte j of the result is the mask of lanes of X that meet lane j of Y.
TOUCHSTONE_INLINE std::uint64_t MeetingLanesOf(const FeatureNode& x, const FeatureNode& y,
                                               double limit, double least_rise) {
  Reals centre[3], axis[3], radius, cosine, sine;
  for (int k = 0; k < 3; ++k) {
    Load(x.centre[k], &centre[k]);
    Load(x.axis[k], &axis[k]);
  }
  Load(x.radius, &radius);
  Load(x.cosine, &cosine);
  Load(x.sine, &sine);
  const Reals squared_sine = sine * sine;
  const Flags x_is_narrow = ~(Flags)(cosine + 1.0);
  const Flags lanes = {1, 2, 4, 8, 16, 32, 64, 128};
  Flags all = {};
  for (int j = 0; j < y.lane_count; ++j) {
    const Reals c0 = centre[0] - y.centre[0][j], c1 = centre[1] - y.centre[1][j],
                c2 = centre[2] - y.centre[2][j];
    const Reals squared = c0 * c0 + c1 * c1 + c2 * c2;
    const Reals sum = radius + y.radius[j];
    const Reals reach = limit + sum;
    const Reals between =
        -(axis[0] * y.axis[0][j] + axis[1] * y.axis[1][j] + axis[2] * y.axis[2][j]);
    const Reals least = cosine * y.cosine[j] - sine * y.sine[j];
    const Reals of_x = c0 * axis[0] + c1 * axis[1] + c2 * axis[2];
    const Reals of_y = -(c0 * y.axis[0][j] + c1 * y.axis[1][j] + c2 * y.axis[2][j]);
    const Reals rise_x = of_x * cosine + sum - least_rise;
    const Reals rise_y = of_y * y.cosine[j] + sum - least_rise;
    const Reals across_x = (squared - of_x * of_x) * squared_sine;
    const Reals across_y = (squared - of_y * of_y) * (y.sine[j] * y.sine[j]);
    const Flags y_is_narrow = Flags{} - (y.cosine[j] < -1.0 ? 0 : 1);
    const Flags is_far = (Flags)(reach * reach - squared);
    const Flags is_parted = (Flags)(between - least) & x_is_narrow & y_is_narrow;
    const Flags is_below_x = (Flags)rise_x & (Flags)(across_x - rise_x * rise_x) & x_is_narrow;
    const Flags is_below_y = (Flags)rise_y & (Flags)(across_y - rise_y * rise_y) & y_is_narrow;
    const Flags fails = is_far | is_parted | is_below_x | is_below_y;
    all |= ~(fails >> 63) & (lanes << (8 * j));
  }
  std::uint64_t masks = 0;
  for (int i = 0; i < kWidth; ++i) masks |= static_cast<std::uint64_t>(all[i]);
  const std::uint64_t used = (std::uint64_t{1} << x.lane_count) - 1;
  return masks & (used * 0x0101010101010101u);
}

TOUCHSTONE_VECTOR_CLONES
void MeetingFeatures(const FeatureNode& a, const FeatureNode& b, double limit, bool faces_away,
                     std::uint8_t masks[kWidth]) {
  const double least_rise = faces_away ? -0x1p-46 : -1e100;
  if (a.lane_count > 1 || b.lane_count == 1) {
    const std::uint64_t all = MeetingLanesOf(a, b, limit, least_rise);
    for (int j = 0; j < kWidth; ++j) masks[j] = static_cast<std::uint8_t>(all >> (8 * j));
    return;
  }
  // B's lanes in vectors.
  const std::uint64_t turned = MeetingLanesOf(b, a, limit, least_rise);
  for (int j = 0; j < kWidth; ++j) masks[j] = (turned >> j) & 1;
}

FeatureNode LaneAlone(const FeatureNode& node, int lane) {
  FeatureNode alone;
  for (int to = 0; to < kWidth; ++to) {
    for (int k = 0; k < 3; ++k) {
      alone.centre[k][to] = node.centre[k][lane];
      alone.axis[k][to] = node.axis[k][lane];
    }
    alone.radius[to] = node.radius[lane];
    alone.cosine[to] = node.cosine[lane];
    alone.sine[to] = node.sine[lane];
    alone.children[to] = node.children[lane];
  }
  alone.lane_count = 1;
  return alone;
}

}  // namespace touchstone
