// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_PROXIMITY_VALIDATE_INTERNAL_H_
#define TOUCHSTONE_CORE_PROXIMITY_VALIDATE_INTERNAL_H_

#include <Eigen/Core>

#include "touchstone/core/base/status.h"

namespace touchstone::internal {

// kNonFinite, or kOutOfRange where |s| is not within [1e-100, 1e100].
Status CheckDirection(const Eigen::Vector3d& s);

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_PROXIMITY_VALIDATE_INTERNAL_H_
