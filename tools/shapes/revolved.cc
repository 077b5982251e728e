// SPDX-License-Identifier: MIT
#include <array>

#include "touchstone/tools/shapes/shapes.h"

namespace touchstone {

Shape Cup(int sides) {
  // Radius and height down the outside from the rim, then up the inside; poles in the middle of
  // the foot and of the floor.
  constexpr std::array<std::array<double, 2>, 4> kOutside = {
      {{1.5, 3.0}, {1.35, 2.0}, {1.125, 1.0}, {0.875, 0.0}}};
  constexpr std::array<std::array<double, 2>, 4> kInside = {
      {{0.625, 0.25}, {0.875, 1.0}, {1.125, 2.0}, {1.25, 3.125}}};
  Shape cup;
  const auto add_ring = [&](const std::array<double, 2>& at) {
    const int first = static_cast<int>(cup.vertices.size());
    for (int i = 0; i < sides; ++i) {
      const auto [x, y] = OnCircle(i, sides);
      cup.AddVertex(at[0] * x, at[0] * y, at[1]);
    }
    return first;
  };
  // A band between rings, outside when going down the outer wall.
  const auto add_band = [&](int upper, int lower) {
    for (int i = 0; i < sides; ++i) {
      const int next = (i + 1) % sides;
      cup.AddQuad(lower + i, lower + next, upper + next, upper + i);
    }
  };
  std::array<int, 4> outside, inside;
  for (int k = 0; k < 4; ++k) outside[k] = add_ring(kOutside[k]);
  for (int k = 0; k < 4; ++k) inside[k] = add_ring(kInside[k]);
  for (int k = 0; k < 3; ++k) add_band(outside[k], outside[k + 1]);
  for (int k = 0; k < 3; ++k) add_band(inside[k], inside[k + 1]);
  add_band(inside[3], outside[0]);
  const int foot = cup.AddVertex(0, 0, 0.125), floor = cup.AddVertex(0, 0, 0.25);
  for (int i = 0; i < sides; ++i) {
    const int next = (i + 1) % sides;
    cup.AddTriangle(outside[3] + next, outside[3] + i, foot);
    cup.AddTriangle(inside[0] + i, inside[0] + next, floor);
  }
  return cup;
}

}  // namespace touchstone
