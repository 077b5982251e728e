// SPDX-License-Identifier: MIT
#include "touchstone/tests/testing/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <utility>

#include "touchstone/core/base/dyadic.h"
#include "touchstone/tests/testing/random.h"
#include "touchstone/tools/shapes/shape.h"

namespace touchstone::testing {
namespace {

using Eigen::Vector3d;

// Numbers vertices by their integer grid position, each position once.
class GridVertices {
 public:
  int Index(int x, int y, int z) {
    const auto [place, added] = index_.try_emplace({x, y, z}, static_cast<int>(index_.size()));
    if (added) positions_.push_back({x, y, z});
    return place->second;
  }
  std::vector<Vector3d> Vertices(double factor, double shift) const {
    std::vector<Vector3d> vertices;
    for (const auto& p : positions_) {
      vertices.push_back(factor * Vector3d(p[0], p[1], p[2]) + Vector3d::Constant(shift));
    }
    return vertices;
  }

 private:
  std::map<std::array<int, 3>, int> index_;
  std::vector<std::array<int, 3>> positions_;
};

// The side of the plane a, b, c that d lies on, exactly.
int Side(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
  const DyadicVector o = ToDyadic(a);
  // A coarse filter: terms below 2^3 size^3 each, with room to spare for all roundings.
  const Vector3d u = b - a, v = c - a, w = d - a;
  const double value = w[0] * (u[1] * v[2] - u[2] * v[1]) + w[1] * (u[2] * v[0] - u[0] * v[2]) +
                       w[2] * (u[0] * v[1] - u[1] * v[0]);
  const double size = u.cwiseAbs().maxCoeff() * v.cwiseAbs().maxCoeff() * w.cwiseAbs().maxCoeff();
  if (size > 1e-250 && std::abs(value) > 1e-13 * size) return value > 0 ? 1 : -1;
  return Determinant(ToDyadic(b) - o, ToDyadic(c) - o, ToDyadic(d) - o).sign();
}

bool IsCollinear(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const DyadicVector o = ToDyadic(a);
  const DyadicVector cross = Cross(ToDyadic(b) - o, ToDyadic(c) - o);
  return cross[0].sign() == 0 && cross[1].sign() == 0 && cross[2].sign() == 0;
}

[[noreturn]] void Abort(const char* what) {
  std::fprintf(stderr, "%s\n", what);
  std::abort();
}

using Triangle = std::array<int, 3>;

// Four points that span a tetrahedron, as its four triangles counterclockwise from outside.
std::vector<Triangle> FirstTetrahedron(const std::vector<Vector3d>& points) {
  const int n = static_cast<int>(points.size());
  int c = 2;
  while (c < n && IsCollinear(points[0], points[1], points[c])) ++c;
  for (int d = c + 1; d < n; ++d) {
    const int side = Side(points[0], points[1], points[c], points[d]);
    if (side == 0) continue;
    const int a = side < 0 ? 0 : 1, b = 1 - a;
    return {{a, b, c}, {b, a, d}, {c, b, d}, {a, c, d}};
  }
  Abort("Hull: all points lie in one plane");
}

}  // namespace

ConvexPolyhedron MustBuild(const Mesh& mesh) {
  StatusOr<ConvexPolyhedron> body = ConvexPolyhedron::Build(mesh.vertices, mesh.faces);
  if (!body.ok()) Abort(body.status().ToString().c_str());
  return *std::move(body);
}

Mesh Box(const Vector3d& half_extents) {
  Mesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.vertices.emplace_back((i & 1) ? half_extents[0] : -half_extents[0],
                               (i & 2) ? half_extents[1] : -half_extents[1],
                               (i & 4) ? half_extents[2] : -half_extents[2]);
  }
  mesh.faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  return mesh;
}

