// SPDX-License-Identifier: GPL-3.0-or-later
//
//   here                 meaning
//   D, B, U              P's frame times a positive scale: D P_a for P, B Q_b + U for Q, integers
//   M                    {D P_a - B Q_b - U}: the Minkowski difference in P's frame, scaled
//   c                    D P_i - B Q_j - U for the interior points i and j
//   v = -c               the direction of the ray; it is at c + s v
//   unit                 true length = integer length * 2^exponent / D
#ifndef TOUCHSTONE_EXACT_CONVERT_H_
#define TOUCHSTONE_EXACT_CONVERT_H_

#include <Eigen/Core>
#include <mutex>

#include "touchstone/core/base/relative_pose.h"
#include "touchstone/core/cd_dual/result.h"
#include "touchstone/exact/exact_body_data.h"
#include "touchstone/exact/integer.h"
#include "touchstone/exact/real.h"

namespace touchstone::exact {

// A placed pair as exact integers, and in doubles with a bound for filters. The doubles of bodies
// and pose are taken at their word. For a pose made from two world poses the truth is that of both
// world images, x_p = Rp^-1 (Rq x_q + tq - tp); everything is then scaled by det Rp > 0, so that
// adj Rp stands for the inverse and all stays integer.
class PlacedPair {
 public:
  // Keeps references to the bodies' data.
  PlacedPair(const ExactBodyData& p, const ExactBodyData& q, const RelativePose& pose,
             int interior_p, int interior_q);

  const ExactBodyData& p() const { return p_; }
  const ExactBodyData& q() const { return q_; }

  // D.
  const Integer& scale() const { return scale_; }
  const IntegerVector& c() const { return c_; }
  const IntegerVector& v() const { return v_; }

  // A vertex of M; less c. A `q` of -1 stands for Q's interior point.
  IntegerVector Difference(const VertexPair& pair) const;
  IntegerVector FromC(const VertexPair& pair) const;

  // The direction in Q's own frame along which Q is extreme where B Q is along n: B^T n.
  IntegerVector ToQ(const IntegerVector& n) const { return MultiplyTransposed(b_, n); }
  // The normal, in M's frame, of a plane of Q with normal n in Q's own frame: cof(B) n.
  IntegerVector NormalFromQ(const IntegerVector& n) const;
  // An edge of Q in M's frame: B e.
  IntegerVector VectorFromQ(const IntegerVector& e) const { return Multiply(b_, e); }

  // The value of n.x over D P_a, or over B Q_b + U.
  Integer ValueP(const IntegerVector& n, int a) const;
  Integer ValueQ(const IntegerVector& n_in_q, const IntegerVector& n, int b) const;

  // True length of an integer length.
  template <class Number>
  Number ToLength(const Number& length) const {
    return Scale(length / Number(scale_), exponent_);
  }
  // The other way.
  Real FromLength(const Real& length) const { return Scale(length * Real(scale_), -exponent_); }
  mpq_class ToLengthSquared(const Integer& squared) const;

  // Doubles of the placement, in true units: x_p = rotation x_q + translation and c. Every number
  // n.(p - rotation q - translation) or n.c that follows from them for a direction n with |n_i| <=
  // 1, its components off by 2^-52 of themselves, is off by at most `error`.
  const Eigen::Matrix3d& rotation() const { return rotation_; }
  const Eigen::Vector3d& translation() const { return translation_; }
  const Eigen::Vector3d& c_double() const { return c_double_; }
  double error() const { return error_; }

  // The size that relative errors refer to: the largest coordinates of both bodies and of the
  // translation, summed; for a pose from world poses also those of the two world translations.
  double size() const { return size_; }

 private:
  void SetFromPose(const RelativePose& pose);
  void SetFromWorld(const WorldPose& p, const WorldPose& q);
  void Align(int exponent_d, int exponent_b, int exponent_u);
  void SetDoubles(const RelativePose& pose);

  const ExactBodyData& p_;
  const ExactBodyData& q_;
  Integer scale_ = 1;  // D
  IntegerMatrix b_;
  IntegerVector u_;
  IntegerVector c_, v_;
  int interior_p_, interior_q_;
  int exponent_ = 0;
  Eigen::Matrix3d rotation_;
  Eigen::Vector3d translation_, c_double_;
  double error_ = 0.0, size_ = 0.0;
  mutable std::once_flag cofactors_once_;
  mutable IntegerMatrix cofactors_;
};

}  // namespace touchstone::exact

#endif  // TOUCHSTONE_EXACT_CONVERT_H_
