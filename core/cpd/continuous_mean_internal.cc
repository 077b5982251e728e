// SPDX-License-Identifier: MIT
#include <Eigen/Core>
#include <algorithm>
#include <limits>

#include "touchstone/core/cpd/continuous_solver_internal.h"

namespace touchstone::internal {
namespace {

using Eigen::Vector3d;

// Of the ball in which ∂M is made, over the radius of the mean: room for the walk.
constexpr double kBallRoom = 1.25;

}  // namespace

void ContinuousSolver::SearchByMeanNormals() {
  best_misfit_ = std::numeric_limits<double>::infinity();
  PhongPoint found;
  if (options_.track_branch && last_ && last_->was_found && Walk(last_->translation, &found) &&
      (found.position - last_->translation).norm() <= BranchReach()) {
    TakeMean(found, true);
    return;
  }
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
  double room = kBallRoom;
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

}  // namespace touchstone::internal
