// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/local_sum.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "touchstone/core/mesh/membership.h"
#include "touchstone/core/minkowski/boundary.h"
#include "touchstone/tests/testing/random.h"
#include "touchstone/tools/shapes/shapes.h"

namespace touchstone {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr LocalBuilder kAllBuilders[] = {LocalBuilder::kFull, LocalBuilder::kBruteForce,
                                         LocalBuilder::kSphereHierarchy, LocalBuilder::kGapFilling};

RelativePose PoseOf(const Matrix3d& rotation, const Vector3d& translation = Vector3d::Zero()) {
  return *RelativePose::Make(rotation, translation);
}

// A triangle, sheet or segment of the output, to be compared.
struct Piece {
  SumFacet facet;
  std::array<Vector3d, 3> corners;

  Vector3d Middle() const { return (corners[0] + corners[1] + corners[2]) / 3.0; }
};

// Pieces in an order that does not depend on roundings within `tolerance`.
std::vector<Piece> Sorted(std::vector<Piece> pieces, double tolerance) {
  std::sort(pieces.begin(), pieces.end(), [&](const Piece& x, const Piece& y) {
    if (x.facet != y.facet) return x.facet < y.facet;
    const Vector3d u = x.Middle(), v = y.Middle();
    for (int i = 0; i < 3; ++i) {
      if (std::abs(u[i] - v[i]) > tolerance) return u[i] < v[i];
    }
    return false;
  });
  return pieces;
}

std::vector<Piece> PiecesOf(const LocalSum& sum) {
  std::vector<Piece> pieces;
  const auto add = [&](const SumFacet& facet, int a, int b, int c) {
    pieces.push_back({facet, {sum.vertices[a], sum.vertices[b], sum.vertices[c]}});
  };
  for (std::size_t t = 0; t < sum.triangles.size(); ++t) {
    const auto& [a, b, c] = sum.triangles[t];
    add(sum.facets[sum.facet_of_triangle[t]], a, b, c);
  }
  for (std::size_t t = 0; t < sum.sheets.size(); ++t) {
    const auto& [a, b, c] = sum.sheets[t];
    add(sum.facets[sum.facet_of_sheet[t]], a, b, c);
  }
  for (const auto& [a, b] : sum.segments) add({}, a, b, b);
  for (const int point : sum.points) add({}, point, point, point);
  return pieces;
}

bool AreAlike(const Piece& x, const Piece& y, double tolerance) {
  if (x.facet != y.facet) return false;
  for (int turn = 0; turn < 3; ++turn) {
    double distance = 0.0;
    for (int k = 0; k < 3; ++k) {
      distance = std::max(distance, (x.corners[k] - y.corners[(k + turn) % 3]).norm());
    }
    if (distance <= tolerance) return true;
  }
  return false;
}

// The same pieces, each corner within `tolerance`.
void ExpectSame(const LocalSum& x, const LocalSum& y, double tolerance) {
  const std::vector<Piece> of_x = Sorted(PiecesOf(x), tolerance),
                           of_y = Sorted(PiecesOf(y), tolerance);
  ASSERT_EQ(of_x.size(), of_y.size());
  for (std::size_t i = 0; i < of_x.size(); ++i) {
    ASSERT_TRUE(AreAlike(of_x[i], of_y[i], tolerance))
        << i << ": " << of_x[i].Middle().transpose() << " / " << of_y[i].Middle().transpose();
  }
}

// Neighbours are mutual, normals of unit length, lists of one length, facets in order.
void ExpectSound(const LocalSum& sum) {
  ASSERT_EQ(sum.triangles.size(), sum.facet_of_triangle.size());
  ASSERT_EQ(sum.triangles.size(), sum.cell_of_triangle.size());
  ASSERT_EQ(sum.triangles.size(), sum.neighbors.size());
  ASSERT_EQ(sum.names.size(), sum.vertices.size());
  ASSERT_EQ(sum.vertex_normals.size(), sum.vertices.size());
  ASSERT_EQ(sum.is_border_vertex.size(), sum.vertices.size());
  ASSERT_EQ(sum.changes.size(), sum.facets.size());
  EXPECT_TRUE(std::is_sorted(sum.facets.begin(), sum.facets.end()));
  EXPECT_EQ(sum.detached_patches, 0);
  for (std::size_t t = 0; t < sum.triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const int other = sum.neighbors[t][k];
      const int u = sum.triangles[t][k], v = sum.triangles[t][(k + 1) % 3];
      EXPECT_NEAR(sum.vertex_normals[u].norm(), 1.0, 1e-9);
      if (other < 0) {
        EXPECT_TRUE(sum.is_border_vertex[u] && sum.is_border_vertex[v]);
        continue;
      }
      bool is_mutual = false;
      for (int l = 0; l < 3; ++l) {
        is_mutual |= sum.neighbors[other][l] == static_cast<int>(t) &&
                     sum.triangles[other][l] == v && sum.triangles[other][(l + 1) % 3] == u;
      }
      EXPECT_TRUE(is_mutual);
    }
  }
}

// A pair of bodies with all four builders, warm.
class Builders {
 public:
  Builders(const Shape& a, const Shape& b) : a_(MustBuild(a)), b_(MustBuild(b)) {
    for (const LocalBuilder builder : kAllBuilders) {
      sums_.emplace_back(a_, b_, LocalSumOptions{builder});
    }
    size_ = a_.max_coordinate() + b_.max_coordinate();
  }

