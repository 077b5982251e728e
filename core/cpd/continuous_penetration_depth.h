// SPDX-License-Identifier: MIT
//
//   paper        here              meaning, in A's frame
//   q            translation       B moved by q, or A by -q, and the bodies just touch: q is on ∂M,
//                                  M° = int A ⊕ -int B and ∂M = closure(M°) minus M°
//   S_i, r       ball              the ball in which ∂M is made
//   α, β         ball_ratio, ball_growth
//   ∂M(S_i)      LocalSum
//   Ψ            TangentBasis
#ifndef TOUCHSTONE_CORE_CPD_CONTINUOUS_PENETRATION_DEPTH_H_
#define TOUCHSTONE_CORE_CPD_CONTINUOUS_PENETRATION_DEPTH_H_

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "touchstone/core/base/relative_pose.h"
#include "touchstone/core/cpd/phong_projection.h"
#include "touchstone/core/cpd/vertex_normals.h"
#include "touchstone/core/mesh/triangle_mesh.h"
#include "touchstone/core/minkowski/local_sum.h"

namespace touchstone {

namespace internal {
struct PatchShape;
}

struct ContinuousDepthOptions {
  double ball_ratio = 0.3;
  double ball_growth = 2.0;
  int iteration_limit = 12;  // local sums made for one answer, at most
  NormalWeights weights = NormalWeights::kAngle;
  PhongInterpolation interpolation = PhongInterpolation::kTangentBasis;
  // Above 0: normals are those of MeanNormals, over this times |q|, in place of any that weights
  // and interpolation make of triangles. They are continuous in the pose, as Theorem 4 would have
  // it; no triangles are kept. README tells what that costs and how much is worth having.
  double normal_radius = 0.0;
  // Follows the solution of the answer before while it lasts; otherwise every answer is the nearest
  // of the local solutions, as definition (8) has it, and may jump between branches.
  bool track_branch = true;
  // How far a branch may move in a step that is taken as it is, from one local sum to another, over
  // what its rate makes of the motion: less tells more of the ends of branches, and halves more
  // steps (ContinuousDepthResult::branch).
  double sure_reach = 0.25;
  // Follows a branch on the triangles that it was found on while nothing comes in their way,
  // without a local sum. They stay the triangles they are: where a flat cell would be cut into
  // others, so that the normals in it would jump, it is not.
  bool keep_patch = true;
  LocalBuilder builder = LocalBuilder::kGapFilling;
};

enum class ContinuousDepthStatus : std::uint8_t {
  kSeparate,     // the interiors do not meet: depth 0
  kFound,        // a Phong projection
  kApproximate,  // the ball held all of ∂M and no projection: what comes nearest to one
  kLimit,        // stopped at the limit without one: what came nearest
};
std::string_view ToString(ContinuousDepthStatus status);

struct ContinuousDepthResult {
  ContinuousDepthStatus status = ContinuousDepthStatus::kSeparate;
  // On ∂M up to rounding. Zero where the bodies do not overlap.
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  // of the translation, of unit length
  double residual = 0.0;  // the sine of the angle between the translation and the normal there

  // What touches when B is moved so: the features, and where they are on A, and on B before it is
  // moved. A penalty force on B is along the direction, at point_on_b.
  SumFacet features;
  Eigen::Vector3d point_on_a = Eigen::Vector3d::Zero(), point_on_b = Eigen::Vector3d::Zero();
  // The rate of the translation with B's, 3 x 3, where the solution is simple. With a turn of B:
  // RateOfTurn.
  std::optional<Eigen::Matrix3d> rate_of_translation;

  // Numbers the branches of solutions that a solver has followed; an answer is said to continue the
  // one before iff they agree. It is then the nearest solution, on the same triangle of ∂M by name
  // (iterations is 0) or in a local sum, its index is the same, it is no further from the one
  // before than (1 + rate) times the motion, times 2 on the same triangle or with mean normals and
  // else times `sure_reach`, and no other solution is that near. The motion is that of the point of
  // contact, and of q turned. Where this is not so, the motion is halved into `parts` until it is
  // so of each, or its solution moves on as in the part before; 2^10 parts and 64 answers at most.
  // A part of the last size may go 16 times as far; what is not followed so has ended. Poses
  // between turn about one axis and move evenly. What this leaves: where ∂M's triangles change, a
  // leap to a solution of the same index that is as near as that; README counts them.
  int branch = 0;
  bool branch_ended = false;           // the branch of the answer before was not found again
  int parts = 1;                       // of the motion since the answer before, each followed
  int index = 0;                       // of the solution: PhongPoint
  bool combinatorics_changed = false;  // the solution lies on another facet than before
  int solutions = 0;                   // found in the last local sum, or on the triangles kept
  // Proven, of the triangles that were made: none of them has a solution nearer to the one before,
  // where the branch goes on, or to the origin. On triangles kept, only the solution's own is
  // asked. False where solutions meet, and for mean normals.
  bool is_nearest = false;
  double normal_radius = 0.0;  // of the mean normals there; 0 with others
  // The largest angle between the normals at the corners of the solution's triangle, in radians:
  // Theorem 3 supposes no more than about ten degrees.
  double corner_angle = 0.0;

