// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_MESH_IO_H_
#define TOUCHSTONE_TOOLS_MESH_IO_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "touchstone/core/convex/convex_polyhedron.h"
#include "touchstone/tools/loaded.h"

namespace touchstone {

// Points and polygons as a file gives them. Every index names a point.
struct PolygonSoup {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::vector<int>> polygons;

  // Whether every side of a polygon is met by exactly one other, run the other way.
  bool IsClosed() const;
};

// Reads OFF, OBJ, STL or PLY, by the file name's extension. In STL equal points are one point.
// An error names the file, and the line or byte where reading stopped, or the element.
Loaded<PolygonSoup> ReadPolygonSoup(const std::string& path);

// The body that the file holds, or, when `hull` is set, the convex hull of its points.
Loaded<ConvexPolyhedron> ReadBody(const std::string& path, bool hull);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_MESH_IO_H_
