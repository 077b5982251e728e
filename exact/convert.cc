// SPDX-License-Identifier: GPL-3.0-or-later
#include "touchstone/exact/convert.h"

#include <algorithm>
#include <climits>

namespace touchstone::exact {
namespace {

IntegerMatrix ToInteger(const Eigen::Matrix3d& m, int exponent) {
  IntegerMatrix result;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) result[i][j] = exact::ToInteger(m(i, j), exponent);
  }
  return result;
}

// sum -= a . b.
void SubtractDot(const IntegerVector& a, const IntegerVector& b, Integer& sum) {
  for (int k = 0; k < 3; ++k) mpz_submul(sum.get_mpz_t(), a[k].get_mpz_t(), b[k].get_mpz_t());
}

double MaxAbs(const Eigen::Vector3d& v) { return v.cwiseAbs().maxCoeff(); }

}  // namespace

PlacedPair::PlacedPair(const ExactBodyData& p, const ExactBodyData& q, const RelativePose& pose,
                       int interior_p, int interior_q)
    : p_(p), q_(q), interior_p_(interior_p), interior_q_(interior_q) {
  if (pose.world().has_value()) {
    SetFromWorld(pose.world()->first, pose.world()->second);
  } else {
    SetFromPose(pose);
  }
  exponent_ = p.exponent;
  for (int k = 0; k < 3; ++k) {
    c_[k] = scale_ * p.interior[interior_p][k] - u_[k];
    SubtractDot(b_[k], q.interior[interior_q], c_[k]);
    v_[k] = -c_[k];
  }
  SetDoubles(pose);
}

void PlacedPair::SetFromPose(const RelativePose& pose) {
  const Eigen::Matrix3d& r = pose.rotation();
  const Eigen::Vector3d& t = pose.translation();
  const int exponent_r = CommonExponent(r.data(), 9, INT_MAX);
  const int exponent_t = CommonExponent(t.data(), 3, INT_MAX);
  b_ = ToInteger(r, exponent_r);
  u_ = exact::ToInteger(t, exponent_t);
  Align(p_.exponent, exponent_r + q_.exponent, exponent_t);
}

void PlacedPair::SetFromWorld(const WorldPose& p, const WorldPose& q) {
  const int exponent_rp = CommonExponent(p.rotation.data(), 9, INT_MAX);
  const int exponent_rq = CommonExponent(q.rotation.data(), 9, INT_MAX);
  const int exponent_t =
      CommonExponent(p.translation.data(), 3, CommonExponent(q.translation.data(), 3, INT_MAX));
  const IntegerMatrix rp = ToInteger(p.rotation, exponent_rp);
  const IntegerMatrix adjugate = Transposed(Cofactors(rp));
  scale_ = Determinant(rp[0], rp[1], rp[2]);
  b_ = Multiply(adjugate, ToInteger(q.rotation, exponent_rq));
  u_ = Multiply(adjugate, exact::ToInteger(q.translation, exponent_t) -
                              exact::ToInteger(p.translation, exponent_t));
  Align(3 * exponent_rp + p_.exponent, 2 * exponent_rp + exponent_rq + q_.exponent,
        exponent_t == INT_MAX ? INT_MAX : 2 * exponent_rp + exponent_t);
}

// Brings D P, B Q and U, with these exponents, to the smallest of them.
void PlacedPair::Align(int exponent_d, int exponent_b, int exponent_u) {
  const int common = std::min({exponent_d, exponent_b, exponent_u});
  const auto shift = [common](Integer& value, int exponent) {
    mpz_mul_2exp(value.get_mpz_t(), value.get_mpz_t(), static_cast<mp_bitcnt_t>(exponent - common));
  };
  shift(scale_, exponent_d);
  for (IntegerVector& row : b_) {
    for (Integer& value : row) shift(value, exponent_b);
  }
  if (exponent_u == INT_MAX) return;  // U is zero
  for (Integer& value : u_) shift(value, exponent_u);
}

// The bound. Let S = |p| + 3 |B| |q| + |t| for the largest sizes of coordinates and u = 2^-53. A
// component of B is off by 4u of itself, of n by 2u, of t and c by 4u. B^T n: three products and
// two sums, (4 + 2 + 3) u 3|B|; times q: (9 + 3) u 9 |B| |q|; n.p: 5u 3|p|; n.t and n.c: 9u 3|t|
// and 9u 3|c|, |c| <= S; the three final sums: 3u 3S. Together below 36u S + 27u S + 9u S < 128u S;
// twice that, should the host round in another mode.
void PlacedPair::SetDoubles(const RelativePose& pose) {
  if (pose.world().has_value()) {
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        rotation_(i, j) = Quotient(b_[i][j], scale_, p_.exponent - q_.exponent);
      }
      translation_[i] = Quotient(u_[i], scale_, p_.exponent);
    }
  } else {
    rotation_ = pose.rotation();
    translation_ = pose.translation();
  }
  for (int i = 0; i < 3; ++i) c_double_[i] = Quotient(c_[i], scale_, p_.exponent);
  const double b_max = rotation_.cwiseAbs().maxCoeff();
  error_ = 0x1p-45 * (p_.max_coordinate + 3 * b_max * q_.max_coordinate + MaxAbs(translation_));
  size_ = p_.max_coordinate + q_.max_coordinate + MaxAbs(pose.translation());
  if (pose.world().has_value()) {
    size_ += MaxAbs(pose.world()->first.translation) + MaxAbs(pose.world()->second.translation);
  }
}

IntegerVector PlacedPair::Difference(const VertexPair& pair) const {
  const IntegerVector& q = pair.q < 0 ? q_.interior[interior_q_] : q_.vertices[pair.q];
  IntegerVector result;
  for (int k = 0; k < 3; ++k) {
    result[k] = scale_ * p_.vertices[pair.p][k] - u_[k];
    SubtractDot(b_[k], q, result[k]);
  }
  return result;
}

IntegerVector PlacedPair::FromC(const VertexPair& pair) const {
  IntegerVector result = p_.vertices[pair.p] - p_.interior[interior_p_];
  for (Integer& value : result) value *= scale_;
  if (pair.q < 0) return result;
  const IntegerVector from_interior = q_.vertices[pair.q] - q_.interior[interior_q_];
  for (int k = 0; k < 3; ++k) SubtractDot(b_[k], from_interior, result[k]);
  return result;
}

IntegerVector PlacedPair::NormalFromQ(const IntegerVector& n) const {
  std::call_once(cofactors_once_, [this] { cofactors_ = Cofactors(b_); });
  return Multiply(cofactors_, n);
}

Integer PlacedPair::ValueP(const IntegerVector& n, int a) const {
  return scale_ * Dot(n, p_.vertices[a]);
}

Integer PlacedPair::ValueQ(const IntegerVector& n_in_q, const IntegerVector& n, int b) const {
  return Dot(n_in_q, q_.vertices[b]) + Dot(n, u_);
}

mpq_class PlacedPair::ToLengthSquared(const Integer& squared) const {
  mpq_class result(squared, Integer(scale_ * scale_));
  result.canonicalize();
  if (exponent_ >= 0) {
    mpq_mul_2exp(result.get_mpq_t(), result.get_mpq_t(), 2 * static_cast<mp_bitcnt_t>(exponent_));
  } else {
    mpq_div_2exp(result.get_mpq_t(), result.get_mpq_t(), 2 * static_cast<mp_bitcnt_t>(-exponent_));
  }
  return result;
}

}  // namespace touchstone::exact
