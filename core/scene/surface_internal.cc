// SPDX-License-Identifier: MIT
#include "touchstone/core/scene/surface_internal.h"

#include <array>
#include <cstddef>

#include "touchstone/core/base/orientation.h"

namespace touchstone::internal {
namespace {

// The vertices strictly within a side, in the order of the face.
using Chain = std::vector<int>;

// A triangle whose side k, from corner k to the next, may hold more vertices.
struct Sides {
  std::array<int, 3> corners;
  std::array<Chain, 3> within;
};

// Cuts the triangle by a fan from the corner opposite to a side that holds vertices. The other two
// sides go to the first and the last triangle of the fan, which then hold vertices on fewer sides.
void Cut(const Sides& triangle, std::vector<Triangle>* triangles) {
  int side = 0;
  while (side < 3 && triangle.within[side].empty()) ++side;
  if (side == 3) {
    triangles->push_back(triangle.corners);
    return;
  }
  const int from = triangle.corners[side], to = triangle.corners[(side + 1) % 3];
  const int apex = triangle.corners[(side + 2) % 3];
  Chain chain = triangle.within[side];
  chain.insert(chain.begin(), from);
  chain.push_back(to);
  for (std::size_t k = 0; k + 1 < chain.size(); ++k) {
    Sides piece{{chain[k], chain[k + 1], apex}, {}};
    if (k + 2 == chain.size()) piece.within[1] = triangle.within[(side + 1) % 3];
    if (k == 0) piece.within[2] = triangle.within[(side + 2) % 3];
    Cut(piece, triangles);
  }
}

void CutFace(const Orientation& orientation, std::span<const int> loop,
             std::vector<Triangle>* triangles) {
  const int n = static_cast<int>(loop.size());
  std::vector<int> corners;  // places in the loop
  for (int k = 0; k < n; ++k) {
    if (!orientation.IsCollinear(loop[(k + n - 1) % n], loop[k], loop[(k + 1) % n])) {
      corners.push_back(k);
    }
  }
  const auto within = [&](int from, int to) {
    Chain chain;
    for (int k = (from + 1) % n; k != to; k = (k + 1) % n) chain.push_back(loop[k]);
    return chain;
  };
  const int m = static_cast<int>(corners.size());
  for (int k = 1; k + 1 < m; ++k) {
    Sides piece{{loop[corners[0]], loop[corners[k]], loop[corners[k + 1]]}, {}};
    if (k == 1) piece.within[0] = within(corners[0], corners[1]);
    piece.within[1] = within(corners[k], corners[k + 1]);
    if (k + 2 == m) piece.within[2] = within(corners[k + 1], corners[0]);
    Cut(piece, triangles);
  }
}

}  // namespace

std::vector<Triangle> TrianglesOf(const ConvexPolyhedron& body) {
  const Orientation orientation(body.vertices(), body.max_coordinate());
  std::vector<Triangle> triangles;
  for (int f = 0; f < body.face_count(); ++f) CutFace(orientation, body.face(f), &triangles);
  return triangles;
}

}  // namespace touchstone::internal
