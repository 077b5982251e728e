// SPDX-License-Identifier: MIT
#include "touchstone/tools/shapes/shapes.h"

namespace touchstone {

Shape Cone(int sides, double radius, double height) {
  Shape cone;
  for (int i = 0; i < sides; ++i) {
    const auto [x, y] = OnCircle(i, sides);
    cone.AddVertex(radius * x, radius * y, 0);
  }
  const int apex = cone.AddVertex(0, 0, height), middle = cone.AddVertex(0, 0, 0);
  for (int i = 0; i < sides; ++i) {
    const int next = (i + 1) % sides;
    cone.AddTriangle(i, next, apex);
    cone.AddTriangle(next, i, middle);
  }
  return cone;
}

}  // namespace touchstone
