// SPDX-License-Identifier: MIT
//
// One answer of Algorithm 2, and what is kept from it to the next: continuous_solver begins,
// looks for the branch on the triangles kept, and tells what was found; continuous_search looks in
// local sums, continuous_mean by normals averaged over a radius.
#ifndef TOUCHSTONE_CORE_CPD_CONTINUOUS_SOLVER_INTERNAL_H_
#define TOUCHSTONE_CORE_CPD_CONTINUOUS_SOLVER_INTERNAL_H_

#include <Eigen/Core>
#include <chrono>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "touchstone/core/cpd/contact_body.h"
#include "touchstone/core/cpd/continuous_penetration_depth.h"
#include "touchstone/core/cpd/kept_patch_internal.h"
#include "touchstone/core/cpd/mean_normals.h"
#include "touchstone/core/cpd/mesh_penetration_depth.h"
#include "touchstone/core/mesh/membership.h"

namespace touchstone::internal {

using Clock = std::chrono::steady_clock;
inline double Since(Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

class ContinuousSolver {
 public:
  ContinuousSolver(TriangleMesh a, TriangleMesh b, const ContinuousDepthOptions& options)
      : options_(options),
        a_(a),
        b_(b),
        pair_(a, b, RelativePose()),
        local_(std::move(a), std::move(b), {options.builder}) {}

  ContinuousDepthResult Update(const RelativePose& pose);
  void Forget();
  const LocalSum& local_sum() const { return local_.sum(); }
  const std::optional<ContinuousDepthState>& state() const { return last_; }
  void set_state(const std::optional<ContinuousDepthState>& state);
  std::optional<PhongPatch> patch() const;
  std::optional<Eigen::Matrix3d> RateOfTurn();

 private:
  void Answer(const RelativePose& pose);
  // Whether the answer is the branch of the one before, beyond being the nearest in reach.
  bool IsSure(const ContinuousDepthState& before) const;
  double SureReach(const ContinuousDepthState& before) const;
  // Asks again, in parts; ends the branch if one is lost.
  void AnswerInParts(const ContinuousDepthState& before);

  // Line 2 to 6: where to begin. False if there is no overlap.
  bool Begin();
  // Looks for the branch on the triangles that it was on before, if they are still what they were.
  bool FollowPatch();
  // Whether there is no overlap a step off the surface: it is not buried.
  bool IsOutside(const PhongPoint& point, const Eigen::Vector3d& normal);

  // The solution that the last one is at another pose, on its triangles as they are named.
  std::optional<Eigen::Vector3d> OnPatchAt(const RelativePose& pose);

  void Search();
  void MakeLocalSum();
  bool HasBorder(int triangle) const;
  // Lines 10 to 22: takes a solution and says so, or sets the next ball.
  bool Project();
  std::shared_ptr<const PatchShape> PatchAround(int triangle);
  // The solution nearest to p, within `reach`, of all local triangles, nearest ones first.
  bool Nearest(const Eigen::Vector3d& p, double reach, PhongPoint* chosen);
  // No solution: on to the triangle that comes nearest to one, or a larger ball if that is this
  // one.
  void MoveOn();

  // With normals averaged over a radius: on from the branch before, or from the depth's point.
  void SearchByMeanNormals();
  bool Walk(Eigen::Vector3d from, PhongPoint* found);
  void TakeMean(const PhongPoint& point, bool continues);
  std::optional<Eigen::Matrix3d> MeanRateOfTurn();

  // How far a solution may have moved since the last answer and still be it: ∂M moves there as the
  // point of B in contact does.
  double BranchReach() const;
  double MotionSince(const ContinuousDepthState& before) const;
  void Take(const PhongPoint& point, const SumFacet& facet, bool continues,
            std::shared_ptr<const PatchShape> patch);
  void Approximate(ContinuousDepthStatus status);
  void SetTranslation(const Eigen::Vector3d& q, const SumFacet& facet);
  void SetBranch(bool continues, const PhongPoint* found, const Ball& triangle);

  const ContinuousDepthOptions options_;
  const ContactBody a_, b_;
  MeshPair pair_;
  LocalMinkowskiSum local_;
  MeshDepthCache depth_cache_;
  MembershipCache membership_cache_, surface_membership_cache_;
  KeptPatch patch_;
  KeptPatch turned_patch_;                    // for rates
  std::unique_ptr<ContinuousSolver> turned_;  // with mean normals
  RelativePose pose_;
  ContinuousDepthResult result_;
  std::optional<ContinuousDepthState> last_;
  int branch_ = 0;
  double other_ = 0.0;  // how far from the answer before another solution is
  int triangle_ = -1;   // of the last answer, in the last local sum or in its patch

  Eigen::Vector3d at_ = Eigen::Vector3d::Zero();
  double radius_ = 0.0, least_radius_ = 0.0;
  double branch_reach_ = 0.0;  // in which the branch is looked for
  // Of the motion, that the branch alone is looked for in: 1 / kParts, or more; 0: all is.
  int part_ = 0;
  bool is_near_only_ = false;  // the ball holds what a branch can have moved to, not α|q|
  const LocalSum* sum_ = nullptr;
  PhongSurface surface_;
  std::vector<Eigen::Vector3d> normals_;
  std::vector<std::pair<double, int>> order_;
  std::vector<PhongPoint> points_;
  MeanNormals mean_normals_;
  double best_misfit_ = 0.0;
  double walked_ = 1.0;  // by mean normals, last, over their radius
  Eigen::Vector3d best_at_ = Eigen::Vector3d::Zero();
  SumFacet best_facet_;
};

// A ball round a triangle: on its longest side as diameter, or round the middle.
Ball BallOf(const PhongSurface& surface, int triangle);

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_CPD_CONTINUOUS_SOLVER_INTERNAL_H_