  int iterations = 0;  // local sums made: none where the triangles of the answer before held
  Ball ball;           // of the last local sum, or round the triangle that held
  int local_triangles = 0;
  double depth_ms = 0.0, minkowski_ms = 0.0, phong_ms = 0.0, total_ms = 0.0;
};

// The triangles of ∂M that an answer was found on, by name: the first holds it, and with it are all
// that share a corner with that one; with normals averaged over a radius, the whole local sum.
struct PhongPatch {
  std::vector<SumFacet> facets;
  std::vector<SumPointName> names;  // of corners; facet numbers are those of `facets`
  std::vector<std::array<int, 3>> triangles;
  std::vector<int> facet_of_triangle;
  Eigen::Vector3d at = Eigen::Vector3d::Zero();  // λ, in the first triangle
};

// What a solver keeps of the answer before: put back, it follows the motion from there again.
struct ContinuousDepthState {
  RelativePose pose;
  Eigen::Vector3d translation;
  double rate;  // the norm of the solution's rate with the origin
  int index;
  // A ball that holds the solution's triangle.
  Ball triangle;
  Eigen::Vector3d contact;  // where B is touched, in its own frame
  SumFacet features;
  bool was_found;  // or an approximation
  int branch;
  // Where in its triangle the solution is, and that one with those round it; null if not kept.
  Eigen::Vector3d at;
  std::shared_ptr<const internal::PatchShape> patch;
};

// Continuous penetration depth of two closed meshes along a motion, a pose at a time: Algorithm 2
// with its misprints mended (README). One per thread; not pure, for it follows the motion. Never
// throws, never returns NaN.
//
// Complexity of an answer: an initial global depth when nothing came before, and as many local sums
// as iterations; O(n) to place B and O(k) for k pairs of features near the triangle where the
// triangles of the answer before hold.
// Source: Lee, Behar, Lien, Kim 2016, sections 3.3 and 6.
class ContinuousPenetrationDepth {
 public:
  ContinuousPenetrationDepth(TriangleMesh a, TriangleMesh b,
                             const ContinuousDepthOptions& options = {});
  ~ContinuousPenetrationDepth();
  ContinuousPenetrationDepth(ContinuousPenetrationDepth&&) noexcept;
  ContinuousPenetrationDepth& operator=(ContinuousPenetrationDepth&&) noexcept;

  ContinuousDepthResult Update(const RelativePose& pose);
  // Nothing where the bodies were separate, or nothing came before.
  std::optional<ContinuousDepthState> state() const;
  void set_state(const std::optional<ContinuousDepthState>& state);
  // Of the last answer, to be judged by others; nothing unless it is a projection. Not for a state
  // that was put back.
  std::optional<PhongPatch> patch() const;
  // The rate of the last answer's translation with a turn of B about its own origin, 3 x 3: turned
  // by the vector w in A's frame, in radians, it moves by so much of w. Where it exists and is
  // known: for a simple solution on triangles that are kept, whose facets all support a little to
  // either side. There the solution is a smooth function of the pose; it ends with the triangles.
  // And with mean normals where the answers to either side differ by as much, to 1/256: M may have
  // a crease in the pose, as where faces lie on faces. Nothing else. Not for a state that was put
  // back.
  //
  // By central differences of the triangles' own solution, placed by name at poses 2^-20 radians
  // off: good to some 1e-8 of the rate's size, and at least of the translation's. Places B seven
  // times, O(n) each. With mean normals of seven answers, 2^-15 radians off; a second solver's
  // memory is taken, once.
  std::optional<Eigen::Matrix3d> RateOfTurn();
  // Forgets the motion: the next answer begins with the global depth.
  void Forget();

  // The last one made.
  const LocalSum& local_sum() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_CPD_CONTINUOUS_PENETRATION_DEPTH_H_
