// SPDX-License-Identifier: MIT
#include "touchstone/core/cpd/phong_projection.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <vector>

#include "touchstone/core/cpd/vertex_normals.h"
#include "touchstone/tests/testing/random.h"

namespace touchstone {
namespace {

using Eigen::Vector3d;

// An octahedron cut `rounds` times by midpoints onto the ellipsoid with these semi-axes.
struct Surface {
  std::vector<Vector3d> vertices, normals;
  std::vector<std::array<int, 3>> triangles, neighbors;

  Surface(int rounds, const Vector3d& axes, const Vector3d& offset) {
    vertices = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                 {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    for (int i = 0; i < rounds; ++i) Cut();
    for (Vector3d& v : vertices) v = v.cwiseProduct(axes) + offset;
    normals = VertexNormals(vertices, triangles);
    std::map<std::pair<int, int>, int> sides;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      for (int k = 0; k < 3; ++k) sides[{triangles[t][k], triangles[t][(k + 1) % 3]}] = t;
    }
    for (const auto& t : triangles) {
      neighbors.push_back({sides.at({t[1], t[0]}), sides.at({t[2], t[1]}), sides.at({t[0], t[2]})});
    }
  }

  void Cut() {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [place, added] =
          middles.try_emplace(std::minmax(a, b), static_cast<int>(vertices.size()));
      if (added) vertices.push_back((vertices[a] + vertices[b]).normalized());
      return place->second;
    };
    std::vector<std::array<int, 3>> next;
    for (const auto& [a, b, c] : triangles) {
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      next.insert(next.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    triangles = next;
  }

  PhongSurface View() const { return {vertices, triangles, neighbors, normals}; }
};

// Corners of a face that lie on one line but for their rounding make a triangle of any direction.
TEST(VertexNormals, ThinTrianglesTellNone) {
  const std::vector<Vector3d> vertices = {
      {0, 0, 1}, {3, 1, 1}, {1, 1.0 / 3.0, 1.0 + 0x1p-50}, {-1, 4, 1}, {5, -6, 1}};
  const std::vector<std::array<int, 3>> triangles = {{0, 1, 2}, {2, 1, 3}, {0, 2, 3}, {1, 0, 4}};
  const std::vector<Vector3d> up(4, Vector3d::UnitZ());
  for (const NormalWeights weights :
       {NormalWeights::kAngle, NormalWeights::kArea, NormalWeights::kUniform}) {
    for (const auto& given : {std::vector<Vector3d>(), up}) {
      for (const Vector3d& normal : VertexNormals(vertices, triangles, weights, given)) {
        EXPECT_LT((normal - Vector3d::UnitZ()).norm(), 1e-14);
      }
    }
  }
}

TEST(PhongProjection, FindsPointsWhoseNormalIsTheDirection) {
  testing::Random random(7);
  int found = 0, missed = 0;
  for (int i = 0; i < 40; ++i) {
    const Surface surface(3, {1.0, 0.8, 0.6}, -0.5 * random.Unit() * random.Direction());
    std::vector<PhongPoint> points;
    for (int t = 0; t < static_cast<int>(surface.triangles.size()); ++t) {
      ProjectOntoTriangle(surface.View(), t, {.find_all = true}, &points);
    }
    missed += points.empty();
    for (const PhongPoint& point : points) {
      ++found;
      EXPECT_LT(point.residual, 1e-12);
      EXPECT_GE(point.at.minCoeff(), 0.0);
      EXPECT_NEAR(point.at.sum(), 1.0, 1e-15);
      const auto& [a, b, c] = surface.triangles[point.triangle];
      const Vector3d q = point.at[0] * surface.vertices[a] + point.at[1] * surface.vertices[b] +
                         point.at[2] * surface.vertices[c];
      EXPECT_LT((q - point.position).norm(), 1e-14);
      const Vector3d normal = (point.at[0] * surface.normals[a] + point.at[1] * surface.normals[b] +
                               point.at[2] * surface.normals[c])
                                  .normalized();
      // Near to the interpolated normal, and outward.
      EXPECT_GT(normal.dot(point.position.normalized()), 0.98);
    }
  }
  EXPECT_EQ(missed, 0);
  EXPECT_GT(found, 80);  // an ellipsoid has at least two feet
}

TEST(PhongProjection, BreadthFirstFindsWhatTheWholeHas) {
  const Surface surface(3, {1.0, 0.8, 0.6}, {0.05, 0.03, 0.02});
  for (int from = 0; from < 40; ++from) {
    const auto points = ProjectByBreadthFirst(surface.View(), from, {});
    ASSERT_FALSE(points.empty());
    EXPECT_LT(points[0].residual, 1e-12);
  }
}

// The plane along a side depends on the side's ends only, so neighbours agree there.
TEST(PhongProjection, TangentPlanesAgreeAcrossSides) {
  testing::Random random(9);
  for (int i = 0; i < 200; ++i) {
    Vector3d n[4];
    for (Vector3d& normal : n) normal = (Vector3d::UnitZ() + 0.9 * random.Direction()).normalized();
    const TangentBasis left({n[0], n[1], n[2]}, PhongInterpolation::kTangentBasis);
    const TangentBasis right({n[1], n[0], n[3]}, PhongInterpolation::kTangentBasis);
    const double s = random.Unit();
    std::array<TangentBasis::Basis, 3> unused;
    const auto p = left.At({1 - s, s, 0}, &unused), q = right.At({s, 1 - s, 0}, &unused);
    const Vector3d u = p.row(0).transpose().cross(p.row(1).transpose()).normalized();
    const Vector3d v = q.row(0).transpose().cross(q.row(1).transpose()).normalized();
    EXPECT_LT(u.cross(v).norm(), 1e-9);
  }
}

TEST(PhongProjection, DerivativesAreRates) {
  testing::Random random(13);
  constexpr double kH = 1e-6;
  for (int i = 0; i < 100; ++i) {
    std::array<Vector3d, 3> n;
    for (Vector3d& normal : n) normal = (Vector3d::UnitZ() + 0.8 * random.Direction()).normalized();
    for (const auto kind : {PhongInterpolation::kTangentBasis, PhongInterpolation::kNormals}) {
      const TangentBasis basis(n, kind);
      const Vector3d at(random.Uniform(0.1, 0.5), random.Uniform(0.1, 0.4), 0.3);
      std::array<TangentBasis::Basis, 3> derivatives, unused;
      basis.At(at, &derivatives);
      for (int k = 0; k < 3; ++k) {
        const Vector3d step = kH * Vector3d::Unit(k);
        const TangentBasis::Basis rate =
            (basis.At(at + step, &unused) - basis.At(at - step, &unused)) / (2 * kH);
        EXPECT_LT((rate - derivatives[k]).norm(), 1e-7);
      }
    }
  }
}

TEST(PhongProjection, RateIsThatOfThePoint) {
  const Vector3d offset(0.05, 0.03, 0.02);
  const Surface surface(3, {1.0, 0.8, 0.6}, offset);
  constexpr double kH = 1e-7;
  int compared = 0;
  for (int t = 0; t < static_cast<int>(surface.triangles.size()); ++t) {
    std::vector<PhongPoint> points;
    ProjectOntoTriangle(surface.View(), t, {}, &points);
    for (const PhongPoint& point : points) {
      if (!point.rate || point.at.minCoeff() < 0.01) continue;
      for (int k = 0; k < 3; ++k) {
        // The origin moved by h is the surface moved by -h, and the point seen from there.
        const Surface moved(3, {1.0, 0.8, 0.6}, offset - kH * Vector3d::Unit(k));
        std::vector<PhongPoint> after;
        ProjectOntoTriangle(moved.View(), t, {}, &after);
        ASSERT_EQ(after.size(), 1u);
        const Vector3d rate = (after[0].position + kH * Vector3d::Unit(k) - point.position) / kH;
        EXPECT_LT((rate - point.rate->col(k)).norm(), 1e-4 * (1.0 + point.rate->norm()));
        ++compared;
      }
    }
  }
  EXPECT_GE(compared, 3);
}

// The paper's Figure 2a: normals at the ends of a side that are opposite. Interpolated, they vanish
// in the middle, and any direction is "normal" there; tangent planes stay what they are.
TEST(PhongProjection, InterpolatedNormalsVanishWhereTangentPlanesDoNot) {
  const std::array<Vector3d, 3> n = {Vector3d(1, 0, 0), Vector3d(-1, 0, 0), Vector3d(1, 0, 0)};
  std::array<TangentBasis::Basis, 3> unused;
  const auto by_normals = TangentBasis(n, PhongInterpolation::kNormals).At({0.5, 0.5, 0}, &unused);
  EXPECT_LT(by_normals.norm(), 1e-15);
  const auto by_tangents =
      TangentBasis(n, PhongInterpolation::kTangentBasis).At({0.5, 0.5, 0}, &unused);
  const Vector3d normal = by_tangents.row(0).transpose().cross(by_tangents.row(1).transpose());
  EXPECT_GT(normal.norm(), 0.5);
  EXPECT_LT(normal.normalized().cross(Vector3d(1, 0, 0)).norm(), 1e-12);
}

TEST(PhongProjection, DegenerateInputHasNoSolutionAndNoNaN) {
  const std::vector<Vector3d> vertices = {{1, 0, 0}, {1, 1e-300, 0}, {1, 2, 0}, {1, 0, 1}};
  const std::vector<std::array<int, 3>> triangles = {{0, 1, 2}, {0, 0, 3}, {0, 2, 3}};
  const std::vector<std::array<int, 3>> none(3, {-1, -1, -1});
  for (const Vector3d& normal : {Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 0)}) {
    const std::vector<Vector3d> normals(4, normal);
    std::vector<PhongPoint> points;
    for (int t = 0; t < 3; ++t) {
      ProjectOntoTriangle({vertices, triangles, none, normals}, t, {.find_all = true}, &points);
    }
    for (const PhongPoint& point : points) EXPECT_TRUE(point.position.allFinite());
  }
}

}  // namespace
}  // namespace touchstone
