// SPDX-License-Identifier: MIT
#include "touchstone/core/mesh/surface_distance.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "touchstone/core/mesh/membership.h"
#include "touchstone/core/proximity/distance.h"
#include "touchstone/tests/testing/random.h"
#include "touchstone/tests/testing/shapes.h"
#include "touchstone/tools/shapes/shapes.h"

namespace touchstone {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// The pair's size, which errors refer to: coordinates of A, of B and of the translation.
double SizeOf(const MeshPair& pair) {
  return pair.a().mesh.max_coordinate() + 1.75 * pair.b().mesh.max_coordinate() +
         pair.pose().translation().cwiseAbs().maxCoeff();
}

// What every answer owes: bounds in order, points as far apart as said, a unit direction.
void ExpectSound(const MeshPair& pair, const SurfaceDistanceResult& result) {
  EXPECT_LE(0.0, result.lower_bound);
  EXPECT_LE(result.lower_bound, result.upper_bound);
  EXPECT_LE(result.distance, result.upper_bound);
  const double size = SizeOf(pair);
  EXPECT_NEAR((result.point_on_b - result.point_on_a).norm(), result.distance, 1e-14 * size);
  if (!result.direction.isZero()) {
    EXPECT_NEAR(result.direction.norm(), 1.0, 1e-14);
  }
}

// The least distance of all pairs of faces, by points of a region each: vertices over faces, edges
// beside edges.
double PointToTriangle(const Vector3d& p, const std::array<Vector3d, 3>& t) {
  const Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
  bool over = true;
  double least = 1e300;
  for (int k = 0; k < 3; ++k) {
    const Vector3d side = t[(k + 1) % 3] - t[k], to = p - t[k];
    over &= normal.dot(side.cross(to)) >= 0.0;
    const double part = std::clamp(side.dot(to) / side.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (to - part * side).norm());
  }
  return over ? std::min(least, std::abs(normal.dot(p - t[0])) / normal.norm()) : least;
}

// By ternary search, convex in the one parameter.
double SegmentToSegment(const Vector3d& a, const Vector3d& b, const Vector3d& c,
                        const Vector3d& d) {
  const auto at = [&](double s) {
    const Vector3d x = a + s * (b - a);
    const double t = std::clamp((x - c).dot(d - c) / (d - c).squaredNorm(), 0.0, 1.0);
    return (x - (c + t * (d - c))).norm();
  };
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 50; ++i) {
    const double third = (high - low) / 3.0;
    (at(low + third) < at(high - third) ? high : low) +=
        at(low + third) < at(high - third) ? -third : third;
  }
  return at(0.5 * (low + high));
}

double BruteForce(const TriangleMesh& a, const TriangleMesh& b, const RelativePose& pose) {
  double least = 1e300;
  const auto corners = [](const TriangleMesh& mesh, int f, const Matrix3d& r, const Vector3d& t) {
    std::array<Vector3d, 3> c;
    for (int k = 0; k < 3; ++k) c[k] = r * mesh.vertex(mesh.face(f)[k]) + t;
    return c;
  };
  for (int f = 0; f < a.face_count(); ++f) {
    const auto p = corners(a, f, Matrix3d::Identity(), Vector3d::Zero());
    for (int g = 0; g < b.face_count(); ++g) {
      const auto q = corners(b, g, pose.rotation(), pose.translation());
      for (int k = 0; k < 3; ++k) {
        least = std::min({least, PointToTriangle(p[k], q), PointToTriangle(q[k], p)});
        for (int l = 0; l < 3; ++l) {
          least = std::min(least, SegmentToSegment(p[k], p[(k + 1) % 3], q[l], q[(l + 1) % 3]));
        }
      }
    }
  }
  return least;
}

