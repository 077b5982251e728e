// SPDX-License-Identifier: MIT
#include "touchstone/tools/shapes/shapes.h"

namespace touchstone {

Shape Torus(int around, int tube, double major, double minor) {
  Shape torus;
  for (int i = 0; i < around; ++i) {
    const auto [x, y] = OnCircle(i, around);
    for (int j = 0; j < tube; ++j) {
      const auto [out, up] = OnCircle(j, tube);
      const double radius = major + minor * out;
      torus.AddVertex(radius * x, radius * y, minor * up);
    }
  }
  const auto at = [&](int i, int j) { return (i % around) * tube + j % tube; };
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < tube; ++j) {
      torus.AddQuad(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
    }
  }
  return torus;
}

Shape InterlockedTori(int around, int tube) {
  const Shape flat = Torus(around, tube, 2.0, 0.5);
  Shape upright = flat;  // turned about the x axis, its tube through the other's middle
  for (Eigen::Vector3d& v : upright.vertices) v = Eigen::Vector3d(v[0] + 2.0, -v[2], v[1]);
  return Together(flat, upright);
}

}  // namespace touchstone
