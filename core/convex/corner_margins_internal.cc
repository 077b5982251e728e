// SPDX-License-Identifier: MIT
#include "touchstone/core/convex/corner_margins_internal.h"

#include <algorithm>
#include <cmath>

namespace touchstone::internal {

std::vector<double> CornerMargins(const ConvexPolyhedronData& data) {
  std::vector<double> margins(data.vertices.size(), 0.0);
  for (int v = 0; v < data.vertex_count(); ++v) {
    Eigen::Vector3d axis = Eigen::Vector3d::Zero();
    int bends = 0;
    for (int i = data.vertex_begin[v]; i < data.vertex_begin[v + 1]; ++i) {
      axis -= data.face_normals[data.vertex_faces[i]];
      const Edge& edge = data.edges[data.vertex_edges[i]];
      bends += data.facet_of_face[edge.left] != data.facet_of_face[edge.right];
    }
    const double length = axis.norm();
    if (bends < 3 || !(length > 0.0)) continue;
    double margin = 1.0;
    for (int i = data.vertex_begin[v]; i < data.vertex_begin[v + 1]; ++i) {
      Eigen::Vector3d along = data.vertices[data.vertex_neighbors[i]] - data.vertices[v];
      int exponent = 0;  // squares of lengths near 1e-200 must not underflow
      std::frexp(along.cwiseAbs().maxCoeff(), &exponent);
      for (double& x : along) x = std::ldexp(x, -exponent);
      margin = std::min(margin, axis.dot(along) / (length * along.norm()));
    }
    // Rounding of the differences, products, norms and quotients: below 32 units of 2^-52 in all.
    margins[v] = std::max(0.0, margin - 32 * 0x1p-52);
  }
  return margins;
}

}  // namespace touchstone::internal
