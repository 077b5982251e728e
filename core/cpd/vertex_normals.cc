// SPDX-License-Identifier: MIT
#include "touchstone/core/cpd/vertex_normals.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace touchstone {

using Eigen::Vector3d;

std::vector<Vector3d> VertexNormals(std::span<const Vector3d> vertices,
                                    std::span<const std::array<int, 3>> triangles,
                                    NormalWeights weights,
                                    std::span<const Vector3d> triangle_normals) {
  std::vector<Vector3d> normals;
  VertexNormals(vertices, triangles, weights, triangle_normals, &normals);
  return normals;
}

void VertexNormals(std::span<const Vector3d> vertices,
                   std::span<const std::array<int, 3>> triangles, NormalWeights weights,
                   std::span<const Vector3d> triangle_normals, std::vector<Vector3d>* normals) {
  constexpr double kRounding = 0x1p-44;  // of corners, over the largest coordinate
  double size = 0.0;
  for (const Vector3d& vertex : vertices) size = std::max(size, vertex.cwiseAbs().maxCoeff());
  normals->assign(vertices.size(), Vector3d::Zero());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const std::array<int, 3>& triangle = triangles[t];
    Vector3d sides[3];  // from corner k to the next
    double longest = 0.0;
    for (int k = 0; k < 3; ++k) {
      sides[k] = vertices[triangle[(k + 1) % 3]] - vertices[triangle[k]];
      longest = std::max(longest, sides[k].stableNorm());
    }
    const Vector3d area = sides[0].cross(sides[1]);
    const double twice = area.stableNorm();
    const bool is_thin = !(twice > kRounding * size * longest);
    if (is_thin && (triangle_normals.empty() || weights == NormalWeights::kUniform)) continue;
    const Vector3d normal = triangle_normals.empty() ? Vector3d(area / twice) : triangle_normals[t];
    for (int k = 0; k < 3; ++k) {
      const double angle = std::atan2(twice, -sides[k].dot(sides[(k + 2) % 3]));
      (*normals)[triangle[k]] += (weights == NormalWeights::kArea    ? twice
                                  : weights == NormalWeights::kAngle ? angle
                                                                     : 1.0) *
                                 normal;
    }
  }
  for (Vector3d& normal : *normals) normal = normal.stableNormalized();
}

}  // namespace touchstone
