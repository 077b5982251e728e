// SPDX-License-Identifier: MIT
#include "touchstone/core/mesh/triangle_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "touchstone/core/base/dyadic.h"
#include "touchstone/tests/testing/random.h"
#include "touchstone/tools/shapes/shapes.h"

namespace touchstone {
namespace {

using Eigen::Vector3d;

Shape Tetrahedron() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
          {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

Shape UnitBox() { return Box({0, 0, 0}, {1, 1, 1}); }

// Equal points as one vertex.
Shape Merged(const Shape& shape) {
  Shape merged;
  std::vector<int> index;
  for (const Vector3d& x : shape.vertices) {
    const auto found = std::find(merged.vertices.begin(), merged.vertices.end(), x);
    index.push_back(static_cast<int>(found - merged.vertices.begin()));
    if (found == merged.vertices.end()) merged.vertices.push_back(x);
  }
  for (const Triangle& face : shape.faces) {
    merged.AddTriangle(index[face[0]], index[face[1]], index[face[2]]);
  }
  return merged;
}

Status BuildStatus(const Shape& shape) {
  return TriangleMesh::Build(shape.vertices, shape.faces).status();
}

void ExpectFailure(const Shape& shape, StatusCode code, ElementKind kind, int index,
                   int other = -1) {
  const Status status = BuildStatus(shape);
  EXPECT_EQ(status.code, code) << status.ToString();
  EXPECT_EQ(status.element, kind) << status.ToString();
  EXPECT_EQ(status.index, index) << status.ToString();
  EXPECT_EQ(status.other, other) << status.ToString();
  EXPECT_FALSE(status.message.empty());
}

int Count(const TriangleMesh& mesh, EdgeKind kind) {
  int count = 0;
  for (int e = 0; e < mesh.edge_count(); ++e) count += mesh.edge_kind(e) == kind;
  return count;
}

TEST(TriangleMesh, HalfEdgesAndRingsOfABox) {
  const TriangleMesh box = MustBuild(UnitBox());
  EXPECT_EQ(box.vertex_count(), 8);
  EXPECT_EQ(box.edge_count(), 18);
  EXPECT_EQ(box.face_count(), 12);
  EXPECT_EQ(Count(box, EdgeKind::kConvex), 12);
  EXPECT_EQ(Count(box, EdgeKind::kFlat), 6);
  for (int v = 0; v < 8; ++v) {
    const auto ring = box.vertex_half_edges(v);
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const int next = ring[(k + 1) % ring.size()];
      EXPECT_EQ(box.tail(ring[k]), v);
      // Counterclockwise from outside: the face between one and the next has both.
      EXPECT_EQ(box.apex(ring[k]), box.head(next));
      EXPECT_EQ(box.face_of(ring[k]), box.face_of(box.twin(next)));
    }
  }
  for (int f = 0; f < 12; ++f) {
    EXPECT_EQ(box.facet_of_face(f), f / 2 * 2);
    EXPECT_EQ(box.face_normal(f).cwiseAbs().maxCoeff(), 1.0);
  }
  ASSERT_EQ(box.components().size(), 1u);
  EXPECT_EQ(box.components()[0].euler_characteristic(), 2);
  EXPECT_EQ(box.components()[0].depth, 0);
}

TEST(TriangleMesh, EdgeKindsOfAU) {
  const TriangleMesh u = MustBuild(UShape());
  // Reflex are the two edges at the bottom of the gap.
  EXPECT_EQ(Count(u, EdgeKind::kReflex), 2);
  for (int e = 0; e < u.edge_count(); ++e) {
    const int h = u.half_edge_of(e);
    if (u.edge_kind(e) != EdgeKind::kReflex) continue;
    EXPECT_EQ(u.vertex(u.tail(h))[2], 1.0);
    EXPECT_EQ(u.vertex(u.head(h))[2], 1.0);
  }
}

// One ulp decides: the top of a tent over a square, lifted and lowered.
TEST(TriangleMesh, EdgeKindsAreExact) {
  for (const double scale : {1.0, 1e-99, 1e99}) {
    for (const int ulp : {-1, 0, 1}) {
      Shape box = Moved(UnitBox(), scale, Vector3d::Zero());
      // Vertex 7 of the top face 4 5 7 6, whose diagonal is 4-7: lower 5, and the diagonal bends.
      double& z = box.vertices[5][2];
      z = ulp == 0 ? z : std::nextafter(z, ulp * 1e300);
      const TriangleMesh mesh = MustBuild(box);
      for (int e = 0; e < mesh.edge_count(); ++e) {
        const int h = mesh.half_edge_of(e);
        if (mesh.tail(h) + mesh.head(h) != 11 || std::abs(mesh.tail(h) - mesh.head(h)) != 3)
          continue;
        EXPECT_EQ(mesh.edge_kind(e), ulp == 0  ? EdgeKind::kFlat
                                     : ulp < 0 ? EdgeKind::kConvex
                                               : EdgeKind::kReflex);
      }
    }
  }
}

TEST(TriangleMesh, BadCoordinates) {
  for (const double bad : {std::numeric_limits<double>::infinity(), std::nan("")}) {
    Shape shape = UnitBox();
    shape.vertices[5][1] = bad;
    ExpectFailure(shape, StatusCode::kNonFinite, ElementKind::kVertex, 5);
  }
  Shape shape = UnitBox();
  shape.vertices[3][2] = 1.1e100;
  ExpectFailure(shape, StatusCode::kOutOfRange, ElementKind::kVertex, 3);
  ExpectFailure(Moved(UnitBox(), 1e-101, Vector3d::Zero()), StatusCode::kOutOfRange,
                ElementKind::kNone, -1);
  EXPECT_TRUE(BuildStatus(Moved(UnitBox(), 1e-100, Vector3d::Zero())).ok());
  EXPECT_TRUE(BuildStatus(Moved(UnitBox(), 1e100, Vector3d::Zero())).ok());
  shape = UnitBox();
  shape.vertices[6] = shape.vertices[2];
  ExpectFailure(shape, StatusCode::kDuplicateVertex, ElementKind::kVertex, 2, 6);
  shape = UnitBox();
  shape.AddVertex(3, 3, 3);
  ExpectFailure(shape, StatusCode::kUnreferencedVertex, ElementKind::kVertex, 8);
}

TEST(TriangleMesh, BadFaces) {
  ExpectFailure({}, StatusCode::kTooFewVertices, ElementKind::kNone, -1);
  Shape shape = Tetrahedron();
  shape.faces.pop_back();
  ExpectFailure(shape, StatusCode::kTooFewFaces, ElementKind::kNone, -1);
  for (const int bad : {-1, 8, std::numeric_limits<int>::max(), std::numeric_limits<int>::min()}) {
    shape = UnitBox();
    shape.faces[3][1] = bad;
    ExpectFailure(shape, StatusCode::kBadIndex, ElementKind::kFace, 3, bad);
  }
  for (int k = 0; k < 3; ++k) {
    shape = UnitBox();
    shape.faces[4][k] = shape.faces[4][(k + 1) % 3];
    ExpectFailure(shape, StatusCode::kDegenerateFace, ElementKind::kFace, 4, shape.faces[4][k]);
  }
}

// The middle of edge 0-1 as a vertex, and the sliver 0, 1, middle as a face.
TEST(TriangleMesh, CollinearFaceIsDegenerateByExactSigns) {
  for (const double scale : {1.0, 1e-99, 1e99}) {
    Shape shape = Tetrahedron();
    shape.AddVertex(0.5, 0, 0);
    shape.faces = {{0, 2, 1}, {0, 4, 3}, {4, 1, 3}, {0, 1, 4}, {0, 3, 2}, {1, 2, 3}};
    shape = Moved(shape, scale, Vector3d::Zero());
    ExpectFailure(shape, StatusCode::kDegenerateFace, ElementKind::kFace, 3);
    // The smallest step off the line makes it a face.
    shape.vertices[4][2] = 1e-200;
    EXPECT_TRUE(BuildStatus(shape).ok()) << BuildStatus(shape).ToString();
  }
}

TEST(TriangleMesh, EdgesMustBeManifoldAndOriented) {
  Shape shape = UnitBox();
  shape.faces.erase(shape.faces.begin() + 7);
  EXPECT_EQ(BuildStatus(shape).code, StatusCode::kOpen);
  EXPECT_EQ(BuildStatus(shape).element, ElementKind::kEdge);
  shape = UnitBox();
  std::swap(shape.faces[7][0], shape.faces[7][1]);
  EXPECT_EQ(BuildStatus(shape).code, StatusCode::kInconsistentOrientation);
  shape = UnitBox();
  shape.faces.push_back(shape.faces[7]);
  EXPECT_EQ(BuildStatus(shape).code, StatusCode::kNonManifold);
  // Two boxes that share an edge.
  shape = Merged(Together(UnitBox(), Moved(UnitBox(), 1.0, {1, 1, 0})));
  EXPECT_EQ(shape.vertices.size(), 14u);
  ExpectFailure(shape, StatusCode::kNonManifold, ElementKind::kEdge, 7, 3);
}

// Two tetrahedra that share a vertex only.
TEST(TriangleMesh, PinchedVertexIsNonManifold) {
  const Shape reflected = Reversed(Moved(Tetrahedron(), -1.0, Vector3d::Zero()));
  const Shape shape = Merged(Together(Tetrahedron(), reflected));
  ExpectFailure(shape, StatusCode::kNonManifold, ElementKind::kVertex, 0);
}

TEST(TriangleMesh, FoldedFaces) {
  // A fin of no thickness on a tetrahedron: faces 1 3 4 and 3 1 4 lie on top of each other.
  Shape shape = Tetrahedron();
  shape.AddVertex(2, 0, 2);
  shape.faces = {{0, 2, 1}, {0, 1, 4}, {0, 4, 3}, {0, 3, 2}, {1, 2, 3}, {1, 3, 4}};
  // Edge 1-4 has faces 0 1 4 and 1 3 4, which share the plane y = 0.
  const Status status = BuildStatus(shape);
  EXPECT_EQ(status.code, StatusCode::kFolded) << status.ToString();
}

TEST(TriangleMesh, OutwardIsJudgedByComponentAndDepth) {
  ExpectFailure(Reversed(UnitBox()), StatusCode::kInward, ElementKind::kFace, 0);
  const Shape outer = Box({0, 0, 0}, {8, 8, 8});
  const Shape middle = Box({1, 1, 1}, {6, 6, 6}), inner = Box({2, 2, 2}, {3, 3, 3});
  const Shape aside = Box({10, 0, 0}, {11, 1, 1});
  // A box with a cavity, in which floats another box.
  Shape nested = Together(Together(outer, Reversed(middle)), Together(inner, aside));
  const TriangleMesh mesh = MustBuild(nested);
  ASSERT_EQ(mesh.components().size(), 4u);
  EXPECT_EQ(mesh.components()[0].depth, 0);
  EXPECT_EQ(mesh.components()[1].depth, 1);
  EXPECT_EQ(mesh.components()[2].depth, 2);
  EXPECT_EQ(mesh.components()[3].depth, 0);
  EXPECT_EQ(mesh.components()[2].first_face, 24);
  ExpectFailure(Together(outer, middle), StatusCode::kInward, ElementKind::kFace, 12);
  ExpectFailure(Together(Together(outer, Reversed(middle)), Reversed(inner)), StatusCode::kInward,
                ElementKind::kFace, 24);
  ExpectFailure(Together(outer, Reversed(aside)), StatusCode::kInward, ElementKind::kFace, 12);
}

// The ray from a component's first vertex passes through vertices, edges and faces of the others,
// for every placement on the grid.
TEST(TriangleMesh, DepthByRaysThroughVerticesAndEdges) {
  const Shape cavity = Box({1, 1, 1}, {7, 7, 7});
  const Shape hull = Box({0, 0, 0}, {8, 8, 8});
  const Shape finer = Refined(cavity, 300);
  for (int x = 2; x < 6; ++x) {
    for (int y = 2; y < 6; ++y) {
      for (int z = 2; z < 6; ++z) {
        const Shape inner = Box(Vector3d(x, y, z), Vector3d(x + 1, y + 1, z + 1));
        const TriangleMesh mesh = MustBuild(Together(Together(hull, Reversed(finer)), inner));
        EXPECT_EQ(mesh.components()[2].depth, 2);
      }
    }
  }
}

TEST(TriangleMesh, VolumeSignIsExact) {
  // A flat tetrahedron, and one lifted by the smallest step.
  Shape flat = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}},
                {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
  EXPECT_EQ(BuildStatus(flat).code, StatusCode::kFolded);
  flat.vertices[3][2] = 1e-300;
  EXPECT_TRUE(BuildStatus(flat).ok()) << BuildStatus(flat).ToString();
  flat.vertices[3][2] = -1e-300;
  ExpectFailure(flat, StatusCode::kInward, ElementKind::kFace, 0);
}

TEST(TriangleMesh, NormalsAreWithinTheirBound) {
  for (const char* name : {"torus", "spoon", "axes", "cone"}) {
    const TriangleMesh mesh = MustBuild(NamedShape(name, 500));
    for (int f = 0; f < mesh.face_count(); ++f) {
      const auto& [a, b, c] = mesh.face(f);
      const DyadicVector o = ToDyadic(mesh.vertex(a));
      const DyadicVector n = Cross(ToDyadic(mesh.vertex(b)) - o, ToDyadic(mesh.vertex(c)) - o);
      Vector3d expected(n[0].ToDouble(), n[1].ToDouble(), n[2].ToDouble());
      expected.normalize();
      EXPECT_LT((mesh.face_normal(f) - expected).cwiseAbs().maxCoeff(), 0x1p-46);
    }
  }
}

// Any list of faces is answered by a status, and a mesh that is built is valid.
TEST(TriangleMesh, RandomFacesNeverCrash) {
  testing::Random random(5);
  int built = 0;
  for (int i = 0; i < 20000; ++i) {
    Shape shape = i % 2 == 0 ? Tetrahedron() : UnitBox();
    for (int k = random.Int(0, 2); k > 0; --k) {
      Triangle& face = shape.faces[random.Int(0, static_cast<int>(shape.faces.size()) - 1)];
      face[random.Int(0, 2)] = random.Int(0, static_cast<int>(shape.vertices.size()) - 1);
    }
    for (int k = random.Int(0, 2); k > 0; --k) {
      Vector3d& v = shape.vertices[random.Int(0, static_cast<int>(shape.vertices.size()) - 1)];
      v[random.Int(0, 2)] = random.Int(-1, 2);
    }
    const auto mesh = TriangleMesh::Build(shape.vertices, shape.faces);
    if (!mesh.ok()) continue;
    ++built;
    ASSERT_TRUE(mesh->FindValidationError().ok());
  }
  EXPECT_GT(built, 1000);
}

}  // namespace
}  // namespace touchstone
