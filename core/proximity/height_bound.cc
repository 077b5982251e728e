// SPDX-License-Identifier: MIT
#include "touchstone/core/proximity/height_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace touchstone {
namespace {

// How much further along n than `vertex` any point of the body is at most, in the body's lengths.
// `n` is in the body's frame, each coordinate off by at most `n_error`.
double Rise(const ConvexPolyhedron& shape, int vertex, const Eigen::Vector3d& n, double n_error) {
  const double margin = shape.corner_margin(vertex);
  if (!(margin > 0.0)) return HUGE_VAL;
  // n.e with e = fl(w - v): a rounding of each coordinate of e, three of each term: below 4.01 u
  // sum |n_i e_i|, plus the error of n. |e| is at least |e|_1 / sqrt(3).
  const double per_length = 1.01 * (4.1 * kRoundingUnit * n.cwiseAbs().maxCoeff() + n_error);
  const Eigen::Vector3d v = shape.vertex(vertex);
  double steepest = 0.0;
  for (const int neighbor : shape.vertex_neighbors(vertex)) {
    const Eigen::Vector3d edge = shape.vertex(neighbor) - v;
    const double length = edge.lpNorm<1>();
    const double gain = n.dot(edge) + per_length * length;
    if (gain > 0.0) steepest = std::max(steepest, 1.8 * gain / length);
  }
  return 1.01 * steepest * shape.diameter_bound() / margin;
}

// max over P of n.a less min over Q of n.(R b + t), in the caller's lengths.
double HighestByScan(const MinkowskiDifference& m, const Eigen::Vector3d& n) {
  double highest_p = -std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& a : m.p().vertices()) highest_p = std::max(highest_p, n.dot(a));
  double lowest_q = std::numeric_limits<double>::infinity();
  const RelativePose& pose = m.pose();
  for (const Eigen::Vector3d& b : m.q().vertices()) {
    lowest_q = std::min(lowest_q, n.dot(pose.rotation() * b + pose.translation()));
  }
  return highest_p - lowest_q;
}

}  // namespace

HeightBound BoundHeight(const MinkowskiDifference& m, const Eigen::Vector3d& n,
                        VertexPair support) {
  const double length = n.lpNorm<1>();
  const Eigen::Vector3d w = m.Point(support);
  // Three roundings of the dot product, and the point's own error.
  const double at_support =
      n.dot(w) +
      1.01 * length * (3.1 * kRoundingUnit * w.cwiseAbs().maxCoeff() + m.coordinate_error());
  // Entries of R are at most 1 + 1e-6 in magnitude: a coordinate of R^T n is off by 3.01 u |n|_1,
  // and by the rotation's own error.
  const double turned_error = length * (3.1 * kRoundingUnit + m.pose().rotation_error());
  const double rise = m.scale() * (Rise(m.p(), support.p, n, 0.0) +
                                   Rise(m.q(), support.q, -m.DirectionToQ(n), turned_error));
  const double rounding = 16.0 * length * m.coordinate_error();
  if (rise <= rounding) return {at_support + 1.01 * rise, false};
  // n.a: 3.01 u |n|_1 |a|_max; n.(R b + t): the image is off by at most the coordinate error, its
  // dot product adds 3.01 u |n|_1 |image|; the difference one rounding more: together below
  // |n|_1 (E + 5 u size).
  const double scanned = m.scale() * HighestByScan(m, n) +
                         1.01 * length * (m.coordinate_error() + 5.0 * kRoundingUnit * m.size());
  if (at_support + 1.01 * rise < scanned) return {at_support + 1.01 * rise, false};
  return {scanned, true};
}

}  // namespace touchstone
