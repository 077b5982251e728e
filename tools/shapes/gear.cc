// SPDX-License-Identifier: MIT
#include <array>
#include <utility>

#include "touchstone/tools/shapes/shapes.h"

namespace touchstone {
namespace {

// The point at i k-ths of a turn, evenly (OnCircle's points are not): the series of sine and cosine
// over an eighth of a turn either way, whose next terms are below a rounding.
std::array<double, 2> EvenlyOnCircle(int i, int k) {
  const int quarter = (4 * i + k / 2) / k;
  const double x = 1.5707963267948966 * (static_cast<double>(4 * i - quarter * k) / k);
  double sine = 0.0, cosine = 0.0, term = 1.0;
  for (int n = 0; n < 20; ++n) {
    const double sign = n % 4 < 2 ? 1.0 : -1.0;
    (n % 2 == 0 ? cosine : sine) += sign * term;
    term *= x / (n + 1);
  }
  switch (quarter % 4) {
    case 0:
      return {cosine, sine};
    case 1:
      return {-sine, cosine};
    case 2:
      return {-cosine, -sine};
    default:
      return {sine, -cosine};
  }
}

}  // namespace

// A tooth takes an eighth of a turn's share for each flank and two for its tip, so that teeth of
// equal pitch pass through each other's gaps with room to spare.
Shape Gear(int teeth) {
  constexpr double kThickness = 0.5;
  const double pitch = 0.1 * teeth, tip = pitch + 0.15, root = pitch - 0.2;
  const int k = 8 * teeth;
  Shape gear;
  for (const double z : {0.0, kThickness}) {
    for (int tooth = 0; tooth < teeth; ++tooth) {
      for (const auto& [at, radius] :
           {std::pair(2, root), std::pair(3, tip), std::pair(5, tip), std::pair(6, root)}) {
        const auto [x, y] = EvenlyOnCircle(8 * tooth + at, k);
        gear.AddVertex(radius * x, radius * y, z);
      }
    }
  }
  const int n = 4 * teeth;
  const int below = gear.AddVertex(0, 0, 0), above = gear.AddVertex(0, 0, kThickness);
  for (int i = 0; i < n; ++i) {
    const int next = (i + 1) % n;
    gear.AddTriangle(below, next, i);
    gear.AddTriangle(above, n + i, n + next);
    gear.AddQuad(i, next, n + next, n + i);
  }
  return gear;
}

}  // namespace touchstone
