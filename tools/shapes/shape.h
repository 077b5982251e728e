// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_SHAPES_SHAPE_H_
#define TOUCHSTONE_TOOLS_SHAPES_SHAPE_H_

#include <Eigen/Core>
#include <array>
#include <vector>

#include "touchstone/core/mesh/triangle_mesh.h"

namespace touchstone {

// What TriangleMesh::Build takes, before it is built. Only operations that IEEE 754 rounds
// correctly make the coordinates: the same doubles on every machine.
struct Shape {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Triangle> faces;

  int AddVertex(double x, double y, double z);
  // Vertices counterclockwise seen from outside; a quadrilateral is cut from a to c.
  void AddTriangle(int a, int b, int c);
  void AddQuad(int a, int b, int c, int d);
};

// The mesh; prints the status and aborts if the shape is refused.
TriangleMesh MustBuild(const Shape& shape);

// All points x of `shape` to scale * x + offset.
Shape Moved(Shape shape, double scale, const Eigen::Vector3d& offset);
// Both as one shape: of two components more, not a union.
Shape Together(Shape a, const Shape& b);
// Inside out, to bound a cavity.
Shape Reversed(Shape shape);

// Point i of k round the unit circle, its quarters turned copies of one another; exact multiples of
// a quarter where they are. k >= 3.
std::array<double, 2> OnCircle(int i, int k);

// The shape with its longest edges halved until it has `face_count` faces, or one more; itself when
// it has as many. The new vertices lie within edges, so the body stays what it was up to the
// rounding of midpoints.
Shape Refined(const Shape& shape, int face_count);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_SHAPES_SHAPE_H_
