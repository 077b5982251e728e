// SPDX-License-Identifier: MIT
//
// Feature trees where they are placed, and the pairs of features that can meet.
#include <algorithm>
#include <bit>
#include <cmath>

#include "touchstone/core/base/vector_clones.h"
#include "touchstone/core/minkowski/feature_tree.h"
#include "touchstone/core/minkowski/normal_cone_internal.h"

namespace touchstone {

using Eigen::Vector3d;
using internal::kAllCosine;
using internal::kAllSine;

constexpr int kWidth = kFeatureTreeWidth;
// A pose may be off orthonormal by 1e-6: directions that are placed by it are off unit length, and
// off those that belong there, by less than 3e-6. What is measured along them is off by as much of
// its size, and by 1e-5 where cosines and sines that are padded are no cone's; squares by 6e-6.
constexpr double kOffLength = 2e-5, kOffSquare = 1e-5;

void PlacedFeatureTree::Place(const FeatureTree& tree, const Eigen::Matrix3d& rotation,
                              const Vector3d& translation, double scale, double distance,
                              double angle) {
  if (tree_.IsSameAs(tree) && rotation_ == rotation && translation_ == translation &&
      scale_ == scale && distance_ == distance && angle_ == angle) {
    return;
  }
  tree_ = tree;
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
  const FeatureNode& from = tree_.nodes()[i];
  FeatureNode& to = nodes_[i];
  stamps_[i] = stamp_;
  for (int k = 0; k < 3; ++k) {
    const double x = rotation_(k, 0), y = rotation_(k, 1), z = rotation_(k, 2), t = translation_[k];
    for (int lane = 0; lane < kWidth; ++lane) {
      to.centre[k][lane] = scale_ * (x * from.centre[0][lane] + y * from.centre[1][lane] +
                                     z * from.centre[2][lane] + t);
      to.axis[k][lane] = x * from.axis[0][lane] + y * from.axis[1][lane] + z * from.axis[2][lane];
      to.pole[k][lane] = x * from.pole[0][lane] + y * from.pole[1][lane] + z * from.pole[2][lane];
    }
  }
  const double room = 0x1p-46 + distance_;
  for (int lane = 0; lane < kWidth; ++lane) {
    const double radius = scale_ * from.radius[lane] + room;
    to.radius[lane] = radius;
    to.lift[lane] = scale_ * from.lift[lane];
    to.flat[lane] = scale_ * from.flat[lane] + room + angle_ * radius;
    to.belt[lane] = from.belt[lane] + angle_;
    const double wider = from.cosine[lane] * cosine_ - from.sine[lane] * sine_;
    to.cosine[lane] = wider <= 0.0 ? kAllCosine : wider;
    to.sine[lane] = wider <= 0.0 ? kAllSine : from.sine[lane] * cosine_ + from.cosine[lane] * sine_;
  }
  std::copy(from.children, from.children + kWidth, to.children);
  to.lane_count = from.lane_count;
  to.parent = from.parent;
  to.parent_lane = from.parent_lane;
}

// Cones meet if the angle between A's axis and minus B's is at most the sum of their angles.
//
// Along a normal n in both cones the sum of two features is n.c + l higher than the origin, c being
// the difference of the centres, less the point asked round, and l within the sum of `flat` of that
// of `lift`. Of the normals within a cone, n.c is |c| cos(θ - α) at most and |c| cos(θ + α) at
// least, θ the angle between c and the axis: c.axis cos α ± |c x axis| sin α; unless c itself, or
// -c, is within the cone. The origin is below no plane if the most is negative; all planes pass
// further off than the limit if the least is above it.
//
// Lanes of X run in vectors, those of Y one after the other. X may be either body's: seen from B, c
// and the cones turn to their negatives. What fails is told by sign bits, for comparisons of
// vectors run lane by lane in clones.

// One lane, as lanes of another node are compared with it.
struct LaneBound {
  double centre[3], axis[3], pole[3], radius, highest, lowest, cosine, sine, belt;

