// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_BASE_RELATIVE_POSE_H_
#define TOUCHSTONE_CORE_BASE_RELATIVE_POSE_H_

#include <Eigen/Core>
#include <optional>
#include <utility>

#include "touchstone/core/base/status.h"

namespace touchstone {

// A body's placement in the world: x_world = rotation * x_body + translation.
struct WorldPose {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
};

// The placement of Q in P's frame: x_p = R x_q + t.
//
// The matrix and the vector are taken at their word: Q *is* the exact affine image of its vertices
// under these doubles, so a rotation that is off orthonormal by an ulp still asks an exact
// question. A pose made from two world poses keeps both, and the truth is then that of both exact
// images; the rounded R and t serve the floating-point search, with their distance from the exact
// relative pose in `rotation_error` and `translation_error`.
class RelativePose {
 public:
  RelativePose() = default;  // the identity

  // Returns the pose, or a status: kNonFinite, kOutOfRange (an entry of t above 1e100) or
  // kBadRotation (det R <= 0, or an entry of RᵀR - I above 1e-6), naming the row (of RᵀR there).
  // A pose passes or fails by the exact value of its entries.
  static StatusOr<RelativePose> Make(const Eigen::Matrix3d& rotation,
                                     const Eigen::Vector3d& translation);

  // Q's placement in P's frame from the placements of both in the world. Same errors as `Make`, for
  // either pose and for the relative translation.
  static StatusOr<RelativePose> FromWorld(const WorldPose& p, const WorldPose& q);

  const Eigen::Matrix3d& rotation() const { return rotation_; }
  const Eigen::Vector3d& translation() const { return translation_; }

  // Bounds on the entries: |R_ij - exact| <= rotation_error, |t_i - exact| <= translation_error.
  // Zero unless made from world poses.
  double rotation_error() const { return rotation_error_; }
  double translation_error() const { return translation_error_; }

  // The two world poses, when the pose was made from them: the definition of the truth.
  const std::optional<std::pair<WorldPose, WorldPose>>& world() const { return world_; }

 private:
  Eigen::Matrix3d rotation_ = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation_ = Eigen::Vector3d::Zero();
  double rotation_error_ = 0.0;
  double translation_error_ = 0.0;
  std::optional<std::pair<WorldPose, WorldPose>> world_;
};

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_BASE_RELATIVE_POSE_H_
