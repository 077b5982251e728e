// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/dynamic_convolution.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdio>
#include <iterator>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "touchstone/tests/testing/poses.h"
#include "touchstone/tests/testing/random.h"
#include "touchstone/tools/shapes/shapes.h"

namespace touchstone {
namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using touchstone::testing::PoseOf;

Matrix3d Turn(double angle, const Vector3d& axis) {
  return AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

// A pair, its convolution kept up to date, and what it was at the last pose.
class Kept {
 public:
  Kept(const Shape& a, const Shape& b)
      : a_(MustBuild(a)),
        b_(MustBuild(b)),
        mapped_a_(a_),
        mapped_b_(b_),
        pair_(a_, b_, RelativePose()),
        dynamic_(mapped_a_, mapped_b_) {}

  void Go(const RelativePose& pose) {
    pair_.Place(pose);
    const SumChanges changes = dynamic_.Update(pair_);
    const std::vector<SumFacet> expected =
        ReducedConvolution(pair_, mapped_a_.gauss_map, mapped_b_.gauss_map).facets;
    ASSERT_EQ(dynamic_.Facets(), expected);
    // What was there, less what was dropped, and what was added.
    std::vector<SumFacet> left, all;
    std::set_difference(last_.begin(), last_.end(), changes.dropped.begin(), changes.dropped.end(),
                        std::back_inserter(left));
    ASSERT_EQ(left.size() + changes.dropped.size(), last_.size());
    std::set_union(left.begin(), left.end(), changes.added.begin(), changes.added.end(),
                   std::back_inserter(all));
    ASSERT_EQ(left.size() + changes.added.size(), all.size());
    ASSERT_EQ(all, expected);
    last_ = expected;
  }

  const std::vector<SumFacet>& facets() const { return last_; }
  DynamicConvolution& dynamic() { return dynamic_; }
  MeshPair& pair() { return pair_; }
  const TriangleMesh& a() const { return a_; }
  const TriangleMesh& b() const { return b_; }

 private:
  TriangleMesh a_, b_;
  MappedMesh mapped_a_, mapped_b_;
  MeshPair pair_;
  DynamicConvolution dynamic_;
  std::vector<SumFacet> last_;
};

std::vector<std::pair<std::string, std::string>> Pairs() {
  return {{"box", "box"},     {"l", "u"},         {"slot", "key"},   {"cone", "axes"},
          {"star", "star"},   {"torus", "torus"}, {"spoon", "cup"},  {"dimpled", "spiked"},
          {"hollow", "tori"}, {"fish", "torus"},  {"pocket", "axes"}};
}

TEST(DynamicConvolution, EqualsARebuildAlongRandomWalks) {
  testing::Random random(51);
  for (const auto& [name_a, name_b] : Pairs()) {
    SCOPED_TRACE(name_a + ' ' + name_b);
    Kept kept(NamedShape(name_a, 60), NamedShape(name_b, 60));
    Matrix3d rotation = random.Rotation();
    for (const double angle : {0.0, 1e-15, 1e-9, 1e-6, 1e-4, 1e-3, 0.02, 0.02, 0.1, 1.0, 3.0}) {
      for (int i = 0; i < 3; ++i) {
        rotation = Turn(angle, random.Direction()) * rotation;
        ASSERT_NO_FATAL_FAILURE(kept.Go(PoseOf(rotation))) << angle;
      }
    }
    EXPECT_GT(kept.facets().size(), 20u);
  }
}

// Through poses in which faces and edges are parallel, exactly and nearly, back and forth.
TEST(DynamicConvolution, EqualsARebuildWhereFeaturesAlign) {
  testing::Random random(52);
  Matrix3d quarter;
  quarter << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  for (const auto& [name_a, name_b] : Pairs()) {
    SCOPED_TRACE(name_a + ' ' + name_b);
    Kept kept(NamedShape(name_a, 40), NamedShape(name_b, 40));
    const Matrix3d identity = Matrix3d::Identity();
    const Vector3d axis = random.Direction();
    for (const Matrix3d& rotation :
         {identity, Turn(1e-16, axis), Turn(1e-15, axis), identity, Turn(1e-12, axis),
          Turn(-1e-6, axis), identity, quarter, Matrix3d(quarter * Turn(1e-14, axis)),
          Turn(std::numbers::pi / 4, Vector3d::UnitZ()), Matrix3d(quarter * quarter), identity}) {
      ASSERT_NO_FATAL_FAILURE(kept.Go(PoseOf(rotation)));
    }
  }
}

// A turn and a half about one axis in steps of a degree: more travel than is counted in one go.
TEST(DynamicConvolution, EqualsARebuildOverLongTravel) {
  testing::Random random(53);
  Kept kept(NamedShape("star", 0), NamedShape("axes", 0));
  const Vector3d axis = random.Direction();
  for (int degree = 0; degree < 540; ++degree) {
    ASSERT_NO_FATAL_FAILURE(kept.Go(PoseOf(Turn(degree * std::numbers::pi / 180, axis)))) << degree;
  }
}

TEST(DynamicConvolution, WorldPosesMeanBothImages) {
  testing::Random random(54);
  for (const auto& [name_a, name_b] : {std::pair("u", "key"), std::pair("star", "torus")}) {
    Kept kept(NamedShape(name_a, 40), NamedShape(name_b, 40));
    Matrix3d rotation = random.Rotation();
    for (int i = 0; i < 6; ++i) {
      // Turned alike, faces stay exactly parallel though no entry of the rotation is exact.
      rotation = Turn(1e-3, random.Direction()) * rotation;
      ASSERT_NO_FATAL_FAILURE(
          kept.Go(*RelativePose::FromWorld({rotation, {1, 2, 3}}, {rotation, {-1, 0, 2}})));
    }
  }
}

TEST(DynamicConvolution, RotationsOffOrthonormal) {
  testing::Random random(55);
  Kept kept(NamedShape("dimpled", 0), NamedShape("u", 0));
  for (int i = 0; i < 20; ++i) {
    Matrix3d rotation = random.Rotation();
    for (int k = 0; k < 9; ++k) rotation(k / 3, k % 3) += random.Uniform(-1e-7, 1e-7);
    ASSERT_NO_FATAL_FAILURE(kept.Go(PoseOf(rotation)));
  }
}

// Bodies of a few cubes, as they are, with corners moved by small integers or at random, flattened
// to needles, or tiny: special vertices, coplanar faces, parallel edges.
Shape RandomCubes(testing::Random& random) {
  std::vector<std::array<int, 3>> cubes;
  for (int i = random.Int(2, 7); i > 0; --i) {
    cubes.push_back({random.Int(0, 2), random.Int(0, 2), random.Int(0, 1)});
  }
  std::sort(cubes.begin(), cubes.end());
  cubes.erase(std::unique(cubes.begin(), cubes.end()), cubes.end());
  Shape shape = Cubes(cubes);
  const int change = random.Int(0, 4);
  for (Vector3d& x : shape.vertices) {
    if (change == 1)
      x = 4.0 * x + Vector3d(random.Int(-1, 1), random.Int(-1, 1), random.Int(-1, 1));
    if (change == 2) x += 0.1 * random.Direction();
    if (change == 3) x = {3.0 * x[0] + 1e-9 * random.Int(0, 2), x[1], 1e-5 * x[2]};
    if (change == 4) x *= 1e-90;
  }
  return shape;
}

TEST(DynamicConvolution, EqualsARebuildOfRandomCubes) {
  const int seed = 58;
  std::printf("seed %d\n", seed);
  testing::Random random(seed);
  int pairs = 0;
  std::size_t special = 0;
  while (pairs < 60) {
    const Shape a = RandomCubes(random), b = RandomCubes(random);
    // Cubes that touch in an edge or a corner alone are refused.
    const auto mesh_a = TriangleMesh::Build(a.vertices, a.faces);
    if (!mesh_a.ok() || !TriangleMesh::Build(b.vertices, b.faces).ok()) continue;
    ++pairs;
    special += MappedMesh(*mesh_a).special_vertices.size();
    Kept kept(a, b);
    Matrix3d rotation = Matrix3d::Identity();
    for (int i = 0; i < 10; ++i) {
      const double angles[] = {1e-15, 1e-3, std::numbers::pi / 4, std::numbers::pi / 2, 1.0};
      const Vector3d axis =
          random.Int(0, 2) == 0 ? random.Direction() : Vector3d(Vector3d::Unit(random.Int(0, 2)));
      if (random.Int(0, 5) == 0) rotation = Matrix3d::Identity();
      rotation = Turn(angles[random.Int(0, 4)], axis) * rotation;
      ASSERT_NO_FATAL_FAILURE(kept.Go(PoseOf(rotation))) << pairs << ' ' << i;
    }
  }
  EXPECT_GT(special, 10u);
}

// Looking at nothing where nothing can have changed, and at little where little can.
TEST(DynamicConvolution, LooksAtWhatCanHaveChanged) {
  testing::Random random(56);
  Kept kept(NamedShape("torus", 500), NamedShape("star", 0));
  const Matrix3d rotation = random.Rotation();
  ASSERT_NO_FATAL_FAILURE(kept.Go(PoseOf(rotation)));
  EXPECT_EQ(kept.dynamic().counts().looked_at, kept.dynamic().counts().features);
  ASSERT_NO_FATAL_FAILURE(kept.Go(PoseOf(rotation)));
  EXPECT_EQ(kept.dynamic().counts().looked_at, 0);
  ASSERT_NO_FATAL_FAILURE(kept.Go(PoseOf(Turn(1e-7, random.Direction()) * rotation)));
  EXPECT_LT(kept.dynamic().counts().looked_at, kept.dynamic().counts().features / 50);
  // Moving alone changes nothing.
  kept.pair().Place(*RelativePose::Make(kept.pair().pose().rotation(), {1, 2, 3}));
  const SumChanges& changes = kept.dynamic().Update(kept.pair());
  EXPECT_TRUE(changes.dropped.empty() && changes.added.empty());
  EXPECT_EQ(kept.dynamic().counts().looked_at, 0);
}

// Features asked for one by one, some of them, at some poses.
TEST(DynamicConvolution, FeaturesOnDemandAreThoseOfARebuild) {
  testing::Random random(57);
  for (const auto& [name_a, name_b] : {std::pair("star", "torus"), std::pair("axes", "spoon"),
                                       std::pair("u", "l"), std::pair("torus", "box")}) {
    SCOPED_TRACE(std::string(name_a) + ' ' + name_b);
    Kept kept(NamedShape(name_a, 60), NamedShape(name_b, 60));
    DynamicConvolution& dynamic = kept.dynamic();
    Matrix3d rotation = Matrix3d::Identity();
    for (int i = 0; i < 12; ++i) {
      if (i % 4 == 3) {
        ASSERT_NO_FATAL_FAILURE(kept.Go(PoseOf(rotation)));
      }
      rotation = Turn(0.03, random.Direction()) * rotation;
      kept.pair().Place(PoseOf(rotation));
      dynamic.Place(kept.pair());
      const GaussMap map_a(kept.a()), map_b(kept.b());
      const Convolution all = ReducedConvolution(kept.pair(), map_a, map_b);
      std::vector<std::vector<int>> on_a(kept.a().face_count()), on_b(kept.b().face_count());
      std::vector<std::vector<SumFacet>> of_edge(
          (dynamic.traces_a() ? kept.a() : kept.b()).edge_count());
      for (const SumFacet& facet : all.facets) {
        if (facet.kind == SumFacetKind::kFaceVertex) on_a[facet.a].push_back(facet.b);
        if (facet.kind == SumFacetKind::kVertexFace) on_b[facet.b].push_back(facet.a);
        if (facet.kind == SumFacetKind::kEdgeEdge) {
          of_edge[dynamic.traces_a() ? facet.a : facet.b].push_back(facet);
        }
      }
      for (int k = 0; k < 20; ++k) {
        const int f = random.Int(0, kept.a().face_count() - 1);
        const int g = random.Int(0, kept.b().face_count() - 1);
        const int e = random.Int(0, static_cast<int>(of_edge.size()) - 1);
        const auto vertices_a = dynamic.VerticesOnFaceOfA(f);
        ASSERT_EQ(std::vector<int>(vertices_a.begin(), vertices_a.end()), on_a[f]);
        const auto vertices_b = dynamic.VerticesOnFaceOfB(g);
        ASSERT_EQ(std::vector<int>(vertices_b.begin(), vertices_b.end()), on_b[g]);
        const auto facets = dynamic.FacetsOfEdge(e);
        ASSERT_EQ(std::vector<SumFacet>(facets.begin(), facets.end()), of_edge[e]);
      }
    }
  }
}

}  // namespace
}  // namespace touchstone
