// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_CPD_VERTEX_NORMALS_H_
#define TOUCHSTONE_CORE_CPD_VERTEX_NORMALS_H_

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace touchstone {

enum class NormalWeights : std::uint8_t { kAngle, kArea, kUniform };

// The mean of the normals of a vertex's triangles, by these weights; of unit length, or zero where
// they cancel. Where the area of a triangle is below what roundings of its corners make, these tell
// no normal: it counts by `triangle_normals`, if they are given, and uniformly not at all.
// Complexity: O(n).
std::vector<Eigen::Vector3d> VertexNormals(std::span<const Eigen::Vector3d> vertices,
                                           std::span<const std::array<int, 3>> triangles,
                                           NormalWeights weights = NormalWeights::kAngle,
                                           std::span<const Eigen::Vector3d> triangle_normals = {});
// Into storage that is used again.
void VertexNormals(std::span<const Eigen::Vector3d> vertices,
                   std::span<const std::array<int, 3>> triangles, NormalWeights weights,
                   std::span<const Eigen::Vector3d> triangle_normals,
                   std::vector<Eigen::Vector3d>* normals);

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_CPD_VERTEX_NORMALS_H_
