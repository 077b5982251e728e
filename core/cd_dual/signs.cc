// SPDX-License-Identifier: MIT
#include "touchstone/core/cd_dual/signs.h"

#include <Eigen/Geometry>
#include <cmath>

namespace touchstone {
namespace {

int SignOf(double value) { return (value > 0.0) - (value < 0.0); }

// The sign of a value known to within `error`, if that settles it.
std::optional<int> Settled(double value, double error) {
  if (std::abs(value) > error) return SignOf(value);  // false for NaN
  return std::nullopt;
}

const double kSqrt3 = 1.7320508075688774;  // rounded up

}  // namespace

DyadicVector ExactDifference::Point(VertexPair pair) const {
  return pose_.FromP(ToDyadic(m_.PointOfP(pair.p))) -
         pose_.PointFromQ(ToDyadic(m_.PointOfQ(pair.q)));
}

DyadicVector ExactDifference::Edge(Body body, int to, int from) const {
  if (body == Body::kP) {
    return pose_.FromP(ToDyadic(m_.PointOfP(to)) - ToDyadic(m_.PointOfP(from)));
  }
  return pose_.DifferenceFromQ(ToDyadic(m_.PointOfQ(from)) - ToDyadic(m_.PointOfQ(to)));
}

const ExactDifference& Signs::exact() {
  if (!exact_) exact_.emplace(m_);
  return *exact_;
}

std::optional<int> Signs::Determinant(VertexPair x, VertexPair y, VertexPair z) {
  const Eigen::Vector3d a = m_.Point(x), b = m_.Point(y), c = m_.Point(z);
  // Rounding: a cross product's coordinate passes two roundings, the dot product three more, so
  // 5.01 u of the permanent of absolute values; a 3x3 permanent is at most 2/sqrt(3) < 1.16 times
  // the product of the rows' lengths: 6 u |a||b||c|. Data: each point is off by at most e = sqrt(3)
  // times the coordinate error; replacing one row at a time changes the determinant by at most e
  // (BC + AC + AB) with A, B, C the lengths plus e. The lengths are rounded: 1 % is left for that.
  const double e = kSqrt3 * m_.coordinate_error();
  const double la = a.norm() + e, lb = b.norm() + e, lc = c.norm() + e;
  const double error =
      1.01 * (6.0 * kRoundingUnit * la * lb * lc + e * (lb * lc + la * lc + la * lb)) + 0x1p-1000;
  if (const auto sign = Settled(a.dot(b.cross(c)), error)) return sign;
  if (const auto sign = HeightOverOrigin(x, y, z)) return sign;
  if (!exact_allowed()) return std::nullopt;
  ++exact_count_;
  const ExactDifference& big = exact();
  return touchstone::Determinant(big.Point(x), big.Point(y), big.Point(z)).sign();
}

std::optional<int> Signs::HeightOverOrigin(VertexPair x, VertexPair y, VertexPair z) const {
  // det [x y z] = n . x with n = (y - x) x (z - x), formed from differences: for a sliver, n is
  // short and its error shorter still, where the product of the three lengths is not. The bound is
  // that of a dot product with both sides off: 3.01 u sum |n_i x_i| + E sum |n_i| + dn sum |x_i|.
  const FacetPlane plane = Plane({x, y, z});
  const Eigen::Vector3d a = m_.Point(x);
  const double ln = plane.normal.lpNorm<1>() + 3.0 * plane.normal_error;
  const double error = 1.01 * (3.1 * kRoundingUnit * ln * a.cwiseAbs().maxCoeff() +
                               ln * m_.coordinate_error() + plane.normal_error * a.lpNorm<1>()) +
                       0x1p-1000;
  return Settled(plane.normal.dot(a), error);
}

std::optional<int> Signs::AlongDirection(const Eigen::Vector3d& n, VertexPair w) {
  const Eigen::Vector3d a = m_.Point(w);
  // Three roundings of the dot product, and the point's own error: sum |n_i| (3.01 u |a_i| + E).
  const double length = n.lpNorm<1>();
  const double error =
      1.01 * length * (3.1 * kRoundingUnit * a.cwiseAbs().maxCoeff() + m_.coordinate_error());
  if (const auto sign = Settled(n.dot(a), error + 0x1p-1000 * length)) return sign;
  if (!exact_allowed()) return std::nullopt;
  ++exact_count_;
  return Dot(ToDyadic(n), exact().Point(w)).sign();
}

FacetPlane Signs::Plane(const std::array<VertexPair, 3>& points) const {
  FacetPlane plane;
  plane.points = points;
  double error_u = 0.0, error_v = 0.0;
  const Eigen::Vector3d u = m_.Difference(points[1], points[0], &error_u);
  const Eigen::Vector3d v = m_.Difference(points[2], points[0], &error_v);
  plane.normal = u.cross(v);
  // A coordinate is u_i v_j - u_j v_i: two roundings of each product's path, 2.01 u of the absolute
  // terms, at most 2 |u||v| (in maximum norm); the data errors add at most 2 (|u| e_v + |v| e_u +
  // e_u e_v).
  const double lu = u.cwiseAbs().maxCoeff() + error_u, lv = v.cwiseAbs().maxCoeff() + error_v;
  plane.normal_error =
      1.01 * (4.1 * kRoundingUnit * lu * lv + 2.0 * (lu * error_v + lv * error_u)) + 0x1p-1000;
  return plane;
}

std::optional<int> Signs::AlongNormal(FacetPlane* plane, Body body, int to, int from) {
  if (to == from) return 0;
  double error = 0.0;
  const Eigen::Vector3d edge = body == Body::kP ? m_.Difference({to, 0}, {from, 0}, &error)
                                                : m_.Difference({0, to}, {0, from}, &error);
  // n.e with n off by dn and e off by de in each coordinate: 3.01 u sum |n_i e_i| + dn sum |e_i| +
  // de sum (|n_i| + dn).
  const double le = edge.lpNorm<1>(), ln = plane->normal.lpNorm<1>() + 3.0 * plane->normal_error;
  const double largest = edge.cwiseAbs().maxCoeff();
  const double bound =
      1.01 * (3.1 * kRoundingUnit * ln * largest + plane->normal_error * le + ln * error) +
      0x1p-1000;
  if (const auto sign = Settled(plane->normal.dot(edge), bound)) return sign;
  if (!exact_allowed()) return std::nullopt;
  ++exact_count_;
  const ExactDifference& big = exact();
  if (!plane->exact_normal) {
    const DyadicVector origin = big.Point(plane->points[0]);
    plane->exact_normal =
        Cross(big.Point(plane->points[1]) - origin, big.Point(plane->points[2]) - origin);
  }
  return Dot(*plane->exact_normal, big.Edge(body, to, from)).sign();
}

}  // namespace touchstone
