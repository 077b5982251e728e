// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/convolution.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <string>
#include <vector>

#include "touchstone/tests/testing/poses.h"
#include "touchstone/tests/testing/random.h"
#include "touchstone/tools/shapes/shapes.h"

namespace touchstone {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using touchstone::testing::PoseOf;

// Poses in which faces and edges of the two are parallel, nearly parallel, or in general position.
std::vector<Matrix3d> Rotations() {
  testing::Random random(3);
  std::vector<Matrix3d> rotations = {Matrix3d::Identity()};
  Matrix3d quarter;
  quarter << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  rotations.push_back(quarter);
  for (const double angle : {1e-16, 1e-12, 1e-6}) {
    rotations.push_back(Eigen::AngleAxisd(angle, random.Direction()).toRotationMatrix());
  }
  rotations.push_back(random.Rotation());
  return rotations;
}

TEST(Convolution, TreesFindWhatBruteForceFinds) {
  for (const auto& [name_a, name_b] :
       {std::pair("box", "box"), std::pair("l", "u"), std::pair("slot", "key"),
        std::pair("cone", "axes"), std::pair("star", "star"), std::pair("torus", "torus"),
        std::pair("spoon", "cup"), std::pair("dimpled", "spiked"), std::pair("hollow", "tori")}) {
    const TriangleMesh a = MustBuild(NamedShape(name_a, 100)),
                       b = MustBuild(NamedShape(name_b, 100));
    const GaussMap map_a(a), map_b(b);
    for (const Matrix3d& rotation : Rotations()) {
      const MeshPair pair(a, b, PoseOf(rotation));
      const Convolution trees = ReducedConvolution(pair, map_a, map_b);
      ASSERT_EQ(trees.facets, ConvolutionByBruteForce(pair, map_a, map_b).facets)
          << name_a << ' ' << name_b;
      EXPECT_GT(trees.facets.size(), 30u);
    }
  }
}

// For convex bodies in general position: a face of A goes with one vertex of B and the other way
// round, and the facets make one closed surface.
TEST(Convolution, ConvexBodiesInGeneralPosition) {
  testing::Random random(4);
  const TriangleMesh a = MustBuild(Cone(9, 1, 2)), b = MustBuild(Box({0, 0, 0}, {1, 2, 3}));
  const GaussMap map_a(a), map_b(b);
  for (int i = 0; i < 20; ++i) {
    const MeshPair pair(a, b, PoseOf(random.Rotation()));
    int edges = 0, facets = 0, vertices = 0;
    std::vector<SumVertex> seen;
    for (const SumFacet& facet : ReducedConvolution(pair, map_a, map_b).facets) {
      const SumCorners corners = CornersOf(pair, facet);
      ++facets;
      edges += corners.count;
      seen.insert(seen.end(), corners.vertices.begin(), corners.vertices.begin() + corners.count);
    }
    std::sort(seen.begin(), seen.end());
    vertices = static_cast<int>(std::unique(seen.begin(), seen.end()) - seen.begin());
    EXPECT_EQ(vertices - edges / 2 + facets, 2);
  }
}

TEST(Convolution, SwappingTheBodiesSwapsTheNames) {
  testing::Random random(5);
  const TriangleMesh a = MustBuild(NamedShape("dimpled", 0)), b = MustBuild(NamedShape("u", 0));
  const GaussMap map_a(a), map_b(b);
  for (int i = 0; i < 10; ++i) {
    // Exact inverses: quarters of turns.
    Matrix3d rotation = Matrix3d::Identity();
    for (int k = random.Int(0, 3); k > 0; --k) {
      Matrix3d quarter;
      quarter << 0, -1, 0, 1, 0, 0, 0, 0, 1;
      rotation = quarter * rotation;
      quarter << 1, 0, 0, 0, 0, -1, 0, 1, 0;
      rotation = quarter * rotation;
    }
    const MeshPair pair(a, b, PoseOf(rotation)), swapped(b, a, PoseOf(rotation.transpose()));
    std::vector<SumFacet> facets = ReducedConvolution(pair, map_a, map_b).facets;
    for (SumFacet& facet : facets) {
      std::swap(facet.a, facet.b);
      if (facet.kind == SumFacetKind::kFaceVertex) {
        facet.kind = SumFacetKind::kVertexFace;
      } else if (facet.kind == SumFacetKind::kVertexFace) {
        facet.kind = SumFacetKind::kFaceVertex;
      }
      // The normal turns round with the sum, and so does the cross product with its factors.
    }
    std::sort(facets.begin(), facets.end());
    EXPECT_EQ(facets, ReducedConvolution(swapped, map_b, map_a).facets);
  }
}

// Every corner of every facet lies on or below the facet's plane locally: the normal named is
// outward.
TEST(Convolution, CornersRunCounterclockwiseFromOutside) {
  testing::Random random(6);
  const TriangleMesh a = MustBuild(NamedShape("box", 0)), b = MustBuild(Cone(7, 1, 2));
  const GaussMap map_a(a), map_b(b);
  for (int i = 0; i < 20; ++i) {
    const MeshPair pair(a, b, PoseOf(random.Rotation()));
    for (const SumFacet& facet : ReducedConvolution(pair, map_a, map_b).facets) {
      const SumCorners corners = CornersOf(pair, facet);
      const auto at = [&](const SumVertex& x) {
        return Vector3d(pair.a().points[x.a] - pair.b().points[x.b]);
      };
      const Vector3d o = at(corners.vertices[0]);
      const Vector3d n = (at(corners.vertices[1]) - o).cross(at(corners.vertices[2]) - o);
      // Both bodies are convex, so all of M lies below.
      for (int v = 0; v < a.vertex_count(); ++v) {
        for (int w = 0; w < b.vertex_count(); ++w) {
          ASSERT_LT(n.normalized().dot(at({v, w}) - o), 1e-12);
        }
      }
    }
  }
}

}  // namespace
}  // namespace touchstone
