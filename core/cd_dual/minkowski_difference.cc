// SPDX-License-Identifier: MIT
#include "touchstone/core/cd_dual/minkowski_difference.h"

#include <Eigen/Geometry>

#include "touchstone/core/convex/support.h"

namespace touchstone {
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

void MinkowskiDifference::PlaceInterior(const Eigen::Vector3d& c) {
  c_ = c;
  c_norm_ = c.norm();
}

bool MinkowskiDifference::ChooseLongestInterior() {
  int best_i = 0, best_j = 0;
  double best = -1.0;
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) {
      ChooseInterior(i, j);
      if (c_norm_ > best) {
        best = c_norm_;
        best_i = i;
        best_j = j;
      }
    }
  }
  ChooseInterior(best_i, best_j);
  return false;
}

}  // namespace touchstone
