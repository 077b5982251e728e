// SPDX-License-Identifier: MIT
#include "touchstone/tools/shapes/shapes.h"

namespace touchstone {

Shape Star(int points) {
  Shape star;
  for (int i = 0; i < 2 * points; ++i) {
    const auto [x, y] = OnCircle(i, 2 * points);
    const double radius = i % 2 == 0 ? 2.0 : 0.75;
    star.AddVertex(radius * x, radius * y, 0);
  }
  const int above = star.AddVertex(0, 0, 0.625), below = star.AddVertex(0, 0, -0.625);
  for (int i = 0; i < 2 * points; ++i) {
    const int next = (i + 1) % (2 * points);
    star.AddTriangle(i, next, above);
    star.AddTriangle(next, i, below);
  }
  return star;
}

}  // namespace touchstone
