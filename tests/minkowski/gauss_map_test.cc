// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/gauss_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "touchstone/core/base/dyadic.h"
#include "touchstone/core/mesh/link.h"
#include "touchstone/core/minkowski/cone_tree.h"
#include "touchstone/tests/testing/random.h"
#include "touchstone/tools/shapes/shapes.h"

namespace touchstone {
namespace {

using Eigen::Vector3d;

Shape UnitBox() { return Box({0, 0, 0}, {1, 1, 1}); }

int Count(const TriangleMesh& mesh, const GaussMap& map, VertexKind kind) {
  int count = 0;
  for (int v = 0; v < mesh.vertex_count(); ++v) count += map.vertex_kind(v) == kind;
  return count;
}

DyadicVector Difference(const TriangleMesh& mesh, int to, int from) {
  return ToDyadic(mesh.vertex(to)) - ToDyadic(mesh.vertex(from));
}

// By all neighbours, and by which side the solid lies on.
bool IsExtreme(const TriangleMesh& mesh, int v, const Vector3d& n) {
  for (const int h : mesh.vertex_half_edges(v)) {
    if (Dot(ToDyadic(n), Difference(mesh, mesh.head(h), v)).sign() > 0) return false;
  }
  return !LinkHolds(VertexLink(mesh, v), MakeLinkDirection(ToDyadic(n)));
}

TEST(GaussMap, VertexKindsOfKnownBodies) {
  const TriangleMesh box = MustBuild(UnitBox());
  EXPECT_EQ(Count(box, GaussMap(box), VertexKind::kCorner), 8);
  // Split edges and faces add vertices within them.
  const TriangleMesh fine = MustBuild(Refined(UnitBox(), 300));
  EXPECT_EQ(Count(fine, GaussMap(fine), VertexKind::kCorner), 8);
  EXPECT_EQ(Count(fine, GaussMap(fine), VertexKind::kWithin), fine.vertex_count() - 8);
  // The apex of a dent satisfies every inequality with the solid on the wrong side.
  const TriangleMesh dimpled = MustBuild(Dimpled(6));
  const GaussMap map(dimpled);
  EXPECT_EQ(map.vertex_kind(dimpled.vertex_count() - 1), VertexKind::kNever);
  const TriangleMesh spiked = MustBuild(Spiked(6));
  EXPECT_EQ(GaussMap(spiked).vertex_kind(spiked.vertex_count() - 1), VertexKind::kCorner);
}

TEST(GaussMap, EssentialNeighborsSayTheSameAsAll) {
  testing::Random random(1);
  for (const std::string& name : ShapeNames()) {
    SCOPED_TRACE(name);
    const TriangleMesh mesh = MustBuild(NamedShape(name, 120));
    const GaussMap map(mesh);
    int extreme = 0;
    for (int i = 0; i < 4000; ++i) {
      const int v = random.Int(0, mesh.vertex_count() - 1);
      const VertexKind kind = map.vertex_kind(v);
      // Random directions, and normals of faces and their sums, which lie on the cones' borders.
      Vector3d n = random.Direction();
      const auto ring = mesh.vertex_half_edges(v);
      if (i % 2 == 0) {
        n = mesh.face_normal(ring[random.Int(0, static_cast<int>(ring.size()) - 1)] / 3);
        if (i % 4 == 0) n += mesh.face_normal(ring[0] / 3);
      }
      const bool expected = IsExtreme(mesh, v, n);
      extreme += expected;
      if (kind == VertexKind::kNever) {
        EXPECT_FALSE(expected);
      } else if (kind == VertexKind::kCorner) {
        bool by_essential = true;
        for (const int w : map.essential_neighbors(v)) {
          by_essential &= Dot(ToDyadic(n), Difference(mesh, w, v)).sign() <= 0;
        }
        ASSERT_EQ(by_essential, expected) << v;
      }
      if (expected && kind != VertexKind::kWithin) {
        const NormalCone& cone = map.vertex_cone(v);
        EXPECT_GE(cone.axis.dot(n.normalized()), cone.cosine);
      }
    }
    EXPECT_GT(extreme, 20);
  }
}

TEST(GaussMap, ManyNeighborsAtOneVertex) {
  const TriangleMesh cone = MustBuild(Cone(500, 1.5, 4.0));
  const GaussMap map(cone);
  EXPECT_EQ(map.essential_neighbors(500).size(), 500u);  // the apex
  EXPECT_EQ(map.vertex_kind(501), VertexKind::kWithin);  // the middle of the base
}

// A reflex arc goes the long way round, in two pieces of at most half a circle: barely less where
// the edge is nearly flat.
TEST(GaussMap, ReflexArcsAreSplitAtTheirMiddles) {
  for (const std::string& name : ShapeNames()) {
    SCOPED_TRACE(name);
    const TriangleMesh mesh = MustBuild(NamedShape(name, 100));
    const GaussMap map(mesh);
    std::vector<int> pieces(mesh.edge_count(), 0);
    for (const Arc& arc : map.arcs()) {
      ++pieces[arc.edge];
      EXPECT_NEAR(arc.tail.norm(), 1.0, 1e-14);
      EXPECT_NEAR(arc.head.norm(), 1.0, 1e-14);
      EXPECT_TRUE(mesh.edge_kind(arc.edge) != EdgeKind::kReflex || arc.tail.dot(arc.head) < 1e-6);
      // The arc lies in the plane orthogonal to its edge.
      const int h = mesh.half_edge_of(arc.edge);
      const Vector3d along = (mesh.vertex(mesh.head(h)) - mesh.vertex(mesh.tail(h))).normalized();
      EXPECT_NEAR(along.dot(arc.tail), 0.0, 1e-12);
      EXPECT_NEAR(along.dot(arc.head), 0.0, 1e-12);
    }
    for (int e = 0; e < mesh.edge_count(); ++e) {
      const EdgeKind kind = mesh.edge_kind(e);
      EXPECT_EQ(pieces[e], kind == EdgeKind::kFlat ? 0 : kind == EdgeKind::kConvex ? 1 : 2);
    }
  }
}

TEST(ConeTree, FindsWhatAScanFinds) {
  testing::Random random(2);
  for (const int count : {1, 7, 8, 9, 65, 700}) {
    std::vector<NormalCone> cones(count), others(count / 2 + 1);
    for (auto* list : {&cones, &others}) {
      for (NormalCone& cone : *list) {
        cone = {random.Direction(), random.Int(0, 20) == 0 ? -1.0 : random.Uniform(0.7, 1.0)};
      }
    }
    std::vector<int> items, other_items;
    for (int i = 0; i < count; ++i) {
      if (i % 5 != 3) items.push_back(i);
    }
    for (std::size_t i = 0; i < others.size(); ++i) other_items.push_back(static_cast<int>(i));
    const ConeTree tree(cones, items), other_tree(others, other_items);
    for (int k = 0; k < 50; ++k) {
      const Vector3d direction = random.Direction();
      std::vector<int> found;
      tree.Along(direction, &found);
      std::sort(found.begin(), found.end());
      EXPECT_EQ(std::adjacent_find(found.begin(), found.end()), found.end());
      for (const int i : items) {
        if (cones[i].axis.dot(direction) < cones[i].cosine) continue;
        EXPECT_TRUE(std::binary_search(found.begin(), found.end(), i));
      }
    }
    std::vector<std::pair<int, int>> pairs;
    tree.Pairs(other_tree, &pairs);
    std::sort(pairs.begin(), pairs.end());
    EXPECT_EQ(std::adjacent_find(pairs.begin(), pairs.end()), pairs.end());
    for (const int i : items) {
      for (const int j : other_items) {
        const double angle = std::acos(std::clamp(cones[i].axis.dot(others[j].axis), -1.0, 1.0));
        if (angle > std::acos(cones[i].cosine) + std::acos(others[j].cosine)) continue;
        EXPECT_TRUE(std::binary_search(pairs.begin(), pairs.end(), std::pair(i, j)));
      }
    }
  }
}

}  // namespace
}  // namespace touchstone
