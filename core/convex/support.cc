// SPDX-License-Identifier: MIT
#include "touchstone/core/convex/support.h"

namespace touchstone {

int SupportVertexByScan(const ConvexPolyhedron& body, const Eigen::Vector3d& direction) {
  const Eigen::Vector3d& reference = body.vertex(0);
  int best = 0;
  double best_height = 0.0;
  for (int v = 1; v < body.vertex_count(); ++v) {
    const double height = direction.dot(body.vertex(v) - reference);
    if (height > best_height) best = v, best_height = height;
  }
  return best;
}

int SupportVertex(const ConvexPolyhedron& body, const Eigen::Vector3d& direction, int start,
                  long* climb_steps) {
  (void)start;
  (void)climb_steps;
  return SupportVertexByScan(body, direction);
}

}  // namespace touchstone
