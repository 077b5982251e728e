// SPDX-License-Identifier: MIT
#include "touchstone/core/base/exact_pose.h"

namespace touchstone {
namespace {

using Rows = std::array<DyadicVector, 3>;

Rows ToRows(const Eigen::Matrix3d& m) {
  return {ToDyadic(m.row(0)), ToDyadic(m.row(1)), ToDyadic(m.row(2))};
}

DyadicVector Multiply(const Rows& rows, const DyadicVector& x) {
  return {Dot(rows[0], x), Dot(rows[1], x), Dot(rows[2], x)};
}

// adj(A), with A adj(A) = det(A) I: its columns are the cross products of A's rows.
Rows Adjugate(const Rows& a) {
  const DyadicVector x = Cross(a[1], a[2]), y = Cross(a[2], a[0]), z = Cross(a[0], a[1]);
  return {DyadicVector{x[0], y[0], z[0]}, DyadicVector{x[1], y[1], z[1]},
          DyadicVector{x[2], y[2], z[2]}};
}

Rows Multiply(const Rows& a, const Rows& b) {
  Rows product;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) product[i][j] = Dot(a[i], {b[0][j], b[1][j], b[2][j]});
  }
  return product;
}

}  // namespace

ExactPose::ExactPose(const RelativePose& pose) : factor_(1) {
  if (!pose.world()) {
    matrix_ = ToRows(pose.rotation());
    offset_ = ToDyadic(pose.translation());
    is_identity_ = pose.rotation() == Eigen::Matrix3d::Identity();
    return;
  }
  const auto& [p, q] = *pose.world();
  const Rows rotation_p = ToRows(p.rotation);
  const Rows adjugate = Adjugate(rotation_p);
  factor_ = Determinant(rotation_p[0], rotation_p[1], rotation_p[2]);
  matrix_ = Multiply(adjugate, ToRows(q.rotation));
  offset_ = Multiply(adjugate, ToDyadic(q.translation) - ToDyadic(p.translation));
}

DyadicVector ExactPose::FromP(const DyadicVector& x) const { return factor_ * x; }

DyadicVector ExactPose::PointFromQ(const DyadicVector& x) const {
  return DifferenceFromQ(x) + offset_;
}

DyadicVector ExactPose::DifferenceFromQ(const DyadicVector& x) const {
  return is_identity_ ? x : Multiply(matrix_, x);
}

DyadicVector operator*(const Dyadic& factor, const DyadicVector& v) {
  return {factor * v[0], factor * v[1], factor * v[2]};
}

}  // namespace touchstone
