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
//
// Singles: an operation rounds by u = 2^-23 of its result at most, in any rounding mode. Rounding
// coordinates below 2 moves a centre by 2 sqrt(3) u, moving it by the point asked round and taking
// the difference c of two by as much twice each: less than 2^-18 together. It is c that is taken at
// its word, and kRoom in each lane that makes up for it. Inner products of c are then off by
// 3.1 u |c|, and sums of heights, which are below three times the reach, by 2e-6 of that: with what
// is above less than kOffLength of it. Squares of c are off by 2e-6 of themselves. Radii, cosines,
// sines and belts have more than 6e-6 of their padding left, the query's reach gets as much.
constexpr double kRoom = 0x1p-19, kOffReach = 1.0 + 6e-6;
constexpr float kOffLength = 2e-5F, kOffSquare = 1e-5F;

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
  PlacedFeatureNode& to = nodes_[i];
  stamps_[i] = stamp_;
  const auto single = [](double x) { return static_cast<float>(x); };
  for (int k = 0; k < 3; ++k) {
    const double x = rotation_(k, 0), y = rotation_(k, 1), z = rotation_(k, 2), t = translation_[k];
    for (int lane = 0; lane < kWidth; ++lane) {
      to.centre[k][lane] = single(scale_ * (x * from.centre[0][lane] + y * from.centre[1][lane] +
                                            z * from.centre[2][lane] + t));
      to.axis[k][lane] =
          single(x * from.axis[0][lane] + y * from.axis[1][lane] + z * from.axis[2][lane]);
      to.pole[k][lane] =
          single(x * from.pole[0][lane] + y * from.pole[1][lane] + z * from.pole[2][lane]);
    }
  }
  const double room = kRoom + 1.001 * distance_;
  for (int lane = 0; lane < kWidth; ++lane) {
    const double radius = scale_ * from.radius[lane] + room;
    to.radius[lane] = single(radius);
    to.lift[lane] = single(scale_ * from.lift[lane]);
    to.flat[lane] = single(scale_ * from.flat[lane] + room + 1.001 * angle_ * radius);
    to.belt[lane] = single(from.belt[lane] + 1.001 * angle_);
    const double wider = from.cosine[lane] * cosine_ - from.sine[lane] * sine_;
    to.cosine[lane] = single(wider <= 0.0 ? kAllCosine : wider);
    to.sine[lane] =
        single(wider <= 0.0 ? kAllSine : from.sine[lane] * cosine_ + from.cosine[lane] * sine_);
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
  float centre[3], axis[3], pole[3], reach, highest, lowest, cosine, sine, belt;

  // Moved by `sense` times the point that is asked round, and with the reach, as far as the query's
  // goes beyond the lane.
  TOUCHSTONE_INLINE LaneBound(const PlacedFeatureNode& node, int lane, double sense,
                              const FeatureQuery& query)
      : reach(static_cast<float>(node.radius[lane] + kOffReach * query.reach)),
        highest(static_cast<float>(node.lift[lane] + node.flat[lane] - kOffReach * query.lowest)),
        lowest(static_cast<float>(node.lift[lane] - node.flat[lane] - kOffReach * query.reach)),
        cosine(node.cosine[lane]),
        sine(node.sine[lane]),
        belt(node.belt[lane]) {
    for (int k = 0; k < 3; ++k) {
      centre[k] = static_cast<float>(node.centre[k][lane] + sense * query.around[k]);
      axis[k] = node.axis[k][lane];
      pole[k] = node.pole[k][lane];
    }
  }
};

