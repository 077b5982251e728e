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

// Lanes of X against one lane of Y.
struct Comparison {
  double reach[kWidth];  // lanes whose centres are further apart do not meet
  double squared[kWidth], along_x[kWidth], along_y[kWidth];  // c, and c along the axes
  double most[kWidth], least[kWidth];  // heights of features above those of centres
  std::int64_t meets[kWidth];          // bit i in lane i; else 0

  TOUCHSTONE_INLINE std::uint64_t All() const {
    std::uint64_t all = 0;
    for (int i = 0; i < kWidth; ++i) all |= static_cast<std::uint64_t>(meets[i]);
    return all;
  }
};

TOUCHSTONE_INLINE void CompareSpheresAndCones(const FeatureNode& x, const LaneBound& y,
                                              const FeatureQuery& query, Comparison* lanes) {
  for (int i = 0; i < kWidth; ++i) lanes->meets[i] = std::int64_t{1} << i;
  for (int i = 0; i < kWidth; ++i) {
    const double c0 = x.centre[0][i] - y.centre[0], c1 = x.centre[1][i] - y.centre[1],
                 c2 = x.centre[2][i] - y.centre[2];
    const double n0 = x.axis[0][i], n1 = x.axis[1][i], n2 = x.axis[2][i];
    const double squared = c0 * c0 + c1 * c1 + c2 * c2;
    lanes->squared[i] = squared;
    lanes->along_x[i] = c0 * n0 + c1 * n1 + c2 * n2;
    lanes->along_y[i] = -(c0 * y.axis[0] + c1 * y.axis[1] + c2 * y.axis[2]);
    const double reach = x.radius[i] + (query.reach + y.radius);
    const double between = -(n0 * y.axis[0] + n1 * y.axis[1] + n2 * y.axis[2]);
    const double widest = x.cosine[i] * y.cosine - x.sine[i] * y.sine;
    lanes->reach[i] = reach;
    lanes->meets[i] = ((squared > reach * reach) | (between < widest)) ? 0 : lanes->meets[i];
  }
}

TOUCHSTONE_INLINE void CompareHeights(const FeatureNode& x, const LaneBound& y,
                                      const FeatureQuery& query, Comparison* lanes) {
  for (int i = 0; i < kWidth; ++i) {
    const double off = kOffLength * lanes->reach[i];
    const double most = x.lift[i] + x.flat[i] + (y.highest - query.lowest) + off,
                 least = x.lift[i] - x.flat[i] + (y.lowest - query.reach) - off;
    lanes->most[i] = most;
    lanes->least[i] = least;
    const double squared = lanes->squared[i];
    const bool off_x = AreAllOff(squared, lanes->along_x[i], x.cosine[i], x.sine[i], most, least),
               off_y = AreAllOff(squared, lanes->along_y[i], y.cosine, y.sine, most, least);
    const double to_y =
                     x.axis[0][i] * y.pole[0] + x.axis[1][i] * y.pole[1] + x.axis[2][i] * y.pole[2],
                 to_x =
                     x.pole[0][i] * y.axis[0] + x.pole[1][i] * y.axis[1] + x.pole[2][i] * y.axis[2];
    const bool off_belt_y = IsOffBelt(to_y, x.cosine[i], x.sine[i], y.belt),
               off_belt_x = IsOffBelt(to_x, y.cosine, y.sine, x.belt[i]);
    lanes->meets[i] = (off_x | off_y | off_belt_x | off_belt_y) ? 0 : lanes->meets[i];
  }
}

// Two belts leave little: a normal n within both is along the cross product w of their poles p and
// q, one way or the other, but for what is within the belts. For whatever p and q,
//
//   w² n = (n.w) w + (n.p) q x w + (n.q) w x p,    (n.w)² = w² - |(n.p) q - (n.q) p|²,
//
// so with g = p.q and p, q of unit length w² n.v is (n.w) v.w, off by no more than `belt_p`
// |v.p - g v.q| + `belt_q` |v.q - g v.p| =: e(v), and (n.w)² is w² at most, and at least
// w² - (belt_p² + 2 |g| belt_p belt_q + belt_q²) =: `rest`. Lengths of p and q that are off by 3e-6
// change `rest` by 1e-5 where it is positive, for then both belts are below 1, and e(v) by 1e-5 |v|
// times either belt.
//
// Of both ways n must be told not to be: off a cone, as w² n.axis is below w² cos α, or of planes
// that pass too low or too high.

