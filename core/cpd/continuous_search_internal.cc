// SPDX-License-Identifier: MIT
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "touchstone/core/cpd/continuous_solver_internal.h"
#include "touchstone/core/mesh/nearest_on_triangle.h"

namespace touchstone::internal {
namespace {

using Eigen::Vector3d;

// Solutions are good to some 1e-14 of the size over how nearly they are multiple.
constexpr double kSamePoint = 1e-10;

double SquaredDistance(const Vector3d& p, const LocalSum& sum, int triangle) {
  const auto& [a, b, c] = sum.triangles[triangle];
  return (NearestOnTriangle(p, sum.vertices[a], sum.vertices[b], sum.vertices[c]) - p)
      .squaredNorm();
}

}  // namespace

void ContinuousSolver::Search() {
  best_misfit_ = std::numeric_limits<double>::infinity();
  const double whole = 4.0 / pair_.scale();  // a ball of this radius holds M wherever it is in M
  for (int i = 0; i < options_.iteration_limit; ++i) {
    MakeLocalSum();
    const auto begin = Clock::now();
    const bool is_found = Project();
    result_.phong_ms += Since(begin);
    if (is_found) return;
    if (radius_ >= whole) {
      Approximate(ContinuousDepthStatus::kApproximate);
      return;
    }
  }
  Approximate(ContinuousDepthStatus::kLimit);
}

void ContinuousSolver::MakeLocalSum() {
  const auto begin = Clock::now();
  result_.ball = {at_, radius_};
  sum_ = &local_.Update(pose_, result_.ball);
  ++result_.iterations;
  result_.local_triangles = static_cast<int>(sum_->triangles.size());
  result_.minkowski_ms += Since(begin);
  surface_ = {sum_->vertices, sum_->triangles, sum_->neighbors, sum_->vertex_normals};
  if (options_.weights != NormalWeights::kAngle) {
    VertexNormals(sum_->vertices, sum_->triangles, options_.weights, sum_->triangle_normals,
                  &normals_);
    surface_.normals = normals_;
  }
}

bool ContinuousSolver::HasBorder(int triangle) const {
  const auto& corners = sum_->triangles[triangle];
  return std::any_of(corners.begin(), corners.end(),
                     [&](int v) { return sum_->is_border_vertex[v] != 0; });
}

bool ContinuousSolver::Project() {
  if (sum_->triangles.empty()) {
    if (part_ > 0) return true;
    radius_ *= options_.ball_growth;
    is_near_only_ = false;
    return false;
  }
  PhongPoint chosen;
  bool continues = false;
  if (options_.track_branch && last_ && last_->was_found) {
    continues = Nearest(last_->translation, branch_reach_, &chosen);
  }
  if (!continues && part_ > 0) return true;  // it is lost: nothing is found
  if (!continues && is_near_only_) {
    is_near_only_ = false;
    at_ = last_->translation;
    radius_ = std::max({radius_, options_.ball_ratio * at_.norm(), least_radius_});
    return false;
  }
  if (!continues && !Nearest(Vector3d::Zero(), 1e300, &chosen)) {
    MoveOn();
    return false;
  }
  if (HasBorder(chosen.triangle)) {
    // Its normals may lack triangles beyond the ball: a ball that holds it has them all.
    const Ball whole = BallOf(surface_, chosen.triangle);
    radius_ = std::max(radius_ + (whole.center - at_).norm(), 1.05 * whole.radius);
    at_ = whole.center;
    if (result_.iterations < options_.iteration_limit) return false;
  }
  Take(chosen, sum_->facets[sum_->facet_of_triangle[chosen.triangle]], continues,
       PatchAround(chosen.triangle));
  return true;
}

std::shared_ptr<const PatchShape> ContinuousSolver::PatchAround(int triangle) {
  if (!options_.keep_patch || !options_.track_branch || HasBorder(triangle)) return nullptr;
  const auto begin = Clock::now();
  auto shape = patch_.Make(pair_, a_, b_, *sum_, triangle);
  result_.minkowski_ms += Since(begin);
  result_.phong_ms -= Since(begin);  // which counts all of Project
  return shape;
}

bool ContinuousSolver::Nearest(const Vector3d& p, double reach, PhongPoint* chosen) {
  order_.clear();
  double best = reach < 1e150 ? reach * reach : std::numeric_limits<double>::infinity();
  for (int t = 0; t < result_.local_triangles; ++t) {
    const double squared = SquaredDistance(p, *sum_, t);
    if (squared <= best) order_.emplace_back(squared, t);
  }
  std::sort(order_.begin(), order_.end());
  PhongOptions phong;
  phong.interpolation = options_.interpolation;
  phong.find_all = true;
  bool is_found = false;
  // Others count where they may be taken for the branch.
  const double near = reach < 1e150 ? best : 0.0;
  double other = std::numeric_limits<double>::infinity();
  result_.solutions = 0;
  result_.is_nearest = true;
  for (const auto& [squared, t] : order_) {
    if (squared > best && squared > near) break;
    points_.clear();
    const PhongCount count = ProjectOntoTriangle(surface_, t, phong, &points_);
    result_.solutions += count.points;
    result_.is_nearest = result_.is_nearest && count.is_complete;
    for (const PhongPoint& point : points_) {
      const double distance = (point.position - p).squaredNorm();
      // On a side it is found by both triangles.
      const bool is_same =
          is_found && (point.position - chosen->position).norm() <= kSamePoint / pair_.scale();
      if (distance > best) {
        if (!is_same) other = std::min(other, distance);
        continue;
      }
      if (is_found && !is_same) other = std::min(other, best);
      best = distance;
      *chosen = point;
      is_found = true;
    }
  }
  other_ = std::sqrt(other);
  return is_found;
}

void ContinuousSolver::MoveOn() {
  int best = -1;
  double least = std::numeric_limits<double>::infinity();
  for (int t = 0; t < result_.local_triangles; ++t) {
    const auto& [a, b, c] = sum_->triangles[t];
    const Vector3d& corner = sum_->vertices[a];
    const Vector3d normal = (sum_->vertices[b] - corner).cross(sum_->vertices[c] - corner);
    if (!(normal.dot(corner) > 0.0)) continue;  // it faces inward, seen from the origin
    const double misfit = MisfitAtBarycentre(surface_, t, options_.interpolation);
    if (misfit < least) least = misfit, best = t;
  }
  if (best < 0) {
    radius_ *= options_.ball_growth;
    return;
  }
  const auto& [a, b, c] = sum_->triangles[best];
  const Vector3d middle = (sum_->vertices[a] + sum_->vertices[b] + sum_->vertices[c]) / 3.0;
  if (least < best_misfit_) {
    best_misfit_ = least;
    best_at_ = middle;
    best_facet_ = sum_->facets[sum_->facet_of_triangle[best]];
  }
  if ((middle - at_).norm() <= 1e-9 / pair_.scale()) {
    radius_ *= options_.ball_growth;
  } else {
    at_ = middle;
    radius_ = std::max({radius_, options_.ball_ratio * at_.norm(), least_radius_});
  }
}

}  // namespace touchstone::internal
