// SPDX-License-Identifier: MIT
//
// Bodies for tests, made without any other library: the same doubles on every machine.
#ifndef TOUCHSTONE_TESTS_TESTING_SHAPES_H_
#define TOUCHSTONE_TESTS_TESTING_SHAPES_H_

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "touchstone/core/convex/convex_polyhedron.h"

namespace touchstone::testing {

// What ConvexPolyhedron::Build takes, before it is built: tests spoil it on purpose.
struct Mesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::vector<int>> faces;
};

// The body; prints the status and aborts if the mesh is refused.
ConvexPolyhedron MustBuild(const Mesh& mesh);

// [-h, h] with six quadrilaterals; vertex i has x > 0 iff bit 0 of i is set, y bit 1, z bit 2.
Mesh Box(const Eigen::Vector3d& half_extents);
// (0,0,0), (1,0,0), (0,1,0), (0,0,1).
Mesh Tetrahedron();
// ±x, ±y, ±z at distance one.
Mesh Octahedron();
// A k-gon inscribed in the unit circle, k >= 3, times [-height, height]: two k-gons and k
// rectangles, all exactly planar. Vertices 0..k-1 below, k..2k-1 above.
Mesh Prism(int k, double height);
// The same k-gon and two apexes at ±height: vertices k (below) and k + 1, with k edges each.
Mesh Bipyramid(int k, double height);
// The cube [-1, 1]^3 with each face cut into cells x cells squares: vertices inside facets and
// inside edges. `triangulate` halves the squares.
Mesh SubdividedCube(int cells, bool triangulate);
// The cube [-1, 1]^3 with `count` more vertices inside each edge, its faces single polygons.
Mesh CubeWithSplitEdges(int count);
// Two paraboloids over a grid of cells x cells squares and four parabolic walls, all in integers:
// 2 (cells + 1)^2 vertices, quadrilaterals exactly planar, walls of 2 (cells + 1) vertices.
Mesh ParaboloidLens(int cells);

// The convex hull of points in general position (no four in a plane), by insertion with exact
// signs. Points inside are dropped, the others keep their order. Complexity: O(n^2).
Mesh Hull(const std::vector<Eigen::Vector3d>& points);
// The hull of n random points on the ellipsoid with these semi-axes.
Mesh RoundBody(int n, const Eigen::Vector3d& semi_axes, std::uint64_t seed);

// Every coordinate times `factor`, plus `offset`.
Mesh Placed(Mesh mesh, double factor, const Eigen::Vector3d& offset = Eigen::Vector3d::Zero());
// Every face cut into triangles from its first vertex (which needs no vertices within its edges).
Mesh Triangulated(const Mesh& mesh);

struct NamedMesh {
  std::string name;
  Mesh mesh;
};

// One of each, small and large, round and thin, at several scales: what a sweep should run over.
std::vector<NamedMesh> AllShapes();

}  // namespace touchstone::testing

#endif  // TOUCHSTONE_TESTS_TESTING_SHAPES_H_
