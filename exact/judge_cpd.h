// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef TOUCHSTONE_EXACT_JUDGE_CPD_H_
#define TOUCHSTONE_EXACT_JUDGE_CPD_H_

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "touchstone/core/base/relative_pose.h"
#include "touchstone/core/mesh/triangle_mesh.h"
#include "touchstone/core/minkowski/sum_boundary.h"

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

// Whose normals a Phong projection is by: the weights of triangles at their corners, or means over
// a radius.
enum class PhongNormals : std::uint8_t { kAngle, kArea, kUniform, kMean };

// What an answer of continuous penetration depth claims: `translation` is, up to `rounding`, the
// point of ∂M that λ gives on the first of these triangles, and the sine of the angle between it
// and the surface's normal there is no more than `residual`. The triangles are named, and with them
// are all that share a corner with the first; for means, all within the radius of the point.
struct PhongClaim {
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  double rounding = 0.0, residual = 0.0;
  double depth_lower_bound = 0.0;                // no point of ∂M is nearer
  Eigen::Vector3d at = Eigen::Vector3d::Zero();  // λ
  std::vector<SumFacet> facets;
  std::vector<SumPointName> names;
  std::vector<std::array<int, 3>> triangles;
  std::vector<int> facet_of_triangle;
  PhongNormals normals = PhongNormals::kAngle;
  bool interpolated = false;  // the normals, as the paper's Figure 2a, in place of tangent planes
  double mean_radius = 0.0;
};

// What is wrong with the claim; empty when it stands. Corners and the point are exact fractions:
// the triangles are pieces of facets that can touch, and none is missing as far as their sides
// tell; the bodies touch at the point, overlap inward of it and not outward; it is no nearer than
// the depth; and the residual, by normals made of the exact corners, is in 256 bits but for angles,
// which are doubles.
//
// Complexity: O(k) fractions for k triangles and three exact memberships.
std::vector<std::string> JudgePhong(const TriangleMesh& a, const TriangleMesh& b,
                                    const RelativePose& pose, const PhongClaim& claim);

// Whether a Phong projection on some triangle of a surface, outward seen from the origin, is nearer
// than `distance` by more than a millionth. Each triangle is cut into quarters wherever, in
// intervals, x may lie across its tangent planes, down to 1/64 of it; from there solved in doubles,
// with derivatives by differences. So nothing is passed over but what Newton's steps do not find
// from 1/100 off. Returns a line that tells it, or nothing. Corners on the surface's border have
// what normals the triangles given make.
std::vector<std::string> FindNearerPhong(const std::vector<Eigen::Vector3d>& vertices,
                                         const std::vector<std::array<int, 3>>& triangles,
                                         const std::vector<Eigen::Vector3d>& triangle_normals,
                                         double distance);

}  // namespace touchstone::exact

#endif  // TOUCHSTONE_EXACT_JUDGE_CPD_H_
