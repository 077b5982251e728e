// SPDX-License-Identifier: MIT
#include "touchstone/core/cpd/continuous_penetration_depth.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "touchstone/core/cpd/contact_body.h"
#include "touchstone/core/cpd/contact_name_internal.h"
#include "touchstone/core/cpd/kept_patch_internal.h"
#include "touchstone/core/cpd/mesh_penetration_depth.h"
#include "touchstone/core/mesh/membership.h"

namespace touchstone {
namespace {

using Clock = std::chrono::steady_clock;
using Eigen::Matrix3d;
using Eigen::Vector3d;

double Since(Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

// A solution moves no faster than its rate says, times this: between frames the rate itself
// changes. Beyond, it is another one.
constexpr double kBranchReach = 16.0;
// The first ball has room for this much of it; if the branch is not there, the next has for α|q|.
constexpr double kBallPart = 0.125;
// The least ball, over the size of the pair: at a shallow touch α|q| would vanish.
constexpr double kLeastBall = 1e-4;
// Off the surface, over the size: far above the roundings of membership, as for the depth.
constexpr double kStep = 0x1p-40;

double SquaredDistanceTo(const Vector3d& p, const Vector3d& a, const Vector3d& b,
                         const Vector3d& c) {
  const Vector3d normal = (b - a).cross(c - a);
  if (normal.dot((b - a).cross(p - a)) > 0.0 && normal.dot((c - b).cross(p - b)) > 0.0 &&
      normal.dot((a - c).cross(p - c)) > 0.0) {
    const double height = normal.dot(p - a);
    return height * height / normal.squaredNorm();
  }
  double least = std::numeric_limits<double>::infinity();
  const Vector3d* ends[] = {&a, &b, &c, &a};
  for (int k = 0; k < 3; ++k) {
    const Vector3d side = *ends[k + 1] - *ends[k];
    const double squared = side.squaredNorm();
    const double t = squared > 0.0 ? std::clamp((p - *ends[k]).dot(side) / squared, 0.0, 1.0) : 0.0;
    least = std::min(least, (*ends[k] + t * side - p).squaredNorm());
  }
  return least;
}

}  // namespace

std::string_view ToString(ContinuousDepthStatus status) {
  constexpr std::string_view kNames[] = {"separate", "found", "approximate", "limit"};
  return kNames[static_cast<int>(status)];
}

class ContinuousPenetrationDepth::Implementation {
 public:
  Implementation(TriangleMesh a, TriangleMesh b, const ContinuousDepthOptions& options)
      : options_(options),
        a_(a),
        b_(b),
        pair_(a, b, RelativePose()),
        local_(std::move(a), std::move(b), {options.builder}) {}

  void Forget() {
    last_.reset();
    depth_cache_.Clear();
  }

  const LocalSum& local_sum() const { return local_.sum(); }
  const std::optional<ContinuousDepthState>& state() const { return last_; }
  void set_state(const std::optional<ContinuousDepthState>& state) {
    last_ = state;
    if (state) branch_ = state->branch;
  }

  ContinuousDepthResult Update(const RelativePose& pose) {
    const auto begin = Clock::now();
    result_ = {};
    pose_ = pose;
    result_.branch = branch_;
    if (Begin() && !FollowPatch()) Search();
    result_.total_ms = Since(begin);
    return result_;
  }

 private:
  // Line 2 to 6: where to begin. False if there is no overlap.
  bool Begin() {
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
      at_ = last_->translation;
      radius_ = std::max(options_.ball_ratio * at_.norm(), least_radius_);
      if (options_.track_branch && last_->was_found) {
        // To follow a branch it takes no more of ∂M than the triangle that it was on, and where it
        // can have gone.
        is_near_only_ = true;
        at_ = last_->triangle.center;
        radius_ = last_->triangle.radius + std::max(kBallPart * BranchReach(), least_radius_);
      }
    } else {
      at_ = MeshPenetrationDepth(pair_, a_, b_, {}, &depth_cache_).translation;
      radius_ = std::max(options_.ball_ratio * at_.norm(), least_radius_);
    }
    result_.depth_ms = Since(begin);
    return true;
  }