TEST(SurfaceDistance, BoxesOnTheGridAreExact) {
  for (const double scale : {1.0, 0x1p-320, 0x1p320}) {
    const TriangleMesh box = MustBuild(Moved(Box({0, 0, 0}, {1, 1, 1}), scale, Vector3d::Zero()));
    for (const auto& [at, expected] :
         std::vector<std::pair<Vector3d, double>>{{{4, 0.25, 0.5}, 3.0},
                                                  {{4, 5, 0.5}, 5.0},
                                                  {{3, 3, 2}, 3.0},
                                                  {{1, 0, 0}, 0.0},
                                                  {{1, 1, 1}, 0.0},
                                                  {{-1, -1, 0.5}, 0.0},
                                                  {{-1.5, 0.5, 0}, 0.5}}) {
      const MeshPair pair(box, box, *RelativePose::Make(Matrix3d::Identity(), scale * at));
      const SurfaceDistanceResult result = SurfaceDistance(pair);
      ExpectSound(pair, result);
      EXPECT_NEAR(result.distance, scale * expected, 1e-15 * SizeOf(pair));
      EXPECT_LE(result.lower_bound, scale * expected);
      EXPECT_GE(result.upper_bound, scale * expected);
      EXPECT_LE(result.upper_bound - result.lower_bound, 1e-13 * SizeOf(pair));
    }
  }
}

// Bodies whose distance Distance proves to be optimal by exact signs, from far apart to 1e-12.
TEST(SurfaceDistance, OfConvexBodiesIsWithinItsBounds) {
  std::printf("seed 51\n");
  testing::Random random(51);
  int separate = 0;
  double worst = 0.0;
  const std::vector<testing::Mesh> shapes = {
      testing::RoundBody(40, {2, 1, 0.5}, 7), testing::Triangulated(testing::Box({1, 0.01, 2})),
      testing::Triangulated(testing::Prism(12, 0.5)),
      testing::Triangulated(testing::Box({3, 1e-5, 1e-5})), testing::Tetrahedron()};
  SurfaceDistanceCache cache;
  for (int round = 0; round < 1500; ++round) {
    const testing::Mesh& p = shapes[random.Int(0, 4)];
    const testing::Mesh& q = shapes[random.Int(0, 4)];
    const ConvexPolyhedron body_p = testing::MustBuild(p), body_q = testing::MustBuild(q);
    const auto triangles = [](const testing::Mesh& mesh) {
      std::vector<Triangle> faces;
      for (const auto& f : mesh.faces) faces.push_back({f[0], f[1], f[2]});
      return *TriangleMesh::Build(mesh.vertices, faces);
    };
    const Matrix3d rotation = round % 4 == 0 ? Matrix3d(Matrix3d::Identity()) : random.Rotation();
    Vector3d at = 8.0 * random.Direction();
    if (round % 4 == 0) at = at.array().round();
    RelativePose pose = *RelativePose::Make(rotation, at);
    // Drawn up until little is left of the distance.
    const DistanceResult far = Distance(body_p, body_q, pose);
    if (far.kind != DistanceKind::kSeparate) continue;
    const double left = std::pow(10.0, random.Uniform(-12, 0));
    if (round % 3 != 0) {
      pose = *RelativePose::Make(rotation, at - (1.0 - left) * far.distance.value * far.direction);
    }
    const DistanceResult truth = Distance(body_p, body_q, pose);
    if (truth.kind != DistanceKind::kSeparate) continue;
    ++separate;
    const MeshPair pair(triangles(p), triangles(q), pose);
    const SurfaceDistanceResult result = SurfaceDistance(pair, &cache);
    ExpectSound(pair, result);
    ASSERT_LE(result.lower_bound, truth.upper) << round;
    ASSERT_GE(result.upper_bound, truth.lower) << round;
    worst = std::max(worst, (result.upper_bound - result.lower_bound) / SizeOf(pair));
  }
  EXPECT_GT(separate, 900);
  std::printf("bounds differ by at most %.3g of the size\n", worst);
  EXPECT_LE(worst, 1e-12);
}