  // All builders give the same; returns how many pieces.
  std::size_t Compare(const RelativePose& pose, const Ball& ball) {
    const LocalSum& full = sums_[0].Update(pose, ball);
    ExpectSound(full);
    for (std::size_t k = 1; k < sums_.size(); ++k) {
      SCOPED_TRACE(ToString(kAllBuilders[k]));
      const LocalSum& sum = sums_[k].Update(pose, ball);
      ExpectSound(sum);
      ExpectSame(full, sum, 1e-9 * size_);
    }
    return PiecesOf(full).size();
  }

  const TriangleMesh& a() const { return a_; }
  const TriangleMesh& b() const { return b_; }
  double size() const { return size_; }
  LocalMinkowskiSum& sum(int k) { return sums_[k]; }

 private:
  TriangleMesh a_, b_;
  std::vector<LocalMinkowskiSum> sums_;
  double size_;
};

double DistanceToTriangle(const Vector3d& x, const Vector3d& a, const Vector3d& b,
                          const Vector3d& c) {
  const auto to_segment = [&](const Vector3d& u, const Vector3d& v) {
    const double t = std::clamp((x - u).dot(v - u) / (v - u).squaredNorm(), 0.0, 1.0);
    return (x - u - t * (v - u)).norm();
  };
  const Vector3d n = (b - a).cross(c - a).normalized();
  if (n.cross(b - a).dot(x - a) >= 0 && n.cross(c - b).dot(x - b) >= 0 &&
      n.cross(a - c).dot(x - c) >= 0) {
    return std::abs(n.dot(x - a));
  }
  return std::min({to_segment(a, b), to_segment(b, c), to_segment(c, a)});
}

TEST(LocalSum, IsTheWholeBoundaryInABallLargerThanIt) {
  testing::Random random(41);
  for (const auto& [name_a, name_b] :
       {std::pair("star", "u"), std::pair("torus", "torus"), std::pair("slot", "key"),
        std::pair("hollow", "key"), std::pair("spoon", "cup")}) {
    for (const Matrix3d& rotation : {Matrix3d(Matrix3d::Identity()), random.Rotation()}) {
      SCOPED_TRACE(name_a);
      Builders builders(NamedShape(name_a, 100), NamedShape(name_b, 100));
      const RelativePose pose = PoseOf(rotation, random.Direction());
      ASSERT_NO_FATAL_FAILURE(builders.Compare(pose, {Vector3d::Zero(), 100.0}));
      const LocalSum& local = builders.sum(2).sum();
      const MeshPair pair(builders.a(), builders.b(), pose);
      const SumBoundary whole =
          BuildSumBoundary(pair, GaussMap(builders.a()), GaussMap(builders.b()));
      EXPECT_EQ(local.triangles.size(), whole.triangles.size());
      EXPECT_EQ(local.sheets.size(), whole.sheets.size());
      EXPECT_EQ(local.segments.size(), whole.segments.size());
      EXPECT_EQ(local.points.size(), whole.points.size());
    }
  }
}

// Every triangle of the whole boundary that meets the ball is there, and none that is not of it.
TEST(LocalSum, IsTheWholeBoundaryClipped) {
  testing::Random random(42);
  std::size_t compared = 0;
  for (const auto& [name_a, name_b] :
       {std::pair("star", "u"), std::pair("axes", "dimpled"), std::pair("torus", "torus"),
        std::pair("spoon", "cup"), std::pair("tori", "hollow"), std::pair("spiked", "fish"),
        std::pair("slot", "key"), std::pair("l", "star"), std::pair("cone", "axes")}) {
    Builders builders(NamedShape(name_a, 100), NamedShape(name_b, 100));
    const RelativePose pose = PoseOf(random.Rotation(), random.Direction());
    const MeshPair pair(builders.a(), builders.b(), pose);
    const SumBoundary whole =
        BuildSumBoundary(pair, GaussMap(builders.a()), GaussMap(builders.b()));
    for (int i = 0; i < 8; ++i) {
      SCOPED_TRACE(std::string(name_a) + ' ' + name_b + ' ' + std::to_string(i));
      const auto& at = whole.triangles[random.Int(0, static_cast<int>(whole.triangles.size()) - 1)];
      const Ball ball{whole.vertices[at[0]] + 0.2 * random.Direction(),
                      builders.size() * random.Uniform(0.0, 0.3)};
      compared += builders.Compare(pose, ball);
      if (HasFatalFailure()) return;
      const LocalSum& local = builders.sum(2).sum();
      std::vector<char> is_met(local.triangles.size(), 0);
      std::vector<Piece> pieces = PiecesOf(local);
      std::size_t found = 0;
      for (std::size_t t = 0; t < whole.triangles.size(); ++t) {
        const auto& [a, b, c] = whole.triangles[t];
        const Piece piece{whole.facets[whole.facet_of_triangle[t]],
                          {whole.vertices[a], whole.vertices[b], whole.vertices[c]}};
        const bool is_there = std::any_of(pieces.begin(), pieces.end(),
                                          [&](const Piece& x) { return AreAlike(x, piece, 1e-9); });
        found += is_there;
        const double distance =
            DistanceToTriangle(ball.center, piece.corners[0], piece.corners[1], piece.corners[2]);
        if (distance < ball.radius - 1e-9) {
          EXPECT_TRUE(is_there) << distance << ' ' << ball.radius;
        }
      }
      EXPECT_EQ(found, local.triangles.size());
    }
  }
  EXPECT_GT(compared, 1000u);
}

}  // namespace
}  // namespace touchstone
