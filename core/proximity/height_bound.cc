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
  const SupportTable& table = shape.support_table();
  const int corner = table.CornerOfVertex(vertex);
  return table.vertex(corner) == vertex ? table.Rise(corner, n, n_error) : HUGE_VAL;
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
