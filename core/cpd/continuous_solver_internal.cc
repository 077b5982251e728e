// SPDX-License-Identifier: MIT
#include "touchstone/core/cpd/continuous_solver_internal.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <utility>

#include "touchstone/core/cpd/contact_name_internal.h"

namespace touchstone::internal {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// A solution moves no faster than its rate says, times this: between frames the rate itself
// changes. Beyond, it is another one.
constexpr double kBranchReach = 16.0;
// What it moves by where nothing but the rate's own change comes on top.
constexpr double kSmoothReach = 2.0;
// And by which the rate itself changes, either way: it grows without bound where solutions meet.
constexpr double kRateChange = 2.0;
// Parts that a motion is halved into, at most.
constexpr int kParts = 1024;
// In one it is looked for this much farther than it is sure, and accepted there in the last.
constexpr double kPartReach = 4.0;
// And answers for them: what is not followed in so many is given up.
constexpr int kAnswers = 64;
// A part is as good where the solution goes on as in the part before it, but for this.
constexpr double kSteady = 0.5;
// What solutions move by roundings, over the size.
constexpr double kStill = 1e-12;
// The first ball has room for this much of it; if the branch is not there, the next has for α|q|.
constexpr double kBallPart = 0.125;
// The least ball, over the size of the pair: at a shallow touch α|q| would vanish.
constexpr double kLeastBall = 1e-4;
// Off the surface, over the size: far above the roundings of membership, as for the depth.
constexpr double kStep = 0x1p-40;
// Radians to either side for differences: solutions are good to some 1e-14 of the size, which this
// makes 1e-8; what is left out is its square times third derivatives, large near a fold only.
constexpr double kTurn = 0x1p-20;

}  // namespace

Ball BallOf(const PhongSurface& surface, int triangle) {
  const auto& [a, b, c] = surface.triangles[triangle];
  const Vector3d corners[] = {surface.vertices[a], surface.vertices[b], surface.vertices[c]};
  const auto round = [&](const Vector3d& center) {
    double radius = 0.0;
    for (const Vector3d& corner : corners) radius = std::max(radius, (corner - center).norm());
    return Ball{center, radius};
  };
  Ball best = round((corners[0] + corners[1] + corners[2]) / 3.0);
  for (int k = 0; k < 3; ++k) {
    const Ball ball = round(0.5 * (corners[k] + corners[(k + 1) % 3]));
    if (ball.radius < best.radius) best = ball;
  }
  return best;
}

ContinuousDepthResult ContinuousSolver::Update(const RelativePose& pose) {
  const auto begin = Clock::now();
  const std::optional<ContinuousDepthState> before = last_;
  Answer(pose);
  if (before && before->was_found && options_.track_branch &&
      result_.status == ContinuousDepthStatus::kFound && result_.branch == before->branch &&
      !IsSure(*before)) {
    AnswerInParts(*before);
  }
  result_.total_ms = Since(begin);
  return result_;
}

void ContinuousSolver::Answer(const RelativePose& pose) {
  result_ = {};
  pose_ = pose;
  result_.branch = branch_;
  other_ = std::numeric_limits<double>::infinity();
  if (!Begin() || FollowPatch()) return;
  if (options_.normal_radius > 0.0) {
    SearchByMeanNormals();
  } else {
    Search();
  }
}

// A normal that turns is an origin that moves sideways by as much of q.
double ContinuousSolver::SureReach(const ContinuousDepthState& before) const {
  const double turn = (pose_.rotation() - before.pose.rotation()).norm();
  const double motion = MotionSince(before) + turn * before.translation.norm();
  // On the same triangles by name the solution moves as smoothly as they do, and with mean normals
  // as smoothly as M.
  const bool is_smooth = result_.iterations == 0 || options_.normal_radius > 0.0;
  const double reach = is_smooth ? kSmoothReach : options_.sure_reach;
  return reach * (1.0 + before.rate) * motion + kStill / pair_.scale();
}

bool ContinuousSolver::IsSure(const ContinuousDepthState& before) const {
  const double reach = SureReach(before);
  const double change = (1.0 + last_->rate) / (1.0 + before.rate);
  if (!(change <= kRateChange && change * kRateChange >= 1.0)) return false;
  return result_.index == before.index && result_.index != 0 && other_ > reach &&
         (result_.translation - before.translation).norm() <= reach;
}