// Whether planes across normals in a cone all pass on the far side of the point asked round, or all
// beyond the reach: c is `along` the axis, and the heights of features from `least` to `most`
// above those of centres. A cone that bounds nothing tells nothing.
TOUCHSTONE_INLINE bool AreAllOff(float squared, float along, float cosine, float sine, float most,
                                 float least) {
  const float across = (squared * (1.0F + kOffSquare) - along * along) * sine * sine;
  const float above = along * cosine + most, below = along * cosine + least;
  const bool is_beside = along * along < squared * cosine * cosine;
  const bool is_under = (above < 0.0F) & (across < above * above) & (is_beside | (along < 0.0F));
  const bool is_over = (below > 0.0F) & (across < below * below) & (is_beside | (along > 0.0F));
  return (is_under | is_over) & (cosine >= -1.0F);
}

// Whether no normal in a cone is within a belt, `to_pole` from the cone's axis to the pole: of
// these |n.pole| is |to_pole| cos α - sqrt(1 - to_pole²) sin α at least.
TOUCHSTONE_INLINE bool IsOffBelt(float to_pole, float cosine, float sine, float belt) {
  const float off = std::abs(to_pole) * cosine - belt;
  return (off > 0.0F) & (off * off > (1.0F + kOffSquare - to_pole * to_pole) * sine * sine);
}

// Lanes of X against one lane of Y.
struct Comparison {
  float reach[kWidth];  // lanes whose centres are further apart do not meet
  float squared[kWidth], along_x[kWidth], along_y[kWidth];  // c, and c along the axes
  float most[kWidth], least[kWidth];  // heights of features above those of centres
  std::int32_t meets[kWidth];         // bit i in lane i; else 0

  TOUCHSTONE_INLINE std::uint64_t All() const {
    std::uint32_t all = 0;
    for (int i = 0; i < kWidth; ++i) all |= static_cast<std::uint32_t>(meets[i]);
    return all;
  }
};

TOUCHSTONE_INLINE void CompareSpheresAndCones(const PlacedFeatureNode& x, const LaneBound& y,
                                              Comparison* lanes) {
  for (int i = 0; i < kWidth; ++i) lanes->meets[i] = std::int32_t{1} << i;
  for (int i = 0; i < kWidth; ++i) {
    const float c0 = x.centre[0][i] - y.centre[0], c1 = x.centre[1][i] - y.centre[1],
                c2 = x.centre[2][i] - y.centre[2];
    const float n0 = x.axis[0][i], n1 = x.axis[1][i], n2 = x.axis[2][i];
    const float squared = c0 * c0 + c1 * c1 + c2 * c2;
    lanes->squared[i] = squared;
    lanes->along_x[i] = c0 * n0 + c1 * n1 + c2 * n2;
    lanes->along_y[i] = -(c0 * y.axis[0] + c1 * y.axis[1] + c2 * y.axis[2]);
    const float reach = x.radius[i] + y.reach;
    const float between = -(n0 * y.axis[0] + n1 * y.axis[1] + n2 * y.axis[2]);
    const float widest = x.cosine[i] * y.cosine - x.sine[i] * y.sine;
    lanes->reach[i] = reach;
    lanes->meets[i] = ((squared > reach * reach) | (between < widest)) ? 0 : lanes->meets[i];
  }
}

