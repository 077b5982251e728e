// SPDX-License-Identifier: MIT
#include "touchstone/core/cd_dual/minkowski_difference.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "touchstone/core/convex/support.h"

namespace touchstone {
namespace {

// A row of R has length at most 1 + 1e-6, so |(R x)_i| <= (1 + 1e-6) sqrt(3) max |x_j| < 1.75 max.
constexpr double kRowFactor = 1.75;

}  // namespace

MinkowskiDifference::MinkowskiDifference(const ConvexPolyhedron& p, const ConvexPolyhedron& q,
                                         const RelativePose& pose)
    : p_(p), q_(q), pose_(pose) {
  const double size = p.max_coordinate() + kRowFactor * q.max_coordinate() +
                      pose.translation().cwiseAbs().maxCoeff();
  // 2^-e for a size in [2^(e-1), 2^e): sizes are normal numbers within 1e-100 and 1e101.
  const std::uint64_t exponent = std::bit_cast<std::uint64_t>(size) >> 52;
  scale_ = std::bit_cast<double>((2045 - exponent) << 52);
  size_ = size * scale_;
  // R b + t: three products and three sums, each term passing at most four roundings, then one more
  // for a - (...): (1 + u)^5 - 1 < 5.01 u of the sum of absolute terms, which is at most `size`.
  // Scaling is exact but for underflow, which is below 2^-1022 and disappears in the
  // rounded-up 5.1. The entries of a rounded relative pose add their own errors.
  coordinate_error_ =
      5.1 * kRoundingUnit * size_ + scale_ * (3.01 * pose.rotation_error() * q.max_coordinate() +
                                              1.01 * pose.translation_error());
  ChooseInterior(0, 0);
}

Eigen::Vector3d MinkowskiDifference::Difference(VertexPair to, VertexPair from,
                                                double* error) const {
  const Eigen::Vector3d in_p = PointOfP(to.p) - PointOfP(from.p);
  const Eigen::Vector3d in_q = PointOfQ(to.q) - PointOfQ(from.q);
  // Each difference is rounded once (relative), R times it three times more, the last sum once:
  // 5.01 u of |in_p_i| + sum |R_ij| |in_q_j| <= |in_p|_max + 1.75 |in_q|_max.
  const double p_max = in_p.cwiseAbs().maxCoeff();
  const double q_max = in_q.cwiseAbs().maxCoeff();
  *error = scale_ * (5.1 * kRoundingUnit * (p_max + kRowFactor * q_max) +
                     3.01 * pose_.rotation_error() * q_max) +
           0x1p-1000;
  return scale_ * (in_p - pose_.rotation() * in_q);
}

Eigen::Vector3d MinkowskiDifference::NormalToP(const Eigen::Vector3d& in_q) const {
  const Eigen::Matrix3d& r = pose_.rotation();
  return {r.row(1).cross(r.row(2)).dot(in_q), r.row(2).cross(r.row(0)).dot(in_q),
          r.row(0).cross(r.row(1)).dot(in_q)};
}

VertexPair MinkowskiDifference::Support(const Eigen::Vector3d& direction, VertexPair hint,
                                        PhaseCounts* counts) const {
  ++counts->support_calls;
  return {SupportVertex(p_, direction, hint.p, &counts->climb_steps),
          SupportVertex(q_, -DirectionToQ(direction), hint.q, &counts->climb_steps)};
}

void MinkowskiDifference::ChooseInterior(int i, int j) {
  interior_p_ = i;
  interior_q_ = j;
  c_ = Point(kInteriorDifference);
  c_norm_ = c_.norm();
}

void MinkowskiDifference::PlaceInterior(const Eigen::Vector3d& c) {
  c_ = c;
  c_norm_ = c.norm();
}

bool ChooseInteriorDifference(MinkowskiDifference* m) {
  const double smaller = std::min(m->p().diameter_bound(), m->q().diameter_bound());
  if (m->Unscale(m->c_norm()) >= 1e-3 * smaller) return true;
  int best_i = 0, best_j = 0;
  double best = m->c_norm();
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) {
      m->ChooseInterior(i, j);
      if (m->c_norm() > best) {
        best = m->c_norm();
        best_i = i;
        best_j = j;
      }
    }
  }
  m->ChooseInterior(best_i, best_j);
  return false;
}

}  // namespace touchstone
