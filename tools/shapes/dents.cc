// SPDX-License-Identifier: MIT
#include <utility>

#include "touchstone/tools/shapes/shapes.h"

namespace touchstone {
namespace {

// [-2, 2]^2 x [-2, 0] with a pyramid over a polygon of `sides` sides round the middle of its top.
Shape SlabWithPyramid(int sides, double height) {
  Shape slab = Box({-2, -2, -2}, {2, 2, 0});
  slab.faces.erase(slab.faces.begin() + 2, slab.faces.begin() + 4);  // the top
  const std::array<int, 4> corners = {7, 6, 4, 5};                   // counterclockwise from (2, 2)
  const int rim = static_cast<int>(slab.vertices.size());
  for (int i = 0; i < sides; ++i) {
    const auto [x, y] = OnCircle(i, sides);
    slab.AddVertex(x, y, 0);
  }
  const int apex = slab.AddVertex(0, 0, height);
  for (int i = 0; i < sides; ++i) slab.AddTriangle(rim + i, rim + (i + 1) % sides, apex);
  // Rim point i looks at the corner of its quarter; where the quarter changes, the top's side fits
  // in.
  for (int i = 0; i < sides; ++i) {
    const int quarter = 4 * i / sides, next_quarter = i + 1 < sides ? 4 * (i + 1) / sides : 4;
    slab.AddTriangle(rim + (i + 1) % sides, rim + i, corners[quarter]);
    for (int q = quarter; q < next_quarter; ++q) {
      slab.AddTriangle(corners[q], corners[(q + 1) % 4], rim + (i + 1) % sides);
    }
  }
  return slab;
}

}  // namespace

Shape Dimpled(int sides) { return SlabWithPyramid(sides, -1.5); }
Shape Spiked(int sides) { return SlabWithPyramid(sides, 1.75); }

}  // namespace touchstone
