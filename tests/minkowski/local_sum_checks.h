// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TESTS_MINKOWSKI_LOCAL_SUM_CHECKS_H_
#define TOUCHSTONE_TESTS_MINKOWSKI_LOCAL_SUM_CHECKS_H_

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "touchstone/core/mesh/membership.h"
#include "touchstone/core/minkowski/local_sum.h"
#include "touchstone/tests/testing/poses.h"
#include "touchstone/tools/shapes/shapes.h"

namespace touchstone::testing {

inline constexpr LocalBuilder kAllBuilders[] = {LocalBuilder::kFull, LocalBuilder::kBruteForce,
                                                LocalBuilder::kSphereHierarchy,
                                                LocalBuilder::kGapFilling};

// A triangle, sheet or segment of the output, to be compared.
struct Piece {
  SumFacet facet;
  std::array<Eigen::Vector3d, 3> corners;

  Eigen::Vector3d Middle() const { return (corners[0] + corners[1] + corners[2]) / 3.0; }
};

// Pieces in an order that does not depend on roundings within `tolerance`.
inline std::vector<Piece> Sorted(std::vector<Piece> pieces, double tolerance) {
  std::sort(pieces.begin(), pieces.end(), [&](const Piece& x, const Piece& y) {
    if (x.facet != y.facet) return x.facet < y.facet;
    const Eigen::Vector3d u = x.Middle(), v = y.Middle();
    for (int i = 0; i < 3; ++i) {
      if (std::abs(u[i] - v[i]) > tolerance) return u[i] < v[i];
    }
    return false;
  });
  return pieces;
}

inline std::vector<Piece> PiecesOf(const LocalSum& sum) {
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

inline bool AreAlike(const Piece& x, const Piece& y, double tolerance) {
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
inline void ExpectSame(const LocalSum& x, const LocalSum& y, double tolerance) {
  const std::vector<Piece> of_x = Sorted(PiecesOf(x), tolerance),
                           of_y = Sorted(PiecesOf(y), tolerance);
  ASSERT_EQ(of_x.size(), of_y.size());
  for (std::size_t i = 0; i < of_x.size(); ++i) {
    ASSERT_TRUE(AreAlike(of_x[i], of_y[i], tolerance))
        << i << ": " << of_x[i].Middle().transpose() << " / " << of_y[i].Middle().transpose();
  }
}

// Neighbours are mutual, normals of unit length, lists of one length, facets in order.
inline void ExpectSound(const LocalSum& sum) {
  ASSERT_EQ(sum.triangles.size(), sum.facet_of_triangle.size());
  ASSERT_EQ(sum.triangles.size(), sum.cell_of_triangle.size());
  ASSERT_EQ(sum.triangles.size(), sum.neighbors.size());
  ASSERT_EQ(sum.triangles.size(), sum.triangle_normals.size());
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

  // All builders give the same, or all but the first; returns how many pieces.
  std::size_t Compare(const RelativePose& pose, const Ball& ball, bool with_full) {
    const std::size_t first = with_full ? 0 : 1;
    const LocalSum& expected = sums_[first].Update(pose, ball);
    ExpectSound(expected);
    for (std::size_t k = first + 1; k < sums_.size(); ++k) {
      SCOPED_TRACE(ToString(kAllBuilders[k]));
      const LocalSum& sum = sums_[k].Update(pose, ball);
      ExpectSound(sum);
      ExpectSame(expected, sum, 1e-9 * size_);
    }
    reuses_ += sums_[3].sum().reused;
    return PiecesOf(expected).size();
  }
  int gap_filling_reuses() const { return reuses_; }

  const TriangleMesh& a() const { return a_; }
  const TriangleMesh& b() const { return b_; }
  double size() const { return size_; }
  LocalMinkowskiSum& sum(int k) { return sums_[k]; }

 private:
  TriangleMesh a_, b_;
  std::vector<LocalMinkowskiSum> sums_;
  double size_;
  int reuses_ = 0;
};

}  // namespace touchstone::testing

#endif  // TOUCHSTONE_TESTS_MINKOWSKI_LOCAL_SUM_CHECKS_H_
