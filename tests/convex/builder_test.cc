// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "touchstone/core/base/dyadic.h"
#include "touchstone/core/convex/convex_polyhedron.h"
#include "touchstone/tests/testing/random.h"
#include "touchstone/tests/testing/shapes.h"

namespace touchstone {
namespace {

using Eigen::Vector3d;
using testing::Mesh;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Status BuildStatus(const Mesh& mesh) {
  return ConvexPolyhedron::Build(mesh.vertices, mesh.faces).status();
}

void ExpectFailure(const Mesh& mesh, StatusCode code, ElementKind kind, int index, int other = -1) {
  const Status status = BuildStatus(mesh);
  EXPECT_EQ(status.code, code) << status.ToString();
  EXPECT_EQ(status.element, kind) << status.ToString();
  EXPECT_EQ(status.index, index) << status.ToString();
  EXPECT_EQ(status.other, other) << status.ToString();
  EXPECT_FALSE(status.message.empty());
}

Mesh Flipped(Mesh mesh) {
  for (auto& loop : mesh.faces) std::reverse(loop.begin(), loop.end());
  return mesh;
}

Mesh Joined(Mesh a, const Mesh& b) {
  const int shift = static_cast<int>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (std::vector<int> loop : b.faces) {
    for (int& v : loop) v += shift;
    a.faces.push_back(loop);
  }
  return a;
}

TEST(Builder, AcceptsEveryShapeAndItValidates) {
  for (const auto& [name, mesh] : testing::AllShapes()) {
    SCOPED_TRACE(name);
    const auto body = ConvexPolyhedron::Build(mesh.vertices, mesh.faces);
    ASSERT_TRUE(body.ok()) << body.status().ToString();
    EXPECT_TRUE(body->FindValidationError().ok()) << body->FindValidationError().ToString();
    EXPECT_EQ(body->vertex_count(), static_cast<int>(mesh.vertices.size()));
    for (int f = 0; f < body->face_count(); ++f) {
      EXPECT_TRUE(std::ranges::equal(body->face(f), mesh.faces[f]));
    }
  }
}

TEST(Builder, IsConvexByBruteForce) {
  for (const auto& [name, mesh] : testing::AllShapes()) {
    if (mesh.vertices.size() > 200) continue;
    SCOPED_TRACE(name);
    const ConvexPolyhedron body = testing::MustBuild(mesh);
    for (int f = 0; f < body.face_count(); ++f) {
      const auto [a, b, c] = body.face_plane(f);
      const DyadicVector o = ToDyadic(body.vertex(a));
      const DyadicVector n = Cross(ToDyadic(body.vertex(b)) - o, ToDyadic(body.vertex(c)) - o);
      for (int v = 0; v < body.vertex_count(); ++v) {
        const int side = Dot(n, ToDyadic(body.vertex(v)) - o).sign();
        ASSERT_LE(side, 0);
        // Vertices in the plane are those of the facet.
        bool in_facet = false;
        for (int g : body.vertex_faces(v)) {
          in_facet |= body.facet_of_face(g) == body.facet_of_face(f);
        }
        ASSERT_EQ(side == 0, in_facet);
      }
    }
  }
}

TEST(Builder, NormalsAreWithinTheirBound) {
  for (const auto& [name, mesh] : testing::AllShapes()) {
    SCOPED_TRACE(name);
    const ConvexPolyhedron body = testing::MustBuild(mesh);
    for (int f = 0; f < body.face_count(); f += 1 + body.face_count() / 100) {
      const auto [a, b, c] = body.face_plane(f);
      const DyadicVector o = ToDyadic(body.vertex(a));
      const DyadicVector n = Cross(ToDyadic(body.vertex(b)) - o, ToDyadic(body.vertex(c)) - o);
      // Entries over the largest are rounded to 2^-53 each; normalising adds as little.
      std::array<int, 3> exponents;
      Vector3d expected;
      for (int i = 0; i < 3; ++i) expected[i] = n[i].ToScaledDouble(&exponents[i]);
      int greatest = -100000;
      for (int i = 0; i < 3; ++i) {
        if (expected[i] != 0) greatest = std::max(greatest, exponents[i]);
      }
      for (int i = 0; i < 3; ++i) expected[i] = std::ldexp(expected[i], exponents[i] - greatest);
      expected.normalize();
      EXPECT_LT((body.face_normal(f) - expected).cwiseAbs().maxCoeff(), 0x1p-46);
    }
  }
}

TEST(Builder, SizesAreWhatTheySay) {
  for (const auto& [name, mesh] : testing::AllShapes()) {
    if (mesh.vertices.size() > 500) continue;
    SCOPED_TRACE(name);
    const ConvexPolyhedron body = testing::MustBuild(mesh);
    double max = 0.0, diameter = 0.0;
    for (const Vector3d& v : body.vertices()) {
      max = std::max(max, v.cwiseAbs().maxCoeff());
      for (const Vector3d& w : body.vertices()) diameter = std::max(diameter, (v - w).norm());
    }
    EXPECT_EQ(body.max_coordinate(), max);
    EXPECT_GE(body.diameter_bound(), diameter);
    EXPECT_LT(body.diameter_bound(), 2 * diameter);
  }
}

TEST(Builder, NonFiniteNamesTheVertex) {
  for (double bad : {kInfinity, -kInfinity, std::numeric_limits<double>::quiet_NaN()}) {
    Mesh mesh = testing::Box({1, 1, 1});
    mesh.vertices[5][1] = bad;
    ExpectFailure(mesh, StatusCode::kNonFinite, ElementKind::kVertex, 5);
  }
}

TEST(Builder, RangeIsThatOfTheLargestCoordinate) {
  const Mesh box = testing::Box({1, 1, 1});
  EXPECT_TRUE(BuildStatus(testing::Placed(box, 1e-100)).ok());
  EXPECT_TRUE(BuildStatus(testing::Placed(box, 1e100)).ok());
  ExpectFailure(testing::Placed(box, std::nextafter(1e-100, 0)), StatusCode::kOutOfRange,
                ElementKind::kNone, -1);
  ExpectFailure(testing::Placed(box, 1e-120), StatusCode::kOutOfRange, ElementKind::kNone, -1);
  Mesh large = box;
  large.vertices[3][2] = std::nextafter(1e100, kInfinity);
  ExpectFailure(large, StatusCode::kOutOfRange, ElementKind::kVertex, 3);
  // One large coordinate makes the others legal, however small.
  EXPECT_TRUE(BuildStatus(testing::Box({1e100, 1e-300, 1e-320})).ok());
}

TEST(Builder, TooFewVerticesOrFaces) {
  ExpectFailure({}, StatusCode::kTooFewVertices, ElementKind::kNone, -1);
  ExpectFailure({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}},
                StatusCode::kTooFewVertices, ElementKind::kNone, -1);
  Mesh mesh = testing::Tetrahedron();
  mesh.faces.pop_back();
  ExpectFailure(mesh, StatusCode::kTooFewFaces, ElementKind::kNone, -1);
}

TEST(Builder, BadIndexNamesTheFace) {
  for (int bad : {-1, 8, std::numeric_limits<int>::max(), std::numeric_limits<int>::min()}) {
    Mesh mesh = testing::Box({1, 1, 1});
    mesh.faces[2][3] = bad;
    ExpectFailure(mesh, StatusCode::kBadIndex, ElementKind::kFace, 2, bad);
  }
}

TEST(Builder, DegenerateFaces) {
  Mesh mesh = testing::Box({1, 1, 1});
  mesh.faces[4] = {0, 4};
  ExpectFailure(mesh, StatusCode::kDegenerateFace, ElementKind::kFace, 4);
  mesh.faces[4] = {};
  ExpectFailure(mesh, StatusCode::kDegenerateFace, ElementKind::kFace, 4);
  mesh.faces[4] = {0, 4, 6, 4};
  ExpectFailure(mesh, StatusCode::kDegenerateFace, ElementKind::kFace, 4, 4);
}

// A tetrahedron with the middle of edge 0-1 as a vertex and the sliver 0, 1, middle as a face.
TEST(Builder, CollinearFaceIsDegenerate) {
  Mesh mesh = testing::Tetrahedron();
  mesh.vertices.emplace_back(0.5, 0, 0);
  mesh.faces = {{0, 2, 1}, {0, 4, 3}, {4, 1, 3}, {0, 1, 4}, {0, 3, 2}, {1, 2, 3}};
  ExpectFailure(mesh, StatusCode::kDegenerateFace, ElementKind::kFace, 3);
  // The same with the sliver left out: the vertex lies within the edge of a quadrilateral.
  mesh.faces = {{0, 2, 1, 4}, {0, 4, 3}, {4, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  EXPECT_TRUE(BuildStatus(mesh).ok()) << BuildStatus(mesh).ToString();
  // A polygon of collinear vertices only.
  mesh.vertices.emplace_back(0.25, 0, 0);
  mesh.faces = {{0, 2, 1}, {0, 5, 3}, {5, 4, 3}, {4, 1, 3}, {0, 1, 4, 5}, {0, 3, 2}, {1, 2, 3}};
  ExpectFailure(mesh, StatusCode::kDegenerateFace, ElementKind::kFace, 4);
}

TEST(Builder, UnreferencedVertex) {
  Mesh mesh = testing::Box({1, 1, 1});
  mesh.vertices.emplace_back(0.5, 0.5, 0.5);
  ExpectFailure(mesh, StatusCode::kUnreferencedVertex, ElementKind::kVertex, 8);
}

TEST(Builder, DuplicateVertexNamesBoth) {
  Mesh mesh = testing::SubdividedCube(2, false);
  mesh.vertices[7] = mesh.vertices[3];
  ExpectFailure(mesh, StatusCode::kDuplicateVertex, ElementKind::kVertex, 3, 7);
  // Zeros of either sign are equal.
  mesh = testing::Tetrahedron();
  mesh.vertices.emplace_back(-0.0, 0.0, -0.0);
  mesh.faces = {{0, 2, 1}, {4, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  ExpectFailure(mesh, StatusCode::kDuplicateVertex, ElementKind::kVertex, 0, 4);
}

TEST(Builder, OpenNamesTheEdge) {
  Mesh mesh = testing::Box({1, 1, 1});
  mesh.faces.pop_back();  // 1, 3, 7, 5
  ExpectFailure(mesh, StatusCode::kOpen, ElementKind::kEdge, 3, 1);
}

TEST(Builder, EdgeWithThreeFacesIsNonManifold) {
  Mesh mesh = testing::Box({1, 1, 1});
  mesh.faces.push_back({0, 2, 7});
  ExpectFailure(mesh, StatusCode::kNonManifold, ElementKind::kEdge, 0, 2);
}

// Two tetrahedra that share vertex 0 only.
TEST(Builder, PinchedVertexIsNonManifold) {
  Mesh mesh = testing::Tetrahedron();
  mesh.vertices.insert(mesh.vertices.end(), {{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}});
  mesh.faces.insert(mesh.faces.end(), {{0, 4, 5}, {0, 6, 4}, {0, 5, 6}, {4, 6, 5}});
  ExpectFailure(mesh, StatusCode::kNonManifold, ElementKind::kVertex, 0);
}

TEST(Builder, TwoComponentsAreNonManifold) {
  const Mesh box = testing::Box({1, 1, 1});
  ExpectFailure(Joined(box, testing::Placed(box, 1, {5, 0, 0})), StatusCode::kNonManifold,
                ElementKind::kVertex, 8);
  // One inside the other, inward: the boundary of a hollow box.
  ExpectFailure(Joined(box, Flipped(testing::Placed(box, 0.5))), StatusCode::kNonManifold,
                ElementKind::kVertex, 8);
}

// A ring of four boxes round a hole: V - E + F = 0.
TEST(Builder, TorusIsNonManifold) {
  Mesh mesh;
  for (int ring = 0; ring < 4; ++ring) {  // outer low, outer high, inner high, inner low
    const double r = ring < 2 ? 2 : 1, z = ring == 1 || ring == 2 ? 1 : 0;
    for (const auto& [x, y] : {std::pair(r, 0.0), {0.0, r}, {-r, 0.0}, {0.0, -r}}) {
      mesh.vertices.emplace_back(x, y, z);
    }
  }
  for (int ring = 0; ring < 4; ++ring) {
    for (int i = 0; i < 4; ++i) {
      const int a = 4 * ring, b = 4 * ((ring + 1) % 4), j = (i + 1) % 4;
      mesh.faces.push_back({a + i, a + j, b + j, b + i});
    }
  }
  ExpectFailure(mesh, StatusCode::kNonManifold, ElementKind::kNone, -1);
}

TEST(Builder, OneFlippedFaceIsInconsistent) {
  Mesh mesh = testing::Box({1, 1, 1});
  std::reverse(mesh.faces[3].begin(), mesh.faces[3].end());
  const Status status = BuildStatus(mesh);
  EXPECT_EQ(status.code, StatusCode::kInconsistentOrientation);
  EXPECT_EQ(status.element, ElementKind::kEdge);
  EXPECT_TRUE(std::ranges::count(mesh.faces[3], status.index));
  EXPECT_TRUE(std::ranges::count(mesh.faces[3], status.other));
}

TEST(Builder, AllInwardIsInconsistent) {
  for (const auto& [name, mesh] : testing::AllShapes()) {
    SCOPED_TRACE(name);
    ExpectFailure(Flipped(mesh), StatusCode::kInconsistentOrientation, ElementKind::kFace, 0);
  }
}

TEST(Builder, FlatBodies) {
  // A square, doubled and triangulated two ways.
  const Mesh square = {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                       {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}};
  ExpectFailure(square, StatusCode::kFlat, ElementKind::kNone, -1);
  // The same in a plane through no axis, exactly.
  Mesh tilted = square;
  for (Vector3d& v : tilted.vertices) v = {v[0] + 2 * v[1], 3 * v[0] - v[1], v[0] + v[1]};
  ExpectFailure(tilted, StatusCode::kFlat, ElementKind::kNone, -1);
  const Mesh line = {{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}},
                     {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
  ExpectFailure(line, StatusCode::kFlat, ElementKind::kNone, -1);
}

TEST(Builder, OneUlpOffThePlaneIsNonPlanar) {
  Mesh mesh = testing::Box({1, 1, 1});
  mesh.vertices[7][2] = std::nextafter(1.0, 2.0);
  const Status status = BuildStatus(mesh);
  EXPECT_EQ(status.code, StatusCode::kNonPlanarFace) << status.ToString();
  EXPECT_EQ(status.element, ElementKind::kFace);
  EXPECT_EQ(status.index, 1);
  EXPECT_TRUE(std::ranges::count(mesh.faces[1], status.other));
  EXPECT_NE(status.message.find("convex hull"), std::string::npos);
  // Far below the size of the body, too.
  mesh = testing::Box({1, 1, 1});
  for (int v : {4, 5, 6, 7}) mesh.vertices[v][2] = 1e-300;
  EXPECT_TRUE(BuildStatus(mesh).ok());
  mesh.vertices[7][2] = std::nextafter(1e-300, 1.0);
  EXPECT_EQ(BuildStatus(mesh).code, StatusCode::kNonPlanarFace);
}

// The top of a cube as two triangles, hinged on the diagonal 4-7: with vertex 5 an ulp low it is a
// convex ridge, an ulp high a concave one.
TEST(Builder, ConvexAndConcaveByOneUlp) {
  Mesh mesh = testing::Triangulated(testing::Box({1, 1, 1}));
  EXPECT_TRUE(BuildStatus(mesh).ok()) << BuildStatus(mesh).ToString();
  mesh.vertices[5][2] = std::nextafter(1.0, 0.0);
  EXPECT_TRUE(BuildStatus(mesh).ok()) << BuildStatus(mesh).ToString();
  mesh.vertices[5][2] = std::nextafter(1.0, 2.0);
  const Status status = BuildStatus(mesh);
  EXPECT_EQ(status.code, StatusCode::kNotConvex) << status.ToString();
  EXPECT_EQ(status.element, ElementKind::kFace);
  EXPECT_GE(status.other, 0);
}

TEST(Builder, DentIsNotConvex) {
  // A cube whose top has a vertex in the middle: outward legal, level legal, inward not.
  Mesh mesh = testing::Box({1, 1, 1});
  mesh.vertices.emplace_back(0, 0, 1);
  mesh.faces[1] = {4, 5, 8};
  mesh.faces.insert(mesh.faces.end(), {{5, 7, 8}, {7, 6, 8}, {6, 4, 8}});
  EXPECT_TRUE(BuildStatus(mesh).ok());
  mesh.vertices[8][2] = 1.5;
  EXPECT_TRUE(BuildStatus(mesh).ok());
  mesh.vertices[8][2] = std::nextafter(1.0, 0.0);
  EXPECT_EQ(BuildStatus(mesh).code, StatusCode::kNotConvex);
  EXPECT_EQ(BuildStatus(mesh).element, ElementKind::kFace);
}

// An L-shaped prism: its faces 0 and 1 are not convex polygons.
TEST(Builder, NonConvexFaceNamesFaceAndVertex) {
  Mesh mesh;
  for (double z : {0.0, 1.0}) {
    for (const auto& [x, y] :
         {std::pair(0.0, 0.0), {2.0, 0.0}, {2.0, 1.0}, {1.0, 1.0}, {1.0, 2.0}, {0.0, 2.0}}) {
      mesh.vertices.emplace_back(x, y, z);
    }
  }
  mesh.faces = {{5, 4, 3, 2, 1, 0}, {6, 7, 8, 9, 10, 11}};
  for (int i = 0; i < 6; ++i) mesh.faces.push_back({i, (i + 1) % 6, (i + 1) % 6 + 6, i + 6});
  ExpectFailure(mesh, StatusCode::kNotConvex, ElementKind::kFace, 0, 3);
}

// A prism over a pentagram: every turn of its big faces goes left, twice round.
TEST(Builder, PentagramFaceIsNotConvex) {
  const Mesh prism = testing::Prism(5, 1);
  Mesh mesh = prism;
  for (int i = 0; i < 5; ++i) {
    mesh.vertices[i] = prism.vertices[2 * i % 5];
    mesh.vertices[5 + i] = prism.vertices[5 + 2 * i % 5];
  }
  ExpectFailure(mesh, StatusCode::kNotConvex, ElementKind::kFace, 5);
}

// A bipyramid over a pentagram: V - E + F = 2, convex at every edge, its centre below every plane;
// it covers the sphere of directions twice.
TEST(Builder, PentagramBipyramidIsNotConvex) {
  const Mesh bipyramid = testing::Bipyramid(5, 1);
  Mesh mesh = bipyramid;
  for (int i = 0; i < 5; ++i) mesh.vertices[i] = bipyramid.vertices[2 * i % 5];
  const Status status = BuildStatus(mesh);
  EXPECT_EQ(status.code, StatusCode::kNotConvex) << status.ToString();
  EXPECT_EQ(status.element, ElementKind::kFace);
  for (const int k : {7, 8, 50, 101}) {  // k = 8 makes two squares, each run through once: 8/2
    Mesh star = testing::Bipyramid(k, 0.3);
    const Mesh plain = star;
    for (int step = 2; step < 4; ++step) {
      if (std::gcd(k, step) != 1) continue;
      for (int i = 0; i < k; ++i) star.vertices[i] = plain.vertices[step * i % k];
      EXPECT_EQ(BuildStatus(star).code, StatusCode::kNotConvex) << k << '/' << step;
    }
  }
}

// Coplanar neighbours folded onto each other: the middle of a cube's top pulled out over its rim.
TEST(Builder, FoldedCoplanarFacesAreNotConvex) {
  Mesh mesh = testing::Box({1, 1, 1});
  mesh.vertices.emplace_back(3, 0, 1);
  mesh.faces[1] = {4, 5, 8};
  mesh.faces.insert(mesh.faces.end(), {{5, 7, 8}, {7, 6, 8}, {6, 4, 8}});
  EXPECT_EQ(BuildStatus(mesh).code, StatusCode::kNotConvex) << BuildStatus(mesh).ToString();
}

// Any vertex of a strictly convex body moved by any amount: the builder must say what brute force
// says, and name a true defect.
TEST(Builder, MovedVertexAgreesWithBruteForce) {
  testing::Random random(11);
  int accepted = 0, refused = 0;
  for (int i = 0; i < 600; ++i) {
    Mesh mesh = testing::RoundBody(12, {2, 1, 1}, 100 + i % 20);
    const int v = random.Int(0, static_cast<int>(mesh.vertices.size()) - 1);
    const double step = std::ldexp(1.0, -random.Int(-2, 10));
    mesh.vertices[v] += step * random.Direction();
    bool convex = true;
    for (const auto& f : mesh.faces) {
      const DyadicVector o = ToDyadic(mesh.vertices[f[0]]);
      for (const Vector3d& w : mesh.vertices) {
        const int side = Determinant(ToDyadic(mesh.vertices[f[1]]) - o,
                                     ToDyadic(mesh.vertices[f[2]]) - o, ToDyadic(w) - o)
                             .sign();
        convex &= side <= 0;
      }
    }
    const Status status = BuildStatus(mesh);
    ASSERT_EQ(status.ok(), convex) << status.ToString();
    ++(convex ? accepted : refused);
    if (!convex && status.element == ElementKind::kFace && status.other >= 0) {
      const auto& f = mesh.faces[status.index];
      const DyadicVector o = ToDyadic(mesh.vertices[f[0]]);
      EXPECT_GT(Determinant(ToDyadic(mesh.vertices[f[1]]) - o, ToDyadic(mesh.vertices[f[2]]) - o,
                            ToDyadic(mesh.vertices[status.other]) - o)
                    .sign(),
                0);
    }
  }
  EXPECT_GT(accepted, 100);
  EXPECT_GT(refused, 100);
}

TEST(Builder, FacetsOfASubdividedCube) {
  for (bool triangulate : {false, true}) {
    const ConvexPolyhedron body = testing::MustBuild(testing::SubdividedCube(5, triangulate));
    const int per_side = body.face_count() / 6;
    for (int f = 0; f < body.face_count(); ++f) {
      EXPECT_EQ(body.facet_of_face(f), f / per_side * per_side);
    }
  }
}

TEST(Builder, RingsRunCounterclockwise) {
  const ConvexPolyhedron box = testing::MustBuild(testing::Box({1, 1, 1}));
  for (int v = 0; v < 8; ++v) {
    const auto w = box.vertex_neighbors(v);
    ASSERT_EQ(w.size(), 3u);
    const Vector3d a = box.vertex(w[0]) - box.vertex(v), b = box.vertex(w[1]) - box.vertex(v),
                   c = box.vertex(w[2]) - box.vertex(v);
    // Counterclockwise seen from outside, where they come towards the observer's far side.
    EXPECT_LT(a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
                  a[2] * (b[0] * c[1] - b[1] * c[0]),
              0);
  }
}

TEST(Builder, ALoopMayBeLarge) {
  const Mesh mesh = testing::Prism(20000, 1);
  const ConvexPolyhedron body = testing::MustBuild(mesh);
  EXPECT_EQ(body.face(20001).size(), 20000u);
  // The plane's vertices are well spread.
  const auto [a, b, c] = body.face_plane(20001);
  const Vector3d u = body.vertex(b) - body.vertex(a), v = body.vertex(c) - body.vertex(a);
  EXPECT_GT(std::abs(u[0] * v[1] - u[1] * v[0]), 0.5 * u.norm() * v.norm());
}

// A hundred thousand vertices: measured 0.2 s in a release build; quadratic steps would take hours.
TEST(Builder, LargeBodies) {
  const Mesh lens = testing::ParaboloidLens(223);
  EXPECT_TRUE(BuildStatus(lens).ok());
  EXPECT_TRUE(BuildStatus(testing::Triangulated(lens)).ok());
  EXPECT_TRUE(BuildStatus(testing::Bipyramid(100000, 1)).ok());
}

TEST(Builder, CopiesShareTheData) {
  const ConvexPolyhedron body = testing::MustBuild(testing::Octahedron());
  const ConvexPolyhedron copy = body;
  EXPECT_EQ(copy.vertices().data(), body.vertices().data());
}

}  // namespace
}  // namespace touchstone