TOUCHSTONE_INLINE void CompareHeights(const PlacedFeatureNode& x, const LaneBound& y,
                                      Comparison* lanes) {
  for (int i = 0; i < kWidth; ++i) {
    const float off = kOffLength * lanes->reach[i];
    const float most = x.lift[i] + x.flat[i] + y.highest + off,
                least = x.lift[i] - x.flat[i] + y.lowest - off;
    lanes->most[i] = most;
    lanes->least[i] = least;
    const float squared = lanes->squared[i];
    const bool off_x = AreAllOff(squared, lanes->along_x[i], x.cosine[i], x.sine[i], most, least),
               off_y = AreAllOff(squared, lanes->along_y[i], y.cosine, y.sine, most, least);
    const float to_y =
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
// times either belt, and so much is left there for the roundings of singles.
//
// In singles w is off by 2.1 sqrt(3) u < 4.4e-7, its length in `square` by 6e-7, products with it
// by 8e-7 |v| and so with n.w by 1.5e-6 |v|; `square` by 1.3e-6, times heights below three times
// the reach, and `rest` by 3e-6. Sums of these, below five times the reach, round by 2e-6 of it,
// and their squares as if they were off by as much: by less than kOffCross of the reach, or of the
// lengths of axes, together.
constexpr float kOffRest = 2e-5F, kOffCross = 0x1p-16F;

// Of both ways n must be told not to be: off a cone, as w² n.axis is below w² cos α, or of planes
// that pass too low or too high.

// Whether t v + k is negative for all t² from `rest` to `square`, t positive.
TOUCHSTONE_INLINE bool IsNegative(float v, float k, float rest, float square) {
  const bool at_most = (k < 0.0F) & (square * (v * v) < k * k),
             at_least = (k < 0.0F) | (rest * (v * v) > k * k);
  return ((v >= 0.0F) & at_most) | ((v < 0.0F) & at_least);
}

TOUCHSTONE_INLINE void CompareBelts(const PlacedFeatureNode& x, const LaneBound& y,
                                    Comparison* lanes) {
  const float q0 = y.pole[0], q1 = y.pole[1], q2 = y.pole[2], belt_q = y.belt;
  const float axis_y_q = -(y.axis[0] * q0 + y.axis[1] * q1 + y.axis[2] * q2);
  for (int i = 0; i < kWidth; ++i) {
    const float p0 = x.pole[0][i], p1 = x.pole[1][i], p2 = x.pole[2][i], belt_p = x.belt[i];
    const float w0 = p1 * q2 - p2 * q1, w1 = p2 * q0 - p0 * q2, w2 = p0 * q1 - p1 * q0;
    const float square = w0 * w0 + w1 * w1 + w2 * w2, g = p0 * q0 + p1 * q1 + p2 * q2;
    const float rest = square - kOffRest -
                       (belt_p * belt_p + belt_q * belt_q + 2.0F * std::abs(g) * belt_p * belt_q);
    const float c0 = x.centre[0][i] - y.centre[0], c1 = x.centre[1][i] - y.centre[1],
                c2 = x.centre[2][i] - y.centre[2];
    const float cw = c0 * w0 + c1 * w1 + c2 * w2, cp = c0 * p0 + c1 * p1 + c2 * p2,
                cq = c0 * q0 + c1 * q1 + c2 * q2;
    const float a0 = x.axis[0][i], a1 = x.axis[1][i], a2 = x.axis[2][i];
    const float aw = a0 * w0 + a1 * w1 + a2 * w2, ap = a0 * p0 + a1 * p1 + a2 * p2,
                aq = a0 * q0 + a1 * q1 + a2 * q2;
    const float bw = -(y.axis[0] * w0 + y.axis[1] * w1 + y.axis[2] * w2),
                bp = -(y.axis[0] * p0 + y.axis[1] * p1 + y.axis[2] * p2), bq = axis_y_q;
    const float off_axis = kOffLength * (belt_p + belt_q) + kOffCross;
    const float error_c = belt_p * std::abs(cp - g * cq) + belt_q * std::abs(cq - g * cp) +
                          off_axis * lanes->reach[i];
    const float of_a = belt_p * std::abs(ap - g * aq) + belt_q * std::abs(aq - g * ap) + off_axis -
                       square * x.cosine[i],
                of_b = belt_p * std::abs(bp - g * bq) + belt_q * std::abs(bq - g * bp) + off_axis -
                       square * y.cosine,
                under = error_c + square * lanes->most[i],
                over = error_c - square * lanes->least[i];
    const bool off_a = IsNegative(aw, of_a, rest, square),
               off_b = IsNegative(bw, of_b, rest, square),
               too_low = IsNegative(cw, under, rest, square),
               too_high = IsNegative(-cw, over, rest, square);
    const bool off_a_back = IsNegative(-aw, of_a, rest, square),
               off_b_back = IsNegative(-bw, of_b, rest, square),
               too_low_back = IsNegative(-cw, under, rest, square),
               too_high_back = IsNegative(cw, over, rest, square);
    const bool one_way = off_a | off_b | too_low | too_high,
               other_way = off_a_back | off_b_back | too_low_back | too_high_back;
    lanes->meets[i] = ((rest > 0.0F) & one_way & other_way) ? 0 : lanes->meets[i];
  }
}

// Bit i: whether lane i of X meets Y. Loops in a form that compilers know to put into lanes.
template <bool kByBelts>
TOUCHSTONE_INLINE std::uint64_t LanesThatMeet(const PlacedFeatureNode& x, const LaneBound& y) {
  Comparison lanes;
  CompareSpheresAndCones(x, y, &lanes);
  if (lanes.All() == 0) return 0;
  CompareHeights(x, y, &lanes);
  if (lanes.All() == 0) return 0;
  if (kByBelts) CompareBelts(x, y, &lanes);
  return lanes.All() & ((std::uint64_t{1} << x.lane_count) - 1);
}

// Byte j of the result is the mask of lanes of X that meet lane j of Y, for lanes in `lanes_of_y`.
template <bool kByBelts>
TOUCHSTONE_INLINE std::uint64_t MeetingLanesOf(const PlacedFeatureNode& x,
                                               const PlacedFeatureNode& y, unsigned lanes_of_y,
                                               double sense, const FeatureQuery& query) {
  std::uint64_t masks = 0;
  for (; lanes_of_y != 0; lanes_of_y &= lanes_of_y - 1) {
    const int j = std::countr_zero(lanes_of_y);
    masks |= LanesThatMeet<kByBelts>(x, LaneBound(y, j, sense, query)) << (8 * j);
  }
  return masks;
}

TOUCHSTONE_VECTOR_CLONES
void MeetingFeatures(const FeatureLanes& a, const FeatureLanes& b, const FeatureQuery& query,
                     std::uint8_t masks[kWidth]) {
  unsigned lanes_of_b = b.lane < 0 ? (1u << b.node->lane_count) - 1 : 1u << b.lane;
  if (a.lane >= 0 || (b.lane < 0 && a.parent != nullptr)) {
    // Lanes of B against one lane: A's own, or the one round it, which spares most of them. Belts
    // were held against each other a step before, or will be in the next one.
    const PlacedFeatureNode& of_a = a.lane >= 0 ? *a.node : *a.parent;
    const int lane = a.lane >= 0 ? a.lane : a.node->parent_lane;
    lanes_of_b &= MeetingLanesOf<false>(*b.node, of_a, 1u << lane, -1.0, query) >> (8 * lane);
  }
  if (a.lane >= 0) {
    for (int j = 0; j < kWidth; ++j) masks[j] = ((lanes_of_b >> j) & 1) << a.lane;
    return;
  }
  const std::uint64_t all = MeetingLanesOf<true>(*a.node, *b.node, lanes_of_b, 1.0, query);
  for (int j = 0; j < kWidth; ++j) masks[j] = static_cast<std::uint8_t>(all >> (8 * j));
}

double NearestSum(const PlacedFeatureNode& a, int i, const PlacedFeatureNode& b, int j) {
  double c[3];
  for (int k = 0; k < 3; ++k) c[k] = static_cast<double>(a.centre[k][i]) - b.centre[k][j];
  const double squared = c[0] * c[0] + c[1] * c[1] + c[2] * c[2];
  const double length = std::sqrt(squared);
  double near = length - a.radius[i] - b.radius[j];
  const double lowest =
      static_cast<double>(a.lift[i]) + b.lift[j] - a.flat[i] - b.flat[j] - kOffLength * length;
  const auto least_height = [&](const PlacedFeatureNode& node, int lane, double sign) {
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
