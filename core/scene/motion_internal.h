// SPDX-License-Identifier: MIT
//
// How far a placed body reaches and how far it moves, as bounds that hold in any rounding mode.
#ifndef TOUCHSTONE_CORE_SCENE_MOTION_INTERNAL_H_
#define TOUCHSTONE_CORE_SCENE_MOTION_INTERNAL_H_

#include <Eigen/Core>

#include "touchstone/core/base/relative_pose.h"
#include "touchstone/core/base/status.h"
#include "touchstone/core/mesh/box_tree.h"
#include "touchstone/core/scene/shape.h"

namespace touchstone::internal {

// A world translation may be so large at most: then no relative translation is above the 1e100 that
// RelativePose takes (|Rp^-1 (tq - tp)| has entries below 2 sqrt(3) (1 + 1e-5) times this).
inline constexpr double kMaxWorldTranslation = 2.5e99;

// kOk, or what is wrong with a pose: kNonFinite, kOutOfRange, kBadRotation, naming the row; by the
// exact value of its entries, as RelativePose::Make. Complexity: O(1).
Status CheckWorldPose(const WorldPose& pose);

// At least the distance by which any point within `radius` of `middle` (body frame) moves when its
// body's pose goes from one to the other; zero if and only if the poses are equal.
double MotionBound(const WorldPose& from, const WorldPose& to, const Eigen::Vector3d& middle,
                   double radius);

// A box of the world that holds the placed part.
Box3 PlacedBox(const ScenePart& part, const WorldPose& pose);

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_SCENE_MOTION_INTERNAL_H_
