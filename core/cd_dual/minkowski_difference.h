// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_CD_DUAL_MINKOWSKI_DIFFERENCE_H_
#define TOUCHSTONE_CORE_CD_DUAL_MINKOWSKI_DIFFERENCE_H_

#include <Eigen/Core>
#include <algorithm>
#include <bit>
#include <cstdint>

#include "touchstone/core/base/relative_pose.h"
#include "touchstone/core/cd_dual/result.h"
#include "touchstone/core/convex/convex_polyhedron.h"

namespace touchstone {

// Half a unit in the last place is 2^-53 to nearest; 2^-52 bounds the relative rounding error of
// one operation in every rounding mode, so bounds made of it hold whatever the host has set.
inline constexpr double kRoundingUnit = 0x1p-52;

// A vertex pair with p = -1 or q = -1 names the chosen interior point of that body instead.
inline constexpr int kInteriorPoint = -1;
inline constexpr VertexPair kInteriorDifference{kInteriorPoint, kInteriorPoint};  // c

// Corners of P and Q by their places in the support tables (support_table.h).
struct CornerPair {
  int p = 0, q = 0;
};

// M = P - Q as the floating-point searches see it: its vertices a - b in P's frame, multiplied by a
// power of two that brings the pair's size to about one, so that no product of three overflows or
// loses its bits to underflow, whatever the scale of the bodies. Signs, ratios and signed travels
// divided by lengths do not notice; `Unscale` takes lengths back.
//
// Holds references: a view for the length of one query.
class MinkowskiDifference {
 public:
  inline MinkowskiDifference(const ConvexPolyhedron& p, const ConvexPolyhedron& q,
                             const RelativePose& pose);
  MinkowskiDifference(const ConvexPolyhedron&, const ConvexPolyhedron&, RelativePose&&) = delete;

  const ConvexPolyhedron& p() const { return p_; }
  const ConvexPolyhedron& q() const { return q_; }
  const RelativePose& pose() const { return pose_; }

  // The point a - b of M, scaled. Each coordinate is within `coordinate_error` of the exact one.
  Eigen::Vector3d Point(VertexPair pair) const {
    const Eigen::Vector3d& b = PointOfQ(pair.q);
    return scale_ * (PointOfP(pair.p) - (pose_.rotation() * b + pose_.translation()));
  }
  // The same of two corners, without the lists of vertices.
  TOUCHSTONE_INLINE Eigen::Vector3d Point(CornerPair pair) const {
    const SupportTable::Corner& a = p_.support_table().corner(pair.p);
    const SupportTable::Corner& b = q_.support_table().corner(pair.q);
    return scale_ * (Eigen::Vector3d(a.x, a.y, a.z) -
                     (pose_.rotation() * Eigen::Vector3d(b.x, b.y, b.z) + pose_.translation()));
  }
  VertexPair Vertices(CornerPair pair) const {
    return {p_.support_table().vertex(pair.p), q_.support_table().vertex(pair.q)};
  }
  CornerPair Corners(VertexPair pair) const {
    return {p_.support_table().CornerOfVertex(pair.p), q_.support_table().CornerOfVertex(pair.q)};
  }
  double coordinate_error() const { return coordinate_error_; }

  // The difference of two points of M, scaled, formed feature by feature: (a' - a) - R (b' - b).
  // Each coordinate is within `*error` of the exact one, which shrinks with the features and
  // vanishes against the size of the bodies.
  Eigen::Vector3d Difference(VertexPair to, VertexPair from, double* error) const;

  // From Q's frame to P's: edges by R, normals by the cofactors of R.
  Eigen::Vector3d EdgeToP(const Eigen::Vector3d& in_q) const { return pose_.rotation() * in_q; }
  Eigen::Vector3d NormalToP(const Eigen::Vector3d& in_q) const;
  // A direction n of P's frame as Q sees it: n.(R x) = (Rᵀn).x.
  Eigen::Vector3d DirectionToQ(const Eigen::Vector3d& in_p) const {
    return pose_.rotation().transpose() * in_p;
  }