  // Looks for the branch on the triangles that it was on before, if they are still what they were.
  bool FollowPatch() {
    if (!last_ || !last_->was_found || last_->patch == nullptr || !options_.track_branch) {
      return false;
    }
    const auto begin = Clock::now();
    const std::shared_ptr<const internal::PatchShape> shape = last_->patch;
    const bool holds = patch_.Follow(pair_, a_, b_, *shape);
    result_.minkowski_ms += Since(begin);
    if (!holds) return false;
    const auto begin_phong = Clock::now();
    surface_ = patch_.Surface(pair_, *shape, options_.weights);
    PhongOptions phong;
    phong.interpolation = options_.interpolation;
    phong.begin_at = last_->at;
    points_.clear();
    ProjectOntoTriangle(surface_, 0, phong, &points_);
    const PhongPoint* chosen = nullptr;
    double best = BranchReach();
    for (const PhongPoint& point : points_) {
      const double distance = (point.position - last_->translation).norm();
      if (distance < best) best = distance, chosen = &point;
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

  // Whether there is no overlap a step off the surface: it is not buried.
  bool IsOutside(const PhongPoint& point, const Vector3d& normal) {
    const auto begin = Clock::now();
    const Vector3d x = point.position + (kStep / pair_.scale()) * normal;
    const Verdict verdict =
        Membership(pair_, x, {Certainty::kFloat}, &surface_membership_cache_).verdict;
    result_.minkowski_ms += Since(begin);
    return verdict == Verdict::kSeparate;
  }

  void Search() {
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

  void MakeLocalSum() {
    const auto begin = Clock::now();
    result_.ball = {at_, radius_};
    sum_ = &local_.Update(pose_, result_.ball);
    ++result_.iterations;
    result_.local_triangles = static_cast<int>(sum_->triangles.size());
    result_.minkowski_ms += Since(begin);
    surface_ = {sum_->vertices, sum_->triangles, sum_->neighbors, sum_->vertex_normals};
    if (options_.weights != NormalWeights::kAngle) {
      normals_ = VertexNormals(sum_->vertices, sum_->triangles, options_.weights);
      surface_.normals = normals_;
    }
  }

  bool HasBorder(int triangle) const {
    const auto& corners = sum_->triangles[triangle];
    return std::any_of(corners.begin(), corners.end(),
                       [&](int v) { return sum_->is_border_vertex[v] != 0; });
  }

  double SquaredDistance(const Vector3d& p, int triangle) const {
    const auto& [a, b, c] = sum_->triangles[triangle];
    return SquaredDistanceTo(p, sum_->vertices[a], sum_->vertices[b], sum_->vertices[c]);
  }

  // How far a solution may have moved since the last answer and still be it: ∂M moves there as the
  // point of B in contact does.
  double BranchReach() const {
    const Vector3d motion = (pose_.rotation() - last_->pose.rotation()) * last_->contact +
                            pose_.translation() - last_->pose.translation();
    return kBranchReach * (1.0 + last_->rate) * motion.norm() + 1e-12 / pair_.scale();
  }

  // Lines 10 to 22: takes a solution and says so, or sets the next ball.
  bool Project() {
    if (sum_->triangles.empty()) {
      radius_ *= options_.ball_growth;
      is_near_only_ = false;
      return false;
    }
    PhongPoint chosen;
    bool continues = false;
    if (options_.track_branch && last_ && last_->was_found) {
      continues = Nearest(last_->translation, BranchReach(), !is_near_only_, &chosen);
    }
    if (!continues && is_near_only_) {
      is_near_only_ = false;
      at_ = last_->translation;
      radius_ = std::max({radius_, options_.ball_ratio * at_.norm(), least_radius_});
      return false;
    }
    if (!continues && !Nearest(Vector3d::Zero(), 1e300, true, &chosen)) {
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

  std::shared_ptr<const internal::PatchShape> PatchAround(int triangle) {
    if (!options_.keep_patch || !options_.track_branch || HasBorder(triangle)) return nullptr;
    const auto begin = Clock::now();
    auto shape = patch_.Make(pair_, a_, b_, *sum_, triangle);
    result_.minkowski_ms += Since(begin);
    result_.phong_ms -= Since(begin);  // which counts all of Project
    return shape;
  }

  // The solution nearest to p, within `reach`, of all local triangles, nearest ones first.
  bool Nearest(const Vector3d& p, double reach, bool find_all, PhongPoint* chosen) {
    order_.clear();
    double best = reach < 1e150 ? reach * reach : std::numeric_limits<double>::infinity();
    for (int t = 0; t < result_.local_triangles; ++t) {
      const double squared = SquaredDistance(p, t);
      if (squared <= best) order_.emplace_back(squared, t);
    }
    std::sort(order_.begin(), order_.end());
    PhongOptions phong;
    phong.interpolation = options_.interpolation;
    phong.find_all = find_all;
    bool is_found = false;
    result_.solutions = 0;
    for (const auto& [squared, t] : order_) {
      if (squared > best) break;
      points_.clear();
      result_.solutions += ProjectOntoTriangle(surface_, t, phong, &points_);
      for (const PhongPoint& point : points_) {
        const double distance = (point.position - p).squaredNorm();
        if (distance > best) continue;
        best = distance;
        *chosen = point;
        is_found = true;
      }
    }
    return is_found;
  }

  // No solution: on to the triangle that comes nearest to one, or a larger ball if that is this
  // one.
  void MoveOn() {
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

  // A ball round a triangle: on its longest side as diameter, or round the middle.
  static Ball BallOf(const PhongSurface& surface, int triangle) {
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

  void Take(const PhongPoint& point, const SumFacet& facet, bool continues,
            std::shared_ptr<const internal::PatchShape> patch) {
    result_.status = ContinuousDepthStatus::kFound;
    result_.residual = point.residual;
    if (point.rate) {
      // B moved by δ moves M by -δ: the origin moves by δ in M, and q by that less.
      result_.rate_of_translation = *point.rate - Matrix3d::Identity();
    }
    const Ball triangle = BallOf(surface_, point.triangle);
    result_.corner_angle = CornerAngle(surface_, point.triangle);
    SetTranslation(point.position, facet);
    SetBranch(continues, true, point.rate ? point.rate->norm() : 1.0, triangle);
    last_->at = point.at;
    last_->patch = std::move(patch);
  }

  void Approximate(ContinuousDepthStatus status) {
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
    SetBranch(false, false, 1.0, {best_at_, 0.0});
  }

  void SetTranslation(const Vector3d& q, const SumFacet& facet) {
    result_.translation = q;
    result_.direction = q.stableNormalized();
    result_.features = facet;
    result_.point_on_a = internal::ContactPointOnA(pair_, facet, pair_.scale() * q) / pair_.scale();
    result_.point_on_b = result_.point_on_a - q;
  }

  void SetBranch(bool continues, bool was_found, double rate, const Ball& triangle) {
    result_.branch_ended = last_.has_value() && last_->was_found && !continues;
    result_.combinatorics_changed = last_.has_value() && last_->features != result_.features;
    if (!continues) ++branch_;
    result_.branch = branch_;
    const Vector3d contact =
        pose_.rotation().transpose() * (result_.point_on_b - pose_.translation());
    last_ = ContinuousDepthState{pose_,
                                 result_.translation,
                                 rate,
                                 triangle,
                                 contact,
                                 result_.features,
                                 was_found,
                                 branch_,
                                 Vector3d::Constant(1.0 / 3.0),
                                 nullptr};
  }

  const ContinuousDepthOptions options_;
  const ContactBody a_, b_;
  MeshPair pair_;
  LocalMinkowskiSum local_;
  MeshDepthCache depth_cache_;
  MembershipCache membership_cache_, surface_membership_cache_;
  internal::KeptPatch patch_;
  RelativePose pose_;
  ContinuousDepthResult result_;
  std::optional<ContinuousDepthState> last_;
  int branch_ = 0;

  Vector3d at_ = Vector3d::Zero();
  double radius_ = 0.0, least_radius_ = 0.0;
  bool is_near_only_ = false;  // the ball holds what a branch can have moved to, not α|q|
  const LocalSum* sum_ = nullptr;
  PhongSurface surface_;
  std::vector<Vector3d> normals_;
  std::vector<std::pair<double, int>> order_;
  std::vector<PhongPoint> points_;
  double best_misfit_ = 0.0;
  Vector3d best_at_ = Vector3d::Zero();
  SumFacet best_facet_;
};

ContinuousPenetrationDepth::ContinuousPenetrationDepth(TriangleMesh a, TriangleMesh b,
                                                       const ContinuousDepthOptions& options)
    : implementation_(std::make_unique<Implementation>(std::move(a), std::move(b), options)) {}
ContinuousPenetrationDepth::~ContinuousPenetrationDepth() = default;
ContinuousPenetrationDepth::ContinuousPenetrationDepth(ContinuousPenetrationDepth&&) noexcept =
    default;
ContinuousPenetrationDepth& ContinuousPenetrationDepth::operator=(
    ContinuousPenetrationDepth&&) noexcept = default;

ContinuousDepthResult ContinuousPenetrationDepth::Update(const RelativePose& pose) {
  return implementation_->Update(pose);
}

std::optional<ContinuousDepthState> ContinuousPenetrationDepth::state() const {
  return implementation_->state();
}

void ContinuousPenetrationDepth::set_state(const std::optional<ContinuousDepthState>& state) {
  implementation_->set_state(state);
}

void ContinuousPenetrationDepth::Forget() { implementation_->Forget(); }

const LocalSum& ContinuousPenetrationDepth::local_sum() const {
  return implementation_->local_sum();
}

}  // namespace touchstone
