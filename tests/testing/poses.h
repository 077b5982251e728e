// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TESTS_TESTING_POSES_H_
#define TOUCHSTONE_TESTS_TESTING_POSES_H_

#include <Eigen/Core>

#include "touchstone/core/base/relative_pose.h"

namespace touchstone::testing {

// Of a rotation that Make accepts.
inline RelativePose PoseOf(const Eigen::Matrix3d& rotation,
                           const Eigen::Vector3d& translation = Eigen::Vector3d::Zero()) {
  return *RelativePose::Make(rotation, translation);
}

}  // namespace touchstone::testing

#endif  // TOUCHSTONE_TESTS_TESTING_POSES_H_
