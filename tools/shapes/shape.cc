// SPDX-License-Identifier: MIT
#include "touchstone/tools/shapes/shape.h"

#include <cstdio>
#include <cstdlib>
#include <utility>

namespace touchstone {

int Shape::AddVertex(double x, double y, double z) {
  vertices.emplace_back(x, y, z);
  return static_cast<int>(vertices.size()) - 1;
}

void Shape::AddTriangle(int a, int b, int c) { faces.push_back({a, b, c}); }

void Shape::AddQuad(int a, int b, int c, int d) {
  AddTriangle(a, b, c);
  AddTriangle(a, c, d);
}

TriangleMesh MustBuild(const Shape& shape) {
  const StatusOr<TriangleMesh> mesh = TriangleMesh::Build(shape.vertices, shape.faces);
  if (!mesh.ok()) {
    std::fprintf(stderr, "shape refused: %s\n", mesh.status().ToString().c_str());
    std::abort();
  }
  return *mesh;
}

Shape Moved(Shape shape, double scale, const Eigen::Vector3d& offset) {
  for (Eigen::Vector3d& vertex : shape.vertices) vertex = scale * vertex + offset;
  return shape;
}

Shape Together(Shape a, const Shape& b) {
  const int shift = static_cast<int>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const Triangle& face : b.faces) {
    a.faces.push_back({face[0] + shift, face[1] + shift, face[2] + shift});
  }
  return a;
}

Shape Reversed(Shape shape) {
  for (Triangle& face : shape.faces) std::swap(face[1], face[2]);
  return shape;
}

// The first quarter is (1 - t^2, 2 t) / (1 + t^2), 0 <= t < 1: no library function.
std::array<double, 2> OnCircle(int i, int k) {
  const int quarter = 4 * i / k;
  const double t = static_cast<double>(4 * i - quarter * k) / k;
  const double x = (1 - t * t) / (1 + t * t), y = 2 * t / (1 + t * t);
  switch (quarter) {
    case 0:
      return {x, y};
    case 1:
      return {-y, x};
    case 2:
      return {-x, -y};
    default:
      return {y, -x};
  }
}

}  // namespace touchstone