void ContinuousSolver::AnswerInParts(const ContinuousDepthState& before) {
  const RelativePose to = pose_;
  const Eigen::Quaterniond first(before.pose.rotation()), last(to.rotation());
  const auto at = [&](int done) {
    const double s = static_cast<double>(done) / kParts;
    return RelativePose::Make(first.slerp(s, last).toRotationMatrix(),
                              (1.0 - s) * before.pose.translation() + s * to.translation());
  };
  double depth_ms = result_.depth_ms, minkowski_ms = result_.minkowski_ms,
         phong_ms = result_.phong_ms;
  ContinuousDepthState here = before;
  std::optional<Vector3d> velocity;  // of the part before
  int parts = 0;
  int answers = 0;
  for (int done = 0, part = kParts / 2; done < kParts;) {
    last_ = here;
    branch_ = before.branch;
    part_ = part;
    const auto pose = at(done + part);
    if (pose.ok()) Answer(done + part == kParts ? to : *pose);
    depth_ms += result_.depth_ms;
    minkowski_ms += result_.minkowski_ms;
    phong_ms += result_.phong_ms;
    const bool continues = pose.ok() && result_.status == ContinuousDepthStatus::kFound &&
                           result_.branch == before.branch && result_.index != -before.index;
    const Vector3d moved = (result_.translation - here.translation) / part;
    const bool goes_on = continues && velocity && other_ > 2.0 * part * moved.norm() &&
                         (moved - *velocity).norm() <= kSteady * velocity->norm();
    const bool is_sure = goes_on || (continues && IsSure(here));
    const bool is_last = ++answers == kAnswers && done + part < kParts;
    if (!is_sure && part > 1 && !is_last) {
      part /= 2;
      continue;
    }
    if (!continues || is_last) {
      part_ = 0;
      last_ = before;
      branch_ = before.branch;
      Answer(to);
      if (last_ && result_.branch == before.branch) result_.branch = last_->branch = ++branch_;
      result_.branch_ended = true;
      break;
    }
    done += part;
    here = *last_;
    velocity = moved;
    ++parts;
    // Twice as far where that ends with a larger part.
    if (is_sure && done % (2 * part) == 0) part *= 2;
  }
  part_ = 0;
  if (!result_.branch_ended) result_.combinatorics_changed = before.features != result_.features;
  result_.parts = std::max(parts, 1);
  result_.depth_ms = depth_ms;
  result_.minkowski_ms = minkowski_ms;
  result_.phong_ms = phong_ms;
}

void ContinuousSolver::Forget() {
  last_.reset();
  depth_cache_.Clear();
}

void ContinuousSolver::set_state(const std::optional<ContinuousDepthState>& state) {
  last_ = state;
  if (state) branch_ = state->branch;
}

std::optional<PhongPatch> ContinuousSolver::patch() const {
  if (!last_ || result_.status != ContinuousDepthStatus::kFound) return std::nullopt;
  PhongPatch patch;
  patch.at = last_->at;
  if (result_.iterations == 0) {
    const PatchShape& kept = *last_->patch;
    patch.facets = kept.facets;
    patch.names = kept.names;
    patch.triangles = kept.triangles;
    patch.facet_of_triangle = kept.facet_of_triangle;
    return patch;
  }
  patch.facets = sum_->facets;
  patch.names = sum_->names;
  const auto& own = sum_->triangles[triangle_];
  const auto add = [&](int t) {
    patch.triangles.push_back(sum_->triangles[t]);
    patch.facet_of_triangle.push_back(sum_->facet_of_triangle[t]);
  };
  add(triangle_);
  for (int t = 0; t < static_cast<int>(sum_->triangles.size()); ++t) {
    const auto& corners = sum_->triangles[t];
    if (t == triangle_) continue;
    if (options_.normal_radius > 0.0 ||
        std::find_first_of(corners.begin(), corners.end(), own.begin(), own.end()) !=
            corners.end()) {
      add(t);
    }
  }
  return patch;
}