TEST(SurfaceDistance, OfMeshesIsThatOfAllPairsOfFaces) {
  std::printf("seed 52\n");
  testing::Random random(52);
  const std::vector<TriangleMesh> meshes = {MustBuild(Torus(10, 6, 2.0, 0.5)), MustBuild(UShape()),
                                            MustBuild(Star(5)), MustBuild(InterlockedTori(8, 5)),
                                            MustBuild(HollowBox())};
  int separate = 0, close = 0;
  long compared = 0, all = 0;
  for (int round = 0; round < 100; ++round) {
    const TriangleMesh& a = meshes[random.Int(0, 4)];
    const TriangleMesh& b = meshes[random.Int(0, 4)];
    const RelativePose pose =
        *RelativePose::Make(random.Rotation(), random.Uniform(0.5, 4.0) * random.Direction());
    const MeshPair pair(a, b, pose);
    if (Membership(pair, Vector3d(Vector3d::Zero())).verdict != Verdict::kSeparate) continue;
    ++separate;
    const SurfaceDistanceResult result = SurfaceDistance(pair);
    ExpectSound(pair, result);
    const double brute = BruteForce(a, b, pose);
    close += brute < 0.3;
    ASSERT_NEAR(result.distance, brute, 1e-8) << round;
    ASSERT_LE(result.lower_bound, brute * (1 + 1e-12) + 1e-13);
    ASSERT_LE(result.upper_bound - result.lower_bound, 1e-12 * SizeOf(pair));
    compared += result.face_pairs;
    all += static_cast<long>(a.face_count()) * b.face_count();
    // Moved by less, whichever way, they are still apart.
    for (int k = 0; k < 8; ++k) {
      const Vector3d toward = k == 0 ? Vector3d(-result.direction) : random.Direction();
      EXPECT_EQ(Membership(pair, Vector3d((1 - 1e-9) * result.lower_bound * toward)).verdict,
                Verdict::kSeparate);
    }
    // Swapped: the same.
    const Matrix3d back = pose.rotation().transpose();
    const MeshPair swapped(b, a, *RelativePose::Make(back, -(back * pose.translation())));
    EXPECT_NEAR(SurfaceDistance(swapped).distance, result.distance, 1e-13 * SizeOf(pair));
  }
  EXPECT_GT(separate, 40);
  EXPECT_GT(close, 4);  // measured 9
  std::printf("%.2g of all pairs of faces compared\n", static_cast<double>(compared) / all);
  EXPECT_LT(compared, all / 5);
}

// Surfaces that cross: the bounds hold, the lower one says nothing.
TEST(SurfaceDistance, OfSurfacesThatCrossIsBoundedByZero) {
  std::printf("seed 53\n");
  testing::Random random(53);
  const TriangleMesh torus = MustBuild(Torus(12, 8, 2.0, 0.75));
  for (int round = 0; round < 40; ++round) {
    const MeshPair pair(torus, torus,
                        *RelativePose::Make(random.Rotation(), 0.5 * random.Direction()));
    if (Membership(pair, Vector3d(Vector3d::Zero())).face_a < 0) continue;
    EXPECT_LE(SurfaceDistance(pair).lower_bound, 1e-14);
  }
}

// One far larger than the other, by 1e198; and needles.
TEST(SurfaceDistance, ExtremesEndAndHold) {
  for (const double small : {1e-99, 1e-30, 1e-9}) {
    const TriangleMesh big = MustBuild(Moved(Torus(10, 6, 2.0, 0.5), 1e99, Vector3d::Zero()));
    const TriangleMesh tiny = MustBuild(Moved(Star(5), small, Vector3d::Zero()));
    const MeshPair pair(big, tiny, *RelativePose::Make(Matrix3d::Identity(), Vector3d(0, 0, 2e99)));
    const SurfaceDistanceResult result = SurfaceDistance(pair);
    ExpectSound(pair, result);
    EXPECT_GT(result.lower_bound, 1.4e99);
    EXPECT_LT(result.upper_bound - result.lower_bound, 1e-12 * SizeOf(pair));
  }
  const TriangleMesh cone = MustBuild(Cone(400, 1e-6, 5.0));
  const MeshPair pair(cone, cone, *RelativePose::Make(Matrix3d::Identity(), Vector3d(1e-3, 0, 0)));
  const SurfaceDistanceResult result = SurfaceDistance(pair);
  ExpectSound(pair, result);
  EXPECT_NEAR(result.distance, 1e-3 - 2e-6, 1e-9);
  EXPECT_LT(result.upper_bound - result.lower_bound, 1e-12 * SizeOf(pair));
}

}  // namespace
}  // namespace touchstone
