// SPDX-License-Identifier: MIT
//
// How far a rotation has gone from pose to pose, and how far it may go before a sign that was known
// can change.
#ifndef TOUCHSTONE_CORE_MINKOWSKI_ROTATION_TRAVEL_INTERNAL_H_
#define TOUCHSTONE_CORE_MINKOWSKI_ROTATION_TRAVEL_INTERNAL_H_

#include <Eigen/Core>
#include <array>
#include <optional>

#include "touchstone/core/base/relative_pose.h"

namespace touchstone::internal {

// The travel is the sum of the changes of the rotation, and of its cofactors, as matrices in the
// 2-norm: what was true with a slack s at travel T stays true until T + s.
class RotationTravel {
 public:
  // Goes to a pose. False if nothing that was found before holds: at the first pose, and where the
  // travel begins anew.
  bool GoTo(const RelativePose& pose);

  double travel() const { return travel_; }
  // How far round a feature it is worth while to list what it may come to meet.
  double reach() const { return reach_; }
  // What a sign's value in doubles may be off by.
  double margin() const { return margin_; }
  // Directions, and vectors along edges, of body 0 or 1 as the other sees them, B reversed.
  const Eigen::Matrix3d& directions(int side) const { return directions_[side]; }
  const Eigen::Matrix3d& along(int side) const { return along_[side]; }

  // How far the travel may go while a sign keeps whose value was v. Matrices change by no more than
  // the travel, but for the errors of both poses.
  double Until(double v) const {
    const double slack = v - 2.0 * margin_;
    return slack > 0.0 ? travel_ + slack : travel_;
  }
  // How far it may go while a list of all that lies within the reach is complete. The way between
  // the poses is taken straight from matrix to matrix: cofactors then stray from theirs by at most
  // a quarter of the square.
  double UntilReached() const {
    const double slack = 0.98 * reach_ - 2.0 * margin_;
    return slack > 0.0 ? travel_ + slack : travel_;
  }

 private:
  double travel_ = 0.0;
  double reach_ = 0.0;
  double margin_ = 0.0;
  std::array<Eigen::Matrix3d, 2> directions_, along_;
  std::optional<Eigen::Matrix3d> rotation_, cofactors_;
};

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_MINKOWSKI_ROTATION_TRAVEL_INTERNAL_H_