// Whether t v + k is negative for all t² from `rest` to `square`, t positive.
TOUCHSTONE_INLINE bool IsNegative(double v, double k, double rest, double square) {
  const bool at_most = (k < 0.0) & (square * (v * v) < k * k),
             at_least = (k < 0.0) | (rest * (v * v) > k * k);
  return ((v >= 0.0) & at_most) | ((v < 0.0) & at_least);
}

TOUCHSTONE_INLINE void CompareBelts(const FeatureNode& x, const LaneBound& y, Comparison* lanes) {
  const double q0 = y.pole[0], q1 = y.pole[1], q2 = y.pole[2], belt_q = y.belt;
  const double axis_y_q = -(y.axis[0] * q0 + y.axis[1] * q1 + y.axis[2] * q2);
  for (int i = 0; i < kWidth; ++i) {
    const double p0 = x.pole[0][i], p1 = x.pole[1][i], p2 = x.pole[2][i], belt_p = x.belt[i];
    const double w0 = p1 * q2 - p2 * q1, w1 = p2 * q0 - p0 * q2, w2 = p0 * q1 - p1 * q0;
    const double square = w0 * w0 + w1 * w1 + w2 * w2, g = p0 * q0 + p1 * q1 + p2 * q2;
    const double rest = square - kOffSquare -
                        (belt_p * belt_p + belt_q * belt_q + 2.0 * std::abs(g) * belt_p * belt_q);
    const double c0 = x.centre[0][i] - y.centre[0], c1 = x.centre[1][i] - y.centre[1],
                 c2 = x.centre[2][i] - y.centre[2];
    const double cw = c0 * w0 + c1 * w1 + c2 * w2, cp = c0 * p0 + c1 * p1 + c2 * p2,
                 cq = c0 * q0 + c1 * q1 + c2 * q2;
    const double a0 = x.axis[0][i], a1 = x.axis[1][i], a2 = x.axis[2][i];
    const double aw = a0 * w0 + a1 * w1 + a2 * w2, ap = a0 * p0 + a1 * p1 + a2 * p2,
                 aq = a0 * q0 + a1 * q1 + a2 * q2;
    const double bw = -(y.axis[0] * w0 + y.axis[1] * w1 + y.axis[2] * w2),
                 bp = -(y.axis[0] * p0 + y.axis[1] * p1 + y.axis[2] * p2), bq = axis_y_q;
    const double off_axis = kOffLength * (belt_p + belt_q);
    const double error_c = belt_p * std::abs(cp - g * cq) + belt_q * std::abs(cq - g * cp) +
                           off_axis * lanes->reach[i];
    const double of_a = belt_p * std::abs(ap - g * aq) + belt_q * std::abs(aq - g * ap) + off_axis -
                        square * x.cosine[i],
                 of_b = belt_p * std::abs(bp - g * bq) + belt_q * std::abs(bq - g * bp) + off_axis -
                        square * y.cosine,
                 under = error_c + square * lanes->most[i],
                 over = error_c - square * lanes->least[i];
    const bool one_way = IsNegative(aw, of_a, rest, square) | IsNegative(bw, of_b, rest, square) |
                         IsNegative(cw, under, rest, square) | IsNegative(-cw, over, rest, square);
    const bool other_way =
        IsNegative(-aw, of_a, rest, square) | IsNegative(-bw, of_b, rest, square) |
        IsNegative(-cw, under, rest, square) | IsNegative(cw, over, rest, square);
    lanes->meets[i] = ((rest > 0.0) & one_way & other_way) ? 0 : lanes->meets[i];
  }
}

// Bit i: whether lane i of X meets Y. Loops in a form that compilers know to put into lanes.
TOUCHSTONE_INLINE std::uint64_t LanesThatMeet(const FeatureNode& x, const LaneBound& y,
                                              const FeatureQuery& query) {
  Comparison lanes;
  CompareSpheresAndCones(x, y, query, &lanes);
  if (lanes.All() == 0) return 0;
  CompareHeights(x, y, query, &lanes);
  if (lanes.All() == 0) return 0;
  CompareBelts(x, y, &lanes);
  return lanes.All() & ((std::uint64_t{1} << x.lane_count) - 1);
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