Mesh Tetrahedron() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
          {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

Mesh Octahedron() {
  Mesh mesh;
  mesh.vertices = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.faces = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  return mesh;
}

Mesh Prism(int k, double height) {
  Mesh mesh;
  for (double z : {-height, height}) {
    for (int i = 0; i < k; ++i) {
      const auto [x, y] = OnCircle(i, k);
      mesh.vertices.emplace_back(x, y, z);
    }
  }
  std::vector<int> bottom, top;
  for (int i = 0; i < k; ++i) {
    const int next = (i + 1) % k;
    bottom.push_back(k - 1 - i);
    top.push_back(k + i);
    mesh.faces.push_back({i, next, k + next, k + i});
  }
  mesh.faces.push_back(bottom);
  mesh.faces.push_back(top);
  return mesh;
}

Mesh Bipyramid(int k, double height) {
  Mesh mesh;
  for (int i = 0; i < k; ++i) {
    const auto [x, y] = OnCircle(i, k);
    mesh.vertices.emplace_back(x, y, 0);
    mesh.faces.push_back({(i + 1) % k, i, k});
    mesh.faces.push_back({i, (i + 1) % k, k + 1});
  }
  mesh.vertices.emplace_back(0, 0, -height);
  mesh.vertices.emplace_back(0, 0, height);
  return mesh;
}

Mesh SubdividedCube(int cells, bool triangulate) {
  Mesh mesh;
  GridVertices grid;
  for (int axis = 0; axis < 3; ++axis) {
    for (int upper = 0; upper < 2; ++upper) {
      for (int i = 0; i < cells; ++i) {
        for (int j = 0; j < cells; ++j) {
          std::vector<int> square;
          for (const auto& [di, dj] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}}) {
            std::array<int, 3> p;
            p[axis] = upper * cells;
            p[(axis + 1) % 3] = i + di;
            p[(axis + 2) % 3] = j + dj;
            square.push_back(grid.Index(p[0], p[1], p[2]));
          }
          if (upper == 0) std::reverse(square.begin(), square.end());
          if (triangulate) {
            mesh.faces.push_back({square[0], square[1], square[2]});
            mesh.faces.push_back({square[0], square[2], square[3]});
          } else {
            mesh.faces.push_back(square);
          }
        }
      }
    }
  }
  mesh.vertices = grid.Vertices(1.0, 0.0);
  for (Vector3d& v : mesh.vertices) v = 2.0 * v / cells - Vector3d::Ones();
  return mesh;
}

Mesh CubeWithSplitEdges(int count) {
  Mesh mesh;
  GridVertices grid;
  const int cells = count + 1;
  for (const std::vector<int>& corners : Box(Vector3d::Ones()).faces) {
    std::vector<int> loop;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const int a = corners[i], b = corners[(i + 1) % corners.size()];
      for (int step = 0; step < cells; ++step) {
        std::array<int, 3> p;
        for (int axis = 0; axis < 3; ++axis) {
          const int from = (a >> axis) & 1, to = (b >> axis) & 1;
          p[axis] = from * cells + (to - from) * step;
        }
        loop.push_back(grid.Index(p[0], p[1], p[2]));
      }
    }
    mesh.faces.push_back(loop);
  }
  mesh.vertices = grid.Vertices(1.0, 0.0);
  for (Vector3d& v : mesh.vertices) v = 2.0 * v / cells - Vector3d::Ones();
  return mesh;
}

Mesh ParaboloidLens(int cells) {
  // The corners of a square of the grid lie on a circle, so (x, y, x^2 + y^2) lifts them to a
  // plane.
  Mesh mesh;
  const int k = cells + 1;
  const auto index = [&](int upper, int i, int j) { return (upper * k + i) * k + j; };
  const int top = cells * cells + 2;  // keeps the two rims apart
  for (int upper = 0; upper < 2; ++upper) {
    for (int i = 0; i < k; ++i) {
      for (int j = 0; j < k; ++j) {
        const int lift = i * (i - cells) + j * (j - cells);
        mesh.vertices.emplace_back(2 * i - cells, 2 * j - cells, upper ? top - lift : lift - top);
      }
    }
  }
  for (int i = 0; i < cells; ++i) {
    for (int j = 0; j < cells; ++j) {
      mesh.faces.push_back(
          {index(0, i, j), index(0, i, j + 1), index(0, i + 1, j + 1), index(0, i + 1, j)});
      mesh.faces.push_back(
          {index(1, i, j), index(1, i + 1, j), index(1, i + 1, j + 1), index(1, i, j + 1)});
    }
  }
  std::array<std::vector<int>, 4> walls;
  for (int s = 0; s < k; ++s) {
    const int t = cells - s;
    walls[0].push_back(index(0, s, 0));
    walls[1].push_back(index(0, t, cells));
    walls[2].push_back(index(0, 0, t));
    walls[3].push_back(index(0, cells, s));
  }
  for (int s = 0; s < k; ++s) {
    const int t = cells - s;
    walls[0].push_back(index(1, t, 0));
    walls[1].push_back(index(1, s, cells));
    walls[2].push_back(index(1, 0, s));
    walls[3].push_back(index(1, cells, t));
  }
  mesh.faces.insert(mesh.faces.end(), walls.begin(), walls.end());
  return mesh;
}