std::optional<Vector3d> ContinuousSolver::OnPatchAt(const RelativePose& pose) {
  pair_.Place(pose);
  if (!turned_patch_.Place(pair_, a_, b_, *last_->patch)) return std::nullopt;
  PhongOptions phong;
  phong.interpolation = options_.interpolation;
  phong.begin_at = last_->at;
  points_.clear();
  ProjectOntoTriangle(turned_patch_.Surface(pair_, *last_->patch, options_.weights), 0, phong,
                      &points_);
  std::optional<Vector3d> nearest;
  for (const PhongPoint& point : points_) {
    const Vector3d &q = point.position, &last = last_->translation;
    if (!nearest || (q - last).norm() < (*nearest - last).norm()) nearest = q;
  }
  return nearest;
}

std::optional<Matrix3d> ContinuousSolver::RateOfTurn() {
  if (result_.status != ContinuousDepthStatus::kFound || !result_.rate_of_translation || !last_) {
    return std::nullopt;
  }
  if (options_.normal_radius > 0.0) return MeanRateOfTurn();
  if (last_->patch == nullptr) return std::nullopt;
  std::optional<Matrix3d> rate = Matrix3d(Matrix3d::Zero());
  for (int k = 0; k < 3 && rate; ++k) {
    const auto at = [&](double angle) -> std::optional<Vector3d> {
      const Matrix3d turn = Eigen::AngleAxisd(angle, Vector3d::Unit(k)).toRotationMatrix();
      const auto pose = RelativePose::Make(turn * pose_.rotation(), pose_.translation());
      if (!pose.ok()) return std::nullopt;
      return OnPatchAt(*pose);
    };
    const auto before = at(-kTurn), after = at(kTurn);
    if (before && after) {
      rate->col(k) = (*after - *before) / (2.0 * kTurn);
    } else {
      rate.reset();
    }
  }
  pair_.Place(pose_);
  return rate;
}

bool ContinuousSolver::Begin() {
  const auto begin = Clock::now();
  pair_.Place(pose_);
  const Verdict verdict =
      Membership(pair_, Vector3d(Vector3d::Zero()), {}, &membership_cache_).verdict;
  if (verdict != Verdict::kOverlap) {
    last_.reset();
    result_.depth_ms = Since(begin);
    return false;
  }
  least_radius_ = kLeastBall / pair_.scale();
  is_near_only_ = false;
  if (last_) {
    branch_reach_ = part_ > 0 ? kPartReach * SureReach(*last_) : BranchReach();
    at_ = last_->translation;
    radius_ = std::max(options_.ball_ratio * at_.norm(), least_radius_);
    if (options_.track_branch && last_->was_found) {
      // To follow a branch it takes no more of ∂M than the triangle that it was on, and where it
      // can have gone.
      is_near_only_ = true;
      at_ = last_->triangle.center;
      const double room = part_ > 0 ? branch_reach_ : kBallPart * branch_reach_;
      radius_ = last_->triangle.radius + std::max(room, least_radius_);
    }
  } else {
    at_ = MeshPenetrationDepth(pair_, a_, b_, {}, &depth_cache_).translation;
    radius_ = std::max(options_.ball_ratio * at_.norm(), least_radius_);
  }
  result_.depth_ms = Since(begin);
  return true;
}

bool ContinuousSolver::FollowPatch() {
  if (!last_ || !last_->was_found || last_->patch == nullptr || !options_.track_branch) {
    return false;
  }
  const auto begin = Clock::now();
  const std::shared_ptr<const PatchShape> shape = last_->patch;
  const bool holds = patch_.Follow(pair_, a_, b_, *shape);
  result_.minkowski_ms += Since(begin);
  if (!holds) return false;
  const auto begin_phong = Clock::now();
  surface_ = patch_.Surface(pair_, *shape, options_.weights);
  PhongOptions phong;
  phong.interpolation = options_.interpolation;
  phong.find_all = true;
  points_.clear();
  result_.is_nearest = ProjectOntoTriangle(surface_, 0, phong, &points_).is_complete;
  const PhongPoint* chosen = nullptr;
  double best = branch_reach_;
  for (const PhongPoint& point : points_) {
    const double distance = (point.position - last_->translation).norm();
    if (distance < best) {
      other_ = chosen != nullptr ? best : other_;
      best = distance, chosen = &point;
    } else {
      other_ = std::min(other_, distance);
    }
  }
  result_.phong_ms += Since(begin_phong);
  if (chosen == nullptr || !IsOutside(*chosen, patch_.NormalOf(shape->facet_of_triangle[0]))) {
    return false;
  }
  result_.local_triangles = static_cast<int>(shape->triangles.size());
  result_.solutions = static_cast<int>(points_.size());
  result_.ball = BallOf(surface_, 0);
  Take(*chosen, shape->facets[shape->facet_of_triangle[0]], true, shape);
  return true;
}

