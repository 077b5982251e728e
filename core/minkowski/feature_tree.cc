// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/feature_tree.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "touchstone/core/base/vector_lanes.h"
#include "touchstone/core/minkowski/normal_cone_internal.h"

namespace touchstone {
namespace {

using Eigen::Vector3d;
using internal::ConeRound;
using internal::SineOf;
using lanes::Flags;
using lanes::Load;
using lanes::LoadThree;
using lanes::Reals;
using lanes::Store;

constexpr int kWidth = kFeatureTreeWidth;
constexpr double kPadding = 1e-5;
// Measured on the paper's scenes: anything from 2 to 8 does.
constexpr double kNormalWeight = 4.0;
constexpr double kNoHeight = 1e100;

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

// How high a feature's centre lies above a point along the normals of its cone.
struct HeightRange {
  double low, high;
};

HeightRange HeightsAbove(const Vector3d& point, const FeatureBound& bound) {
  const Vector3d d = bound.centre - point;
  const double length = d.norm();
  if (bound.cone.cosine <= 0.0) return {-length, length};
  // With θ the angle from the axis and α that of the cone: |d| cos(θ ± α), but where that passes
  // the direction of d or its opposite.
  const double along = bound.cone.axis.dot(d),
               across = std::sqrt(std::max(0.0, length * length - along * along));
  const double cosine = bound.cone.cosine, sine = SineOf(cosine);
  const bool holds_up = along >= 0.0 && across * cosine <= along * sine;
  const bool holds_down = along <= 0.0 && across * cosine <= -along * sine;
  return {holds_down ? -length : along * cosine - across * sine,
          holds_up ? length : along * cosine + across * sine};
}

}  // namespace

FeatureTree::FeatureTree(std::span<const FeatureBound> bounds, std::vector<int> items,
                         bool has_normals)
    : has_normals_(has_normals) {
  if (items.empty()) return;
  Vector3d low = bounds[items[0]].centre, high = low;
  for (const int item : items) {
    low = low.cwiseMin(bounds[item].centre);
    high = high.cwiseMax(bounds[item].centre);
  }
  extent_ = (high - low).maxCoeff();
  AddNode(bounds, items);
}

FeatureBound FeatureTree::AddNode(std::span<const FeatureBound> bounds, std::span<int> items,
                                  int parent, int parent_lane) {
  const int index = static_cast<int>(nodes_.size());
  nodes_.emplace_back();
  nodes_[index].parent = parent;
  nodes_[index].parent_lane = parent_lane;
  std::ptrdiff_t size = 1;
  while (size * kWidth < std::ssize(items)) size *= kWidth;
  std::vector<std::span<int>> runs;
  PartIntoRuns(bounds, extent_, items, size, &runs);
  const int count = static_cast<int>(runs.size());
  FeatureBound lanes[kWidth];
  for (int lane = 0; lane < kWidth; ++lane) {
    Branch branch{{}, 0, {}};
    if (lane < count) {
      const std::span<int> run = runs[lane];
      branch.items = run;
      branch.child = run.size() == 1 ? ~run[0] : static_cast<int>(nodes_.size());
      branch.bound = run.size() == 1 ? bounds[run[0]] : AddNode(bounds, run, index, lane);
    }
    SetLane(bounds, branch, lane, &nodes_[index]);
    lanes[lane] = branch.bound;
  }
  nodes_[index].lane_count = count;
  FeatureBound all = lanes[0];
  Vector3d low = lanes[0].centre, high = low;
  for (int lane = 0; lane < count; ++lane) {
    if (lane > 0) all.cone = ConeRound(all.cone, lanes[lane].cone);
    low = low.cwiseMin(Vector3d(lanes[lane].centre.array() - lanes[lane].radius));
    high = high.cwiseMax(Vector3d(lanes[lane].centre.array() + lanes[lane].radius));
  }
  all.centre = 0.5 * (low + high);
  all.radius = 0.0;
  for (int lane = 0; lane < count; ++lane) {
    all.radius = std::max(
        all.radius, (lanes[lane].centre - all.centre).norm() * (1.0 + 1e-12) + lanes[lane].radius);
  }
  return all;
}

void FeatureTree::SetLane(std::span<const FeatureBound> bounds, const Branch& branch, int lane,
                          FeatureNode* node) const {
  const FeatureBound& bound = branch.bound;
  for (int i = 0; i < 3; ++i) {
    node->centre[i][lane] = bound.centre[i];
    node->axis[i][lane] = bound.cone.axis[i];
  }
  node->radius[lane] = bound.radius * (1.0 + kPadding);
  node->cosine[lane] = bound.cone.cosine <= 0.0 ? -2.0 : bound.cone.cosine - kPadding;
  node->sine[lane] = bound.cone.cosine <= 0.0 ? 2.0 : SineOf(bound.cone.cosine) + kPadding;
  node->children[lane] = branch.child;
  double low = 0.0, high = 0.0;
  if (!branch.items.empty()) low = 1e300, high = -1e300;
  for (const int item : branch.items) {
    const HeightRange range = HeightsAbove(bound.centre, bounds[item]);
    low = std::min(low, range.low);
    high = std::max(high, range.high);
  }
  node->lift[lane] = 0.5 * (low + high);
  node->flat[lane] = has_normals_ ? 0.5 * (high - low) + kPadding * bound.radius : kNoHeight;
}

void PlacedFeatureTree::Place(const FeatureTree& tree, const Eigen::Matrix3d& rotation,
                              const Vector3d& translation, double scale, double distance,
                              double angle) {
  tree_ = &tree;
  rotation_ = rotation;
  translation_ = translation;
  scale_ = scale;
  distance_ = distance;
  angle_ = angle;
  cosine_ = std::cos(angle);
  sine_ = std::sin(angle);
  nodes_.resize(tree.nodes().size());
  stamps_.resize(nodes_.size(), stamp_);
  ++stamp_;
}

TOUCHSTONE_VECTOR_CLONES
void PlacedFeatureTree::PlaceNode(int i) {
  const FeatureNode& from = tree_->nodes()[i];
  FeatureNode& to = nodes_[i];
  stamps_[i] = stamp_;
  Reals centre[3], axis[3], radius, lift, flat;
  LoadThree(from.centre, centre);
  LoadThree(from.axis, axis);
  for (int k = 0; k < 3; ++k) {
    const double x = rotation_(k, 0), y = rotation_(k, 1), z = rotation_(k, 2);
    Store(scale_ * (x * centre[0] + y * centre[1] + z * centre[2] + translation_[k]), to.centre[k]);
    Store(x * axis[0] + y * axis[1] + z * axis[2], to.axis[k]);
  }
  Load(from.radius, &radius);
  Load(from.lift, &lift);
  Load(from.flat, &flat);
  radius = scale_ * radius + (0x1p-46 + distance_);
  Store(radius, to.radius);
  Store(scale_ * lift, to.lift);
  Store(scale_ * flat + (0x1p-46 + distance_) + angle_ * radius, to.flat);
  std::memcpy(to.cosine, from.cosine, sizeof to.cosine);
  std::memcpy(to.sine, from.sine, sizeof to.sine);
  std::memcpy(to.children, from.children, sizeof to.children);
  to.lane_count = from.lane_count;
  to.parent = from.parent;
  to.parent_lane = from.parent_lane;
  if (angle_ == 0.0) return;
  for (int lane = 0; lane < kWidth; ++lane) {
    const double wider = from.cosine[lane] * cosine_ - from.sine[lane] * sine_;
    const bool is_wide = from.cosine[lane] < -1.0 || wider <= 0.0;
    to.cosine[lane] = is_wide ? -2.0 : wider;
    to.sine[lane] = is_wide ? 2.0 : from.sine[lane] * cosine_ + from.cosine[lane] * sine_;
  }
}

// Cones meet if the angle between A's axis and minus B's is at most the sum of their angles.
//
// Along a normal n in both cones the sum of two features is n.c + l higher than the origin, c being
// the difference of the centres and l within the sum of `flat` of that of `lift`. Of the normals
// within a cone, n.c is |c| cos(θ - α) at most and |c| cos(θ + α) at least, θ the angle between c
// and the axis: c.axis cos α ± |c x axis| sin α; unless c itself, or -c, is within the cone. The
// origin is below no plane if the most is negative; all planes pass further off than the limit if
// the least is above it.
//
// Lanes of X run in vectors, those of Y one after the other. X may be either body's: seen from B, c
// and the cones turn to their negatives. What fails is told by sign bits, for comparisons of
// vectors run lane by lane in clones.

// Byte j of the result is the mask of lanes of X that meet lane j of Y, for lanes in `lanes_of_y`.
TOUCHSTONE_INLINE std::uint64_t MeetingLanesOf(const FeatureNode& x, const FeatureNode& y,
                                               unsigned lanes_of_y, double limit,
                                               double least_rise) {
  Reals centre[3], axis[3], radius, lift, flat, cosine, sine;
  LoadThree(x.centre, centre);
  LoadThree(x.axis, axis);
  Load(x.radius, &radius);
  Load(x.lift, &lift);
  Load(x.flat, &flat);
  Load(x.cosine, &cosine);
  Load(x.sine, &sine);
  const Reals squared_sine = sine * sine;
  const Reals highest = lift + flat, lowest = lift - flat;
  const Flags x_is_narrow = ~(Flags)(cosine + 1.0);
  const Flags bits = {1, 2, 4, 8, 16, 32, 64, 128};
  Flags all = {};
  for (; lanes_of_y != 0; lanes_of_y &= lanes_of_y - 1) {
    const int j = std::countr_zero(lanes_of_y);
    const Reals c0 = centre[0] - y.centre[0][j], c1 = centre[1] - y.centre[1][j],
                c2 = centre[2] - y.centre[2][j];
    const Reals squared = c0 * c0 + c1 * c1 + c2 * c2;
    const Reals reach = limit + radius + y.radius[j];
    const Reals between =
        -(axis[0] * y.axis[0][j] + axis[1] * y.axis[1][j] + axis[2] * y.axis[2][j]);
    const Reals least = cosine * y.cosine[j] - sine * y.sine[j];
    const Reals of_x = c0 * axis[0] + c1 * axis[1] + c2 * axis[2];
    const Reals of_y = -(c0 * y.axis[0][j] + c1 * y.axis[1][j] + c2 * y.axis[2][j]);
    const Reals up = highest + (y.lift[j] + y.flat[j] - least_rise);
    const Reals down = lowest + (y.lift[j] - y.flat[j] - limit);
    const Reals along_x = of_x * cosine, along_y = of_y * y.cosine[j];
    const Reals most_x = along_x + up, most_y = along_y + up;
    const Reals least_x = along_x + down, least_y = along_y + down;
    const Reals across_x = (squared - of_x * of_x) * squared_sine;
    const Reals across_y = (squared - of_y * of_y) * (y.sine[j] * y.sine[j]);
    const Flags y_is_narrow = Flags{} - (y.cosine[j] < -1.0 ? 0 : 1);
    const Flags is_far = (Flags)(reach * reach - squared);
    const Flags is_parted = (Flags)(between - least) & x_is_narrow & y_is_narrow;
    const Flags is_beside_x = (Flags)(of_x * of_x - squared * (cosine * cosine));
    const Flags is_beside_y = (Flags)(of_y * of_y - squared * (y.cosine[j] * y.cosine[j]));
    const Flags is_below_x =
        (Flags)most_x & (Flags)(across_x - most_x * most_x) & (is_beside_x | (Flags)of_x);
    const Flags is_below_y =
        (Flags)most_y & (Flags)(across_y - most_y * most_y) & (is_beside_y | (Flags)of_y);
    const Flags is_above_x =
        ~(Flags)least_x & (Flags)(across_x - least_x * least_x) & (is_beside_x | ~(Flags)of_x);
    const Flags is_above_y =
        ~(Flags)least_y & (Flags)(across_y - least_y * least_y) & (is_beside_y | ~(Flags)of_y);
    const Flags fails = is_far | is_parted | ((is_below_x | is_above_x) & x_is_narrow) |
                        ((is_below_y | is_above_y) & y_is_narrow);
    all |= ~(fails >> 63) & (bits << (8 * j));
  }
  std::uint64_t masks = 0;
  for (int i = 0; i < kWidth; ++i) masks |= static_cast<std::uint64_t>(all[i]);
  const std::uint64_t used = (std::uint64_t{1} << x.lane_count) - 1;
  return masks & (used * 0x0101010101010101u);
}

TOUCHSTONE_VECTOR_CLONES
void MeetingFeatures(const FeatureLanes& a, const FeatureLanes& b, double limit, bool faces_away,
                     std::uint8_t masks[kWidth]) {
  const double least_rise = faces_away ? -0x1p-46 : -1e100;
  unsigned lanes_of_b = b.lane < 0 ? (1u << b.node->lane_count) - 1 : 1u << b.lane;
  if (a.lane >= 0 || (b.lane < 0 && a.parent != nullptr)) {
    // Lanes of B against one lane: A's own, or the one round it, which spares most of them.
    const FeatureNode& of_a = a.lane >= 0 ? *a.node : *a.parent;
    const int lane = a.lane >= 0 ? a.lane : a.node->parent_lane;
    lanes_of_b &= MeetingLanesOf(*b.node, of_a, 1u << lane, limit, least_rise) >> (8 * lane);
  }
  if (a.lane >= 0) {
    for (int j = 0; j < kWidth; ++j) masks[j] = ((lanes_of_b >> j) & 1) << a.lane;
    return;
  }
  const std::uint64_t all = MeetingLanesOf(*a.node, *b.node, lanes_of_b, limit, least_rise);
  for (int j = 0; j < kWidth; ++j) masks[j] = static_cast<std::uint8_t>(all >> (8 * j));
}

double NearestSum(const FeatureNode& a, int i, const FeatureNode& b, int j) {
  const double c[3] = {a.centre[0][i] - b.centre[0][j], a.centre[1][i] - b.centre[1][j],
                       a.centre[2][i] - b.centre[2][j]};
  const double squared = c[0] * c[0] + c[1] * c[1] + c[2] * c[2];
  double near = std::sqrt(squared) - (a.radius[i] + b.radius[j]);
  const double lowest = a.lift[i] + b.lift[j] - a.flat[i] - b.flat[j];
  const auto least_height = [&](const FeatureNode& node, int lane, double sign) {
    if (node.cosine[lane] < -1.0) return;
    const double along =
        sign * (c[0] * node.axis[0][lane] + c[1] * node.axis[1][lane] + c[2] * node.axis[2][lane]);
    const double cosine = node.cosine[lane];
    if (along < 0.0 && along * along >= squared * cosine * cosine) return;
    const double across = std::sqrt(std::max(0.0, squared - along * along));
    near = std::max(near, along * cosine - across * node.sine[lane] + lowest);
  };
  least_height(a, i, 1.0);
  least_height(b, j, -1.0);
  return near;
}

}  // namespace touchstone