  // Moved by `sense` times the point that is asked round.
  TOUCHSTONE_INLINE LaneBound(const FeatureNode& node, int lane, double sense,
                              const FeatureQuery& query)
      : radius(node.radius[lane]),
        highest(node.lift[lane] + node.flat[lane]),
        lowest(node.lift[lane] - node.flat[lane]),
        cosine(node.cosine[lane]),
        sine(node.sine[lane]),
        belt(node.belt[lane]) {
    for (int k = 0; k < 3; ++k) {
      centre[k] = node.centre[k][lane] + sense * query.around[k];
      axis[k] = node.axis[k][lane];
      pole[k] = node.pole[k][lane];
    }
  }
};

// Whether planes across normals in a cone all pass on the far side of the point asked round, or all
// beyond the reach: c is `along` the axis, and the heights of features from `least` to `most`
// above those of centres. A cone that bounds nothing tells nothing.
TOUCHSTONE_INLINE bool AreAllOff(double squared, double along, double cosine, double sine,
                                 double most, double least) {
  const double across = (squared * (1.0 + kOffSquare) - along * along) * sine * sine;
  const double above = along * cosine + most, below = along * cosine + least;
  const bool is_beside = along * along < squared * cosine * cosine;
  const bool is_under = (above < 0.0) & (across < above * above) & (is_beside | (along < 0.0));
  const bool is_over = (below > 0.0) & (across < below * below) & (is_beside | (along > 0.0));
  return (is_under | is_over) & (cosine >= -1.0);
}

// Whether no normal in a cone is within a belt, `to_pole` from the cone's axis to the pole: of
// these |n.pole| is |to_pole| cos α - sqrt(1 - to_pole²) sin α at least.
TOUCHSTONE_INLINE bool IsOffBelt(double to_pole, double cosine, double sine, double belt) {
  const double off = std::abs(to_pole) * cosine - belt;
  return (off > 0.0) & (off * off > (1.0 + kOffSquare - to_pole * to_pole) * sine * sine);
}

// Bit i: whether lane i of X meets Y. Loops in a form that compilers know to put into lanes.
TOUCHSTONE_INLINE std::uint64_t LanesThatMeet(const FeatureNode& x, const LaneBound& y,
                                              const FeatureQuery& query) {
  double squared[kWidth], along_x[kWidth], along_y[kWidth];
  std::int64_t meets[kWidth], any = 0;
  for (int i = 0; i < kWidth; ++i) meets[i] = std::int64_t{1} << i;
  for (int i = 0; i < kWidth; ++i) {
    const double c0 = x.centre[0][i] - y.centre[0], c1 = x.centre[1][i] - y.centre[1],
                 c2 = x.centre[2][i] - y.centre[2];
    const double n0 = x.axis[0][i], n1 = x.axis[1][i], n2 = x.axis[2][i];
    squared[i] = c0 * c0 + c1 * c1 + c2 * c2;
    along_x[i] = c0 * n0 + c1 * n1 + c2 * n2;
    along_y[i] = -(c0 * y.axis[0] + c1 * y.axis[1] + c2 * y.axis[2]);
    const double reach = x.radius[i] + (query.reach + y.radius);
    const double between = -(n0 * y.axis[0] + n1 * y.axis[1] + n2 * y.axis[2]);
    const double widest = x.cosine[i] * y.cosine - x.sine[i] * y.sine;
    meets[i] = ((squared[i] > reach * reach) | (between < widest)) ? 0 : meets[i];
  }
  for (int i = 0; i < kWidth; ++i) any |= meets[i];
  if (any == 0) return 0;
  for (int i = 0; i < kWidth; ++i) {
    // Lanes that are further apart than this have been told.
    const double off = kOffLength * (x.radius[i] + (query.reach + y.radius));
    const double most = x.lift[i] + x.flat[i] + (y.highest - query.lowest) + off,
                 least = x.lift[i] - x.flat[i] + (y.lowest - query.reach) - off;
    const bool off_x = AreAllOff(squared[i], along_x[i], x.cosine[i], x.sine[i], most, least),
               off_y = AreAllOff(squared[i], along_y[i], y.cosine, y.sine, most, least);
    const double to_y =
                     x.axis[0][i] * y.pole[0] + x.axis[1][i] * y.pole[1] + x.axis[2][i] * y.pole[2],
                 to_x =
                     x.pole[0][i] * y.axis[0] + x.pole[1][i] * y.axis[1] + x.pole[2][i] * y.axis[2];
    const bool off_belt_y = IsOffBelt(to_y, x.cosine[i], x.sine[i], y.belt),
               off_belt_x = IsOffBelt(to_x, y.cosine, y.sine, x.belt[i]);
    meets[i] = (off_x | off_y | off_belt_x | off_belt_y) ? 0 : meets[i];
  }
  std::uint64_t mask = 0;
  for (int i = 0; i < kWidth; ++i) mask |= static_cast<std::uint64_t>(meets[i]);
  return mask & ((std::uint64_t{1} << x.lane_count) - 1);
}

// Byte j of the result is the mask of lanes of X that meet lane j of Y, for lanes in `lanes_of_y`.
TOUCHSTONE_INLINE std::uint64_t MeetingLanesOf(const FeatureNode& x, const FeatureNode& y,
                                               unsigned lanes_of_y, double sense,
                                               const FeatureQuery& query) {
  std::uint64_t masks = 0;
  for (; lanes_of_y != 0; lanes_of_y &= lanes_of_y - 1) {
    const int j = std::countr_zero(lanes_of_y);
    masks |= LanesThatMeet(x, LaneBound(y, j, sense, query), query) << (8 * j);
  }
  return masks;
}

TOUCHSTONE_VECTOR_CLONES
void MeetingFeatures(const FeatureLanes& a, const FeatureLanes& b, const FeatureQuery& query,
                     std::uint8_t masks[kWidth]) {
  unsigned lanes_of_b = b.lane < 0 ? (1u << b.node->lane_count) - 1 : 1u << b.lane;
  if (a.lane >= 0 || (b.lane < 0 && a.parent != nullptr)) {
    // Lanes of B against one lane: A's own, or the one round it, which spares most of them.
    const FeatureNode& of_a = a.lane >= 0 ? *a.node : *a.parent;
    const int lane = a.lane >= 0 ? a.lane : a.node->parent_lane;
    lanes_of_b &= MeetingLanesOf(*b.node, of_a, 1u << lane, -1.0, query) >> (8 * lane);
  }
  if (a.lane >= 0) {
    for (int j = 0; j < kWidth; ++j) masks[j] = ((lanes_of_b >> j) & 1) << a.lane;
    return;
  }
  const std::uint64_t all = MeetingLanesOf(*a.node, *b.node, lanes_of_b, 1.0, query);
  for (int j = 0; j < kWidth; ++j) masks[j] = static_cast<std::uint8_t>(all >> (8 * j));
}

double NearestSum(const FeatureNode& a, int i, const FeatureNode& b, int j) {
  const double c[3] = {a.centre[0][i] - b.centre[0][j], a.centre[1][i] - b.centre[1][j],
                       a.centre[2][i] - b.centre[2][j]};
  const double squared = c[0] * c[0] + c[1] * c[1] + c[2] * c[2];
  const double length = std::sqrt(squared);
  double near = length - (a.radius[i] + b.radius[j]);
  const double lowest = a.lift[i] + b.lift[j] - a.flat[i] - b.flat[j] - kOffLength * length;
  const auto least_height = [&](const FeatureNode& node, int lane, double sign) {
    if (node.cosine[lane] < -1.0) return;
    const double along =
        sign * (c[0] * node.axis[0][lane] + c[1] * node.axis[1][lane] + c[2] * node.axis[2][lane]);
    const double cosine = node.cosine[lane];
    if (along < 0.0 && along * along >= squared * cosine * cosine) return;
    const double across = std::sqrt(std::max(0.0, squared * (1.0 + kOffSquare) - along * along));
    near = std::max(near, along * cosine - across * node.sine[lane] + lowest);
  };
  least_height(a, i, 1.0);
  least_height(b, j, -1.0);
  return near;
}

}  // namespace touchstone