  // A vertex of M that is extreme along `direction` (P's frame), as SupportVertex proposes it.
  // `hint` starts the climbs where it names vertices.
  VertexPair Support(const Eigen::Vector3d& direction, VertexPair hint, PhaseCounts* counts) const;

  // The chosen interior point c of M (section 4.1), scaled, and its parts.
  const Eigen::Vector3d& c() const { return c_; }
  double c_norm() const { return c_norm_; }
  int interior_p() const { return interior_p_; }
  int interior_q() const { return interior_q_; }
  // Takes c from interior points i of P and j of Q.
  inline void ChooseInterior(int i, int j);
  // Takes the longest c of the four; false.
  bool ChooseLongestInterior();
  // Takes a point of M as c, scaled: for searches alone, since proofs know c by its interior
  // points.
  void PlaceInterior(const Eigen::Vector3d& c);

  const Eigen::Vector3d& PointOfP(int v) const {
    return v == kInteriorPoint ? p_.interior_point(interior_p_) : p_.vertex(v);
  }
  const Eigen::Vector3d& PointOfQ(int v) const {
    return v == kInteriorPoint ? q_.interior_point(interior_q_) : q_.vertex(v);
  }

  // The power of two by which lengths were multiplied.
  double scale() const { return scale_; }
  double Unscale(double length) const { return length * unscale_; }
  Eigen::Vector3d Unscale(const Eigen::Vector3d& x) const { return x * unscale_; }
  // The scaled size of the pair: max |coordinate of P| + max |coordinate of R Q| + |t|, at most 1.
  double size() const { return size_; }

 private:
  static constexpr double kRowFactor = 1.75;

  const ConvexPolyhedron& p_;
  const ConvexPolyhedron& q_;
  const RelativePose& pose_;
  double scale_, unscale_;  // one over the other, exactly
  double size_;
  double coordinate_error_;
  int interior_p_ = 0;
  int interior_q_ = 0;
  Eigen::Vector3d c_;
  double c_norm_ = 0.0;
};

// Section 4.1: c is one of the four differences of two interior points per body, away from o. The
// difference of the central points serves unless it is shorter than a thousandth of the smaller
// body; then the longest of the four does (they are not all o, since the two points of a body
// differ). Returns whether the central points served.
inline bool ChooseInteriorDifference(MinkowskiDifference* m);

// Part of every query: inline for its caller's sake.

MinkowskiDifference::MinkowskiDifference(const ConvexPolyhedron& p, const ConvexPolyhedron& q,
                                         const RelativePose& pose)
    : p_(p), q_(q), pose_(pose) {
  // A row of R has length at most 1 + 1e-6, so |(R x)_i| <= (1 + 1e-6) sqrt(3) max |x_j|.
  const double size = p.max_coordinate() + kRowFactor * q.max_coordinate() +
                      pose.translation().cwiseAbs().maxCoeff();
  // 2^-e for a size in [2^(e-1), 2^e): sizes are normal numbers within 1e-100 and 1e101.
  const std::uint64_t exponent = std::bit_cast<std::uint64_t>(size) >> 52;
  scale_ = std::bit_cast<double>((2045 - exponent) << 52);
  unscale_ = std::bit_cast<double>((exponent + 1) << 52);
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

void MinkowskiDifference::ChooseInterior(int i, int j) {
  interior_p_ = i;
  interior_q_ = j;
  c_ = Point(kInteriorDifference);
  c_norm_ = c_.norm();
}

bool ChooseInteriorDifference(MinkowskiDifference* m) {
  const double smaller = std::min(m->p().diameter_bound(), m->q().diameter_bound());
  return m->c_norm() >= 1e-3 * (m->scale() * smaller) || m->ChooseLongestInterior();
}

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_CD_DUAL_MINKOWSKI_DIFFERENCE_H_
