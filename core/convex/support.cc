// SPDX-License-Identifier: MIT
#include "touchstone/core/convex/support.h"

#include <cmath>
#include <limits>

namespace touchstone {

int SupportVertex(const ConvexPolyhedron& body, const Eigen::Vector3d& direction, int start,
                  int* climb_steps) {
  int steps = 0;
  const int vertex = body.support_table().Find(direction, start, &steps);
  if (climb_steps != nullptr) *climb_steps += steps;
  return vertex;
}

int SupportVertexByScan(const ConvexPolyhedron& body, const Eigen::Vector3d& direction) {
  // Heights are taken over one point of the body: their rounding refers to its extent, not to its
  // distance from the frame's origin, and they are compared as numbers, so that ties are ties.
  const Eigen::Vector3d center = body.interior_point(0);
  int exponent = 0;
  std::frexp(direction.cwiseAbs().maxCoeff(), &exponent);
  const Eigen::Vector3d n(std::ldexp(direction[0], -exponent), std::ldexp(direction[1], -exponent),
                          std::ldexp(direction[2], -exponent));
  int best = 0;
  double best_height = -std::numeric_limits<double>::infinity();
  for (int v = 0; v < body.vertex_count(); ++v) {
    const double height = n.dot(body.vertex(v) - center);
    if (height > best_height) {
      best_height = height;
      best = v;
    }
  }
  return best;
}

}  // namespace touchstone
