// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef TOUCHSTONE_EXACT_JUDGE_SURFACE_H_
#define TOUCHSTONE_EXACT_JUDGE_SURFACE_H_

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "touchstone/core/base/relative_pose.h"
#include "touchstone/core/mesh/triangle_mesh.h"

namespace touchstone::exact {

// What a distance query of two meshes claims: no two faces are nearer than the lower bound, the two
// named no further apart than the upper one. Faces of -1 and bounds of zero: the bodies meet.
struct SurfaceDistanceClaim {
  double lower_bound = 0.0, upper_bound = 0.0;
  int face_a = -1, face_b = -1;
};

// What a travel query claims of B + t s: is_hit: the bodies first meet for a t within the bounds,
// by the two faces named, or they do at t = 0 (bounds of zero, faces of -1). Otherwise for no t in
// [0, reach].
struct SurfaceTravelClaim {
  Eigen::Vector3d s = Eigen::Vector3d::Zero();
  double reach = 0.0;
  bool is_hit = false;
  double lower_bound = 0.0, upper_bound = 0.0;
  int face_a = -1, face_b = -1;
};

struct SurfaceJudgeOptions {
  std::uint64_t seed = 1;
  int face_samples = 100;  // of pairs of faces whose boxes are nearer than the lower bound, at most
  int placements = 8;      // before the first contact, decided exactly
};

// What is wrong with the claim, a line each; empty when it stands. Fractions throughout. Findings
// prove the claim wrong; none found proves the upper bound, and tries the lower one, or that
// nothing meets, at so many places.
//
// Complexity: O(m + n), and so many exact distances of faces, or verdicts of MeshMembership.
std::vector<std::string> JudgeSurfaceDistance(const TriangleMesh& a, const TriangleMesh& b,
                                              const RelativePose& pose,
                                              const SurfaceDistanceClaim& claim,
                                              const SurfaceJudgeOptions& options = {});
std::vector<std::string> JudgeSurfaceTravel(const TriangleMesh& a, const TriangleMesh& b,
                                            const RelativePose& pose,
                                            const SurfaceTravelClaim& claim,
                                            const SurfaceJudgeOptions& options = {});

}  // namespace touchstone::exact

#endif  // TOUCHSTONE_EXACT_JUDGE_SURFACE_H_