bool ContinuousSolver::IsOutside(const PhongPoint& point, const Vector3d& normal) {
  const auto begin = Clock::now();
  const Vector3d x = point.position + (kStep / pair_.scale()) * normal;
  const Verdict verdict =
      Membership(pair_, x, {Certainty::kFloat}, &surface_membership_cache_).verdict;
  result_.minkowski_ms += Since(begin);
  return verdict == Verdict::kSeparate;
}

double ContinuousSolver::MotionSince(const ContinuousDepthState& before) const {
  return ((pose_.rotation() - before.pose.rotation()) * before.contact + pose_.translation() -
          before.pose.translation())
      .norm();
}

double ContinuousSolver::BranchReach() const {
  return kBranchReach * (1.0 + last_->rate) * MotionSince(*last_) + kStill / pair_.scale();
}

void ContinuousSolver::Take(const PhongPoint& point, const SumFacet& facet, bool continues,
                            std::shared_ptr<const PatchShape> patch) {
  result_.status = ContinuousDepthStatus::kFound;
  result_.residual = point.residual;
  triangle_ = point.triangle;
  if (point.rate) {
    // B moved by δ moves M by -δ: the origin moves by δ in M, and q by that less.
    result_.rate_of_translation = *point.rate - Matrix3d::Identity();
  }
  const Ball triangle = BallOf(surface_, point.triangle);
  result_.corner_angle = CornerAngle(surface_, point.triangle);
  SetTranslation(point.position, facet);
  result_.index = point.index;
  SetBranch(continues, &point, triangle);
  last_->at = point.at;
  last_->patch = std::move(patch);
}

void ContinuousSolver::Approximate(ContinuousDepthStatus status) {
  result_.status = status;
  if (best_misfit_ > 1.0) {  // nothing of ∂M was met
    result_.residual = 1.0;
    last_.reset();
    const MeshDepthResult depth = MeshPenetrationDepth(pair_, a_, b_, {}, &depth_cache_);
    result_.translation = depth.translation;
    result_.direction = depth.translation.stableNormalized();
    return;
  }
  result_.residual = best_misfit_;
  SetTranslation(best_at_, best_facet_);
  SetBranch(false, nullptr, {best_at_, 0.0});
}

void ContinuousSolver::SetTranslation(const Vector3d& q, const SumFacet& facet) {
  result_.translation = q;
  result_.direction = q.stableNormalized();
  result_.features = facet;
  result_.point_on_a = ContactPointOnA(pair_, facet, pair_.scale() * q) / pair_.scale();
  result_.point_on_b = result_.point_on_a - q;
}

void ContinuousSolver::SetBranch(bool continues, const PhongPoint* found, const Ball& triangle) {
  result_.branch_ended = last_.has_value() && last_->was_found && !continues;
  result_.combinatorics_changed = last_.has_value() && last_->features != result_.features;
  if (!continues) ++branch_;
  result_.branch = branch_;
  const Vector3d contact =
      pose_.rotation().transpose() * (result_.point_on_b - pose_.translation());
  last_ = ContinuousDepthState{pose_,
                               result_.translation,
                               found != nullptr && found->rate ? found->rate->norm() : 1.0,
                               found != nullptr ? found->index : 0,
                               triangle,
                               contact,
                               result_.features,
                               found != nullptr,
                               branch_,
                               Vector3d::Constant(1.0 / 3.0),
                               nullptr};
}

}  // namespace touchstone::internal
