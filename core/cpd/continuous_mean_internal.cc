// SPDX-License-Identifier: MIT
#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <memory>

#include "touchstone/core/cpd/continuous_solver_internal.h"

namespace touchstone::internal {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Of the ball in which ∂M is made, over the radius of the mean: room to walk twice as far as last.
constexpr double kLeastRoom = 0.05, kMostRoom = 0.25;
// Radians to either side for differences.
constexpr double kTurn = 0x1p-15;
// Of the rate's size: what differences to either side may differ by, where third derivatives and
// roundings leave no more than a hundredth of it. At a crease they differ by as much as they are.
constexpr double kCrease = 0x1p-8;

}  // namespace

void ContinuousSolver::SearchByMeanNormals() {
  best_misfit_ = std::numeric_limits<double>::infinity();
  PhongPoint found;
  if (options_.track_branch && last_ && last_->was_found && Walk(last_->translation, &found) &&
      (found.position - last_->translation).norm() <= branch_reach_) {
    TakeMean(found, true);
    return;
  }
  if (part_ > 0) return;
  const auto begin = Clock::now();
  const Vector3d nearest = MeshPenetrationDepth(pair_, a_, b_, {}, &depth_cache_).translation;
  result_.depth_ms += Since(begin);
  if (Walk(nearest, &found)) {
    TakeMean(found, false);
    return;
  }
  Approximate(ContinuousDepthStatus::kLimit);
}

// From a point on or near ∂M to a solution, in local sums that go with it.
bool ContinuousSolver::Walk(Vector3d from, PhongPoint* found) {
  MeanProjectionOptions mean;
  mean.radius_ratio = options_.normal_radius;
  mean.least_radius = least_radius_;
  const Vector3d begin_at = from;
  double room = 1.0 + std::clamp(2.0 * walked_, kLeastRoom, kMostRoom);
  for (int i = 0; i < options_.iteration_limit; ++i) {
    at_ = from;
    radius_ = room * std::max(mean.radius_ratio * from.norm(), mean.least_radius);
    MakeLocalSum();
    const auto begin = Clock::now();
    mean_normals_.Set(surface_);
    mean.center = at_;
    mean.reach = radius_;
    const MeanProjection projection = ProjectByMeanNormals(surface_, mean_normals_, from, mean);
    result_.phong_ms += Since(begin);
    if (projection.point.triangle < 0) {  // nothing of ∂M is near
      room *= options_.ball_growth;
      continue;
    }
    if (projection.status == MeanProjectionStatus::kLeft) {
      if (projection.point.position == from) room *= options_.ball_growth;
      from = projection.point.position;
      continue;
    }
    *found = projection.point;
    walked_ = room * (found->position - begin_at).norm() / radius_;
    if (projection.status == MeanProjectionStatus::kFound) return true;
    if (found->residual < best_misfit_) {
      best_misfit_ = found->residual;
      best_at_ = found->position;
      best_facet_ = sum_->facets[sum_->facet_of_triangle[found->triangle]];
    }
    return false;
  }
  return false;
}

void ContinuousSolver::TakeMean(const PhongPoint& point, bool continues) {
  result_.solutions = 1;
  result_.normal_radius = std::max(options_.normal_radius * point.position.norm(), least_radius_);
  Take(point, sum_->facets[sum_->facet_of_triangle[point.triangle]], continues, nullptr);
}

std::optional<Matrix3d> ContinuousSolver::MeanRateOfTurn() {
  if (turned_ == nullptr) {
    ContinuousDepthOptions options = options_;
    options.track_branch = true;
    turned_ = std::make_unique<ContinuousSolver>(a_.mesh(), b_.mesh(), options);
  }
  const auto at = [&](const Matrix3d& turn) -> std::optional<Vector3d> {
    const auto pose = RelativePose::Make(turn * pose_.rotation(), pose_.translation());
    if (!pose.ok()) return std::nullopt;
    turned_->set_state(last_);
    const ContinuousDepthResult result = turned_->Update(*pose);
    if (result.status != ContinuousDepthStatus::kFound || result.branch_ended) return std::nullopt;
    return result.translation;
  };
  const auto here = at(Matrix3d::Identity());
  if (!here) return std::nullopt;
  Matrix3d rate, bend;
  for (int k = 0; k < 3; ++k) {
    const auto turned = [&](double angle) {
      return at(Eigen::AngleAxisd(angle, Vector3d::Unit(k)).toRotationMatrix());
    };
    const auto before = turned(-kTurn), after = turned(kTurn);
    if (!before || !after) return std::nullopt;
    rate.col(k) = (*after - *before) / (2.0 * kTurn);
    bend.col(k) = (*after - *here - (*here - *before)) / kTurn;
  }
  if (!(bend.norm() <= kCrease * (rate.norm() + here->norm()))) return std::nullopt;
  return rate;
}

}  // namespace touchstone::internal
