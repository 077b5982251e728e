// SPDX-License-Identifier: MIT
#include "touchstone/core/cd_dual/enclosure.h"

#include <Eigen/Geometry>

#include "touchstone/core/cd_dual/certify.h"

namespace touchstone {
namespace {

using Triangle = std::array<VertexPair, 3>;

// Tilts that separate points of the facet, but are more than rounding, up to nearly a right angle.
constexpr std::array kTilts = {0x1p-40, 0x1p-30, 0x1p-20, 0x1p-12, 0x1p-6,
                               0x1p-3,  1.0,     4.0,     0x1p5,   0x1p10};

bool IsClear(const std::optional<int>& sign) { return sign && *sign > 0; }

}  // namespace

std::optional<Triangle> FindClearEnclosure(Signs* signs, const Triangle& triangle,
                                           PhaseCounts* counts) {
  const MinkowskiDifference& m = signs->difference();
  const auto is_point = [](const VertexPair& x) {
    return x.p != kInteriorPoint && x.q != kInteriorPoint;
  };
  for (const VertexPair& x : triangle) {
    if (!is_point(x)) return std::nullopt;
  }
  const Eigen::Vector3d normal = signs->Plane(triangle).normal.normalized();
  for (int k = 0; k < 3; ++k) {
    const VertexPair a = triangle[k], b = triangle[(k + 1) % 3], z = triangle[(k + 2) % 3];
    if (IsClear(signs->Determinant(b, a, kInteriorDifference))) continue;
    const Eigen::Vector3d from_c = m.Point(a) - m.c();
    const Eigen::Vector3d over = (m.Point(b) - m.Point(a)).cross(from_c).normalized();
    if (!normal.allFinite() || !over.allFinite()) continue;
    for (const double tilt : kTilts) {
      const VertexPair w = m.Support(normal + tilt * over, a, counts);
      for (const Triangle& across : {Triangle{a, w, z}, Triangle{w, b, z}}) {
        if (ProveEnclosingTetrahedron(signs, across)) return across;
      }
    }
  }
  return std::nullopt;
}

}  // namespace touchstone