Mesh Hull(const std::vector<Vector3d>& points) {
  std::vector<Triangle> triangles = FirstTetrahedron(points);
  std::vector<Triangle> kept;
  std::map<std::pair<int, int>, bool> border;  // edges of the triangles that the point sees
  for (int p = 0; p < static_cast<int>(points.size()); ++p) {
    kept.clear();
    border.clear();
    for (const Triangle& t : triangles) {
      if (Side(points[t[0]], points[t[1]], points[t[2]], points[p]) <= 0) {
        kept.push_back(t);
        continue;
      }
      for (int i = 0; i < 3; ++i) border[{t[i], t[(i + 1) % 3]}] = true;
    }
    for (const auto& [edge, seen] : border) {
      if (!border.contains({edge.second, edge.first})) kept.push_back({edge.first, edge.second, p});
    }
    triangles.swap(kept);
  }
  std::vector<int> number(points.size(), -1);
  for (const Triangle& t : triangles) {
    for (int v : t) number[v] = 0;
  }
  Mesh mesh;
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (number[p] < 0) continue;
    number[p] = static_cast<int>(mesh.vertices.size());
    mesh.vertices.push_back(points[p]);
  }
  for (const Triangle& t : triangles) {
    mesh.faces.push_back({number[t[0]], number[t[1]], number[t[2]]});
  }
  return mesh;
}

Mesh RoundBody(int n, const Vector3d& semi_axes, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vector3d> points;
  for (int i = 0; i < n; ++i) points.push_back(random.Direction().cwiseProduct(semi_axes));
  return Hull(points);
}

Mesh Placed(Mesh mesh, double factor, const Vector3d& offset) {
  for (Vector3d& v : mesh.vertices) v = factor * v + offset;
  return mesh;
}

Mesh Triangulated(const Mesh& mesh) {
  Mesh triangles;
  triangles.vertices = mesh.vertices;
  for (const std::vector<int>& loop : mesh.faces) {
    for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
      triangles.faces.push_back({loop[0], loop[i], loop[i + 1]});
    }
  }
  return triangles;
}

std::vector<NamedMesh> AllShapes() {
  std::vector<NamedMesh> shapes = {
      {"tetrahedron", Tetrahedron()},
      {"octahedron", Octahedron()},
      {"box", Box({1, 2, 3})},
      {"needle box", Box({1, 1e-6, 1e-9})},
      {"prism 3", Prism(3, 1)},
      {"prism 7", Prism(7, 0.25)},
      {"prism 200", Prism(200, 2)},
      {"bipyramid 5", Bipyramid(5, 1)},
      {"bipyramid 300", Bipyramid(300, 3)},
      {"subdivided cube 3", SubdividedCube(3, false)},
      {"subdivided cube 4", SubdividedCube(4, true)},
      {"subdivided cube 16", SubdividedCube(16, true)},
      {"cube with split edges", CubeWithSplitEdges(3)},
      {"paraboloid lens 6", ParaboloidLens(6)},
      {"paraboloid lens 30", ParaboloidLens(30)},
      {"triangulated lens 6", Triangulated(ParaboloidLens(6))},
      {"round 8", RoundBody(8, {1, 1, 1}, 1)},
      {"round 20", RoundBody(20, {2, 1, 1}, 2)},
      {"round 100", RoundBody(100, {10, 1, 1}, 3)},
      {"round 400", RoundBody(400, {2, 1, 1}, 4)},
      {"disc 200", RoundBody(200, {1, 1, 0.01}, 5)},
      {"needle 100", RoundBody(100, {1, 1e-3, 1e-3}, 6)},
  };
  const std::vector<NamedMesh> plain = shapes;
  for (const NamedMesh& shape : plain) {
    if (shape.name == "box" || shape.name == "prism 7" || shape.name == "round 100" ||
        shape.name == "subdivided cube 4") {
      shapes.push_back({shape.name + " at 2^-300", Placed(shape.mesh, 0x1p-300)});
      shapes.push_back({shape.name + " at 2^300", Placed(shape.mesh, 0x1p300)});
    }
  }
  shapes.push_back({"box at offset 1e8", Placed(Box({1, 2, 3}), 1, {1e8, -1e8, 1e8})});
  return shapes;
}

}  // namespace touchstone::testing
