// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/convex_map.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <string>
#include <vector>

#include "touchstone/core/base/dyadic.h"
#include "touchstone/core/mesh/link.h"
#include "touchstone/tests/testing/random.h"
#include "touchstone/tools/shapes/shapes.h"

namespace touchstone {
namespace {

using Eigen::Vector3d;

constexpr double kMargin = 0x1p-45;

// By all neighbours, and by which side the solid lies on.
bool IsExtreme(const TriangleMesh& mesh, int v, const Vector3d& n) {
  for (const int h : mesh.vertex_half_edges(v)) {
    const DyadicVector along = ToDyadic(mesh.vertex(mesh.head(h))) - ToDyadic(mesh.vertex(v));
    if (Dot(ToDyadic(n), along).sign() > 0) return false;
  }
  return !LinkHolds(VertexLink(mesh, v), MakeLinkDirection(ToDyadic(n)));
}

// Whether x lies strictly within a region, by more than rounding.
bool IsWithin(const ConvexMap& map, int region, const Vector3d& x) {
  for (const int e : map.vertex_edges(region)) {
    const double side = map.pole(e).dot(x);
    if ((map.edge(e).left == region ? side : -side) < kMargin) return false;
  }
  return true;
}

TEST(ConvexMap, BoxIsItsOwn) {
  const TriangleMesh mesh = MustBuild(Refined(Box({1, 2, 3}, {4, 6, 8}), 100));
  const ConvexMap map = ConvexMap::Conforming(mesh, GaussMap(mesh));
  EXPECT_EQ(map.face_count(), 6);
  EXPECT_EQ(map.edge_count(), 12);
  ASSERT_EQ(map.vertex_count(), 8);
  std::vector<int> corners;
  for (int v = 0; v < 8; ++v) {
    EXPECT_EQ(map.vertex_faces(v).size(), 3u);
    ASSERT_EQ(map.vertices_over(v).size(), 1u);
    corners.push_back(map.vertices_over(v)[0]);
    // The corner of the box on that side of all.
    for (const int f : map.vertex_faces(v)) {
      const Vector3d& n = map.direction(f);
      for (int w = 0; w < mesh.vertex_count(); ++w) {
        EXPECT_LE(n.dot(mesh.vertex(w)), n.dot(mesh.vertex(corners.back())));
      }
    }
  }
  std::sort(corners.begin(), corners.end());
  EXPECT_EQ(std::unique(corners.begin(), corners.end()), corners.end());
  EXPECT_EQ(map.counts().missing_pieces, 0);
  EXPECT_EQ(map.counts().added_directions, 0);
}

// The base of a cone meets as many faces as it has sides, and so does the apex.
TEST(ConvexMap, ConeIsItsOwnWithCornersOfManyFaces) {
  for (const int sides : {3, 4, 40, 301}) {
    const TriangleMesh mesh = MustBuild(Cone(sides, 1.0, 2.0));
    const ConvexMap map = ConvexMap::Conforming(mesh, GaussMap(mesh));
    EXPECT_EQ(map.face_count(), sides + 1);
    EXPECT_EQ(map.edge_count(), 2 * sides);
    EXPECT_EQ(map.vertex_count(), sides + 1);
    for (int v = 0; v < map.vertex_count(); ++v) {
      ASSERT_EQ(map.vertices_over(v).size(), 1u);
      const std::size_t count = map.vertices_over(v)[0] == sides ? sides : 3;
      EXPECT_EQ(map.vertex_faces(v).size(), count);
    }
    for (int e = 0; e < map.edge_count(); ++e) EXPECT_EQ(map.edges_along(e).size(), 1u);
  }
}

// Each arc is a chain of edges from one face's normal to the other's, each edge counted once.
TEST(ConvexMap, EveryEdgeOfTheMeshRunsAlongAChain) {
  for (const std::string& name : ShapeNames()) {
    SCOPED_TRACE(name);
    const TriangleMesh mesh = MustBuild(NamedShape(name, 60));
    for (const MapArcs arcs : {MapArcs::kConvex, MapArcs::kAll}) {
      const ConvexMap map = ConvexMap::Conforming(mesh, GaussMap(mesh), arcs);
      EXPECT_EQ(map.counts().missing_pieces, 0);
      std::vector<std::vector<int>> ends(mesh.edge_count());
      for (int e = 0; e < map.edge_count(); ++e) {
        for (const int of_mesh : map.edges_along(e)) {
          ends[of_mesh].push_back(map.edge(e).tail);
          ends[of_mesh].push_back(map.edge(e).head);
        }
      }
      for (int e = 0; e < mesh.edge_count(); ++e) {
        const EdgeKind kind = mesh.edge_kind(e);
        const bool counts =
            kind == EdgeKind::kConvex || (kind == EdgeKind::kReflex && arcs == MapArcs::kAll);
        ASSERT_EQ(!ends[e].empty(), counts);
        // Every face of the map on the way comes twice, the first and the last once.
        std::sort(ends[e].begin(), ends[e].end());
        std::vector<int> once;
        for (std::size_t i = 0; i < ends[e].size();) {
          const bool is_twice = i + 1 < ends[e].size() && ends[e][i] == ends[e][i + 1];
          if (!is_twice) once.push_back(ends[e][i]);
          i += is_twice ? 2 : 1;
        }
        const int h = mesh.half_edge_of(e);
        std::vector<int> expected;
        if (counts) {
          expected = {map.face_of_mesh_face(h / 3), map.face_of_mesh_face(mesh.twin(h) / 3)};
          std::sort(expected.begin(), expected.end());
        }
        ASSERT_EQ(once, expected) << e;
      }
      for (int f = 0; f < mesh.face_count(); ++f) {
        const auto faces = map.faces_at(map.face_of_mesh_face(f));
        EXPECT_TRUE(std::binary_search(faces.begin(), faces.end(), f));
      }
    }
  }
}

TEST(ConvexMap, VerticesOverARegionAreThoseExtremeThere) {
  testing::Random random(41);
  for (const std::string& name : ShapeNames()) {
    SCOPED_TRACE(name);
    const TriangleMesh mesh = MustBuild(NamedShape(name, 60));
    const GaussMap gauss_map(mesh);
    const ConvexMap map = ConvexMap::Conforming(mesh, gauss_map, MapArcs::kConvex);
    int region = 0, within = 0;
    for (int i = 0; i < 300; ++i) {
      const Vector3d x = random.Direction();
      region = map.Walk(x, region, kMargin);
      if (!IsWithin(map, region, x)) continue;
      ++within;
      std::vector<int> expected;
      for (int v = 0; v < mesh.vertex_count(); ++v) {
        if (gauss_map.vertex_kind(v) != VertexKind::kWithin && IsExtreme(mesh, v, x)) {
          expected.push_back(v);
        }
      }
      const auto over = map.vertices_over(region);
      ASSERT_EQ(std::vector<int>(over.begin(), over.end()), expected) << x.transpose();
    }
    EXPECT_GT(within, 290);
  }
}

// The walk ends in the same region from anywhere.
TEST(ConvexMap, WalksEndWhereTheDirectionLies) {
  testing::Random random(42);
  for (const char* name : {"torus", "star", "fish", "cone"}) {
    const TriangleMesh mesh = MustBuild(NamedShape(name, 100));
    const ConvexMap map = ConvexMap::Conforming(mesh, GaussMap(mesh), MapArcs::kConvex);
    for (int i = 0; i < 300; ++i) {
      const Vector3d x = random.Direction();
      const int region = map.Walk(x, random.Int(0, map.vertex_count() - 1), kMargin);
      if (!IsWithin(map, region, x)) continue;
      EXPECT_EQ(map.Walk(x, random.Int(0, map.vertex_count() - 1), kMargin), region);
    }
  }
}

TEST(ConvexMap, ScaleAndPlaceOfTheBodyDoNotMatter) {
  for (const char* name : {"torus", "l", "cone"}) {
    const Shape shape = NamedShape(name, 60);
    const TriangleMesh mesh = MustBuild(shape);
    const ConvexMap map = ConvexMap::Conforming(mesh, GaussMap(mesh));
    for (const double scale : {0x1p-320, 0x1p320}) {
      const TriangleMesh scaled = MustBuild(Moved(shape, scale, Vector3d::Zero()));
      const ConvexMap same = ConvexMap::Conforming(scaled, GaussMap(scaled));
      ASSERT_EQ(same.face_count(), map.face_count());
      ASSERT_EQ(same.vertex_count(), map.vertex_count());
      for (int f = 0; f < map.face_count(); ++f) EXPECT_EQ(same.direction(f), map.direction(f));
    }
  }
}

}  // namespace
}  // namespace touchstone
