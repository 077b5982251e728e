// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef TOUCHSTONE_EXACT_JUDGE_CPD_H_
#define TOUCHSTONE_EXACT_JUDGE_CPD_H_

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "touchstone/core/base/relative_pose.h"
#include "touchstone/core/mesh/triangle_mesh.h"

namespace touchstone::exact {

// What a depth query of two meshes claims: B moved by `translation` does not overlap A, moved by
// less than `lower_bound` whichever way it does.
struct MeshDepthClaim {
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  double lower_bound = 0.0, upper_bound = 0.0;
  // The translation is the rounding of a point that was placed exactly: it may overlap by that.
  bool is_rounded = false;
};

struct DepthJudgeOptions {
  std::uint64_t seed = 1;
  // Placements below the lower bound that are decided exactly, at most: near facets of all pairs of
  // features, chosen without the support rule or any other theory of the query's; and within the
  // ball at large.
  int facet_samples = 60, ball_samples = 20;
};

// What is wrong with the claim, a line each; empty when it stands. Every verdict is that of
// MeshMembership: exact, and independent of the core's. Findings prove the claim wrong; none found
// proves the upper bound, and tries the lower one at so many places.
//
// Complexity: O(m n) to list the pairs of features, and so many exact verdicts.
std::vector<std::string> JudgeMeshDepth(const TriangleMesh& a, const TriangleMesh& b,
                                        const RelativePose& pose, const MeshDepthClaim& claim,
                                        const DepthJudgeOptions& options = {});

// What is wrong with the claim by the whole boundary of M° from Nef polyhedra: the distance of the
// origin from it, in doubles of exact corners, must lie between the bounds up to 1e-12 of the size;
// of exact slots, only their corners and the middles of their edges are asked, which the lower
// bound may not pass. Seconds to minutes: see MakeNefMeshSum.
std::vector<std::string> JudgeMeshDepthByNef(const TriangleMesh& a, const TriangleMesh& b,
                                             const RelativePose& pose, const MeshDepthClaim& claim);

}  // namespace touchstone::exact

#endif  // TOUCHSTONE_EXACT_JUDGE_CPD_H_
