// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_BASE_EXACT_POSE_H_
#define TOUCHSTONE_CORE_BASE_EXACT_POSE_H_

#include <Eigen/Core>
#include <array>

#include "touchstone/core/base/dyadic.h"
#include "touchstone/core/base/relative_pose.h"

namespace touchstone {

// A placed pair with big numbers, in P's frame times one positive factor common to everything: 1,
// or det Rp when the pose was made from two world poses (the inverse of Rp is adj(Rp) / det Rp).
class ExactPose {
 public:
  explicit ExactPose(const RelativePose& pose);

  const Dyadic& factor() const { return factor_; }
  // factor * x, for a point or a difference of P's frame.
  DyadicVector FromP(const DyadicVector& x) const;
  // factor * (R x + t), for a point of Q's frame.
  DyadicVector PointFromQ(const DyadicVector& x) const;
  // factor * R x, for a difference of Q's frame.
  DyadicVector DifferenceFromQ(const DyadicVector& x) const;

 private:
  Dyadic factor_;
  std::array<DyadicVector, 3> matrix_;  // rows
  DyadicVector offset_;
  bool is_identity_ = false;
};

DyadicVector operator*(const Dyadic& factor, const DyadicVector& v);

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_BASE_EXACT_POSE_H_
