// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/local_surface_internal.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "touchstone/core/minkowski/flat_table_internal.h"

namespace touchstone::internal {
namespace {

using Eigen::Vector3d;

// A side of a triangle, by its ends in order.
struct TriangleSide {
  int low, high;
  int triangle, side;
  bool rises;  // runs from low to high
};

}  // namespace

void FindNeighbors(LocalSum* sum) {
  // By the lower end, and then by the other: few share one end.
  auto lists =
      ListByOwner<TriangleSide>(static_cast<int>(sum->vertices.size()), [&](const auto& visit) {
        for (int t = 0; t < static_cast<int>(sum->triangles.size()); ++t) {
          for (int k = 0; k < 3; ++k) {
            const int u = sum->triangles[t][k], v = sum->triangles[t][(k + 1) % 3];
            visit(std::min(u, v), {std::min(u, v), std::max(u, v), t, k, u < v});
          }
        }
      });
  std::vector<TriangleSide>& sides = lists.items;
  for (std::size_t v = 0; v + 1 < lists.first.size(); ++v) {
    std::sort(sides.begin() + lists.first[v], sides.begin() + lists.first[v + 1],
              [](const TriangleSide& x, const TriangleSide& y) {
                if (x.high != y.high) return x.high < y.high;
                return 3 * x.triangle + x.side < 3 * y.triangle + y.side;
              });
  }
  sum->neighbors.assign(sum->triangles.size(), {-1, -1, -1});
  sum->is_border_vertex.assign(sum->vertices.size(), 0);
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t end = i + 1;
    while (end < sides.size() && sides[end].low == sides[i].low &&
           sides[end].high == sides[i].high) {
      ++end;
    }
    if (end == i + 2 && sides[i].rises != sides[i + 1].rises) {
      sum->neighbors[sides[i].triangle][sides[i].side] = sides[i + 1].triangle;
      sum->neighbors[sides[i + 1].triangle][sides[i + 1].side] = sides[i].triangle;
    } else {
      sum->is_border_vertex[sides[i].low] = sum->is_border_vertex[sides[i].high] = 1;
    }
    i = end;
  }
}

void FindVertexNormals(LocalSum* sum) {
  sum->vertex_normals.assign(sum->vertices.size(), Vector3d::Zero());
  std::vector<Vector3d> any(sum->vertices.size(), Vector3d::Zero());
  for (std::size_t i = 0; i < sum->triangles.size(); ++i) {
    const std::array<int, 3>& t = sum->triangles[i];
    const Vector3d& normal = sum->triangle_normals[i];
    Vector3d sides[3];
    double size = 0.0;
    for (int k = 0; k < 3; ++k) {
      sides[k] = sum->vertices[t[(k + 1) % 3]] - sum->vertices[t[k]];
      size = std::max(size, sides[k].cwiseAbs().maxCoeff());
      any[t[k]] = normal;
    }
    if (!(size > 0.0)) continue;
    // Of unit size: squares neither overflow nor vanish, whatever the scale of the bodies.
    for (Vector3d& side : sides) side /= size;
    const double twice = sides[0].cross(sides[1]).norm();
    for (int k = 0; k < 3; ++k) {
      const double angle = std::atan2(twice, -sides[k].dot(sides[(k + 2) % 3]));
      sum->vertex_normals[t[k]] += angle * normal;
    }
  }
  for (std::size_t v = 0; v < sum->vertices.size(); ++v) {
    Vector3d& normal = sum->vertex_normals[v];
    const double length = normal.norm();
    // Angles add up to a few units; a sum of so little has no direction.
    normal = length > 1e-9 ? Vector3d(normal / length) : any[v];
  }
}

}  // namespace touchstone::internal
