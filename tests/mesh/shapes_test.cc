// SPDX-License-Identifier: MIT
#include "touchstone/tools/shapes/shapes.h"

#include <gtest/gtest.h>

#include <string>

#include "touchstone/core/mesh/membership.h"
#include "touchstone/tools/shapes/paper_scenes.h"

namespace touchstone {
namespace {

TEST(Shapes, AllAreClosedMeshesOfTheSizeAskedFor) {
  for (const std::string& name : ShapeNames()) {
    for (const int count : {0, 100, 333, 2000}) {
      SCOPED_TRACE(name + ' ' + std::to_string(count));
      const Shape shape = NamedShape(name, count);
      const auto mesh = TriangleMesh::Build(shape.vertices, shape.faces);
      ASSERT_TRUE(mesh.ok()) << mesh.status().ToString();
      EXPECT_TRUE(mesh->FindValidationError().ok());
      if (count < 200) continue;
      EXPECT_GE(mesh->face_count(), count - 1);
      EXPECT_LE(mesh->face_count(), count + 100);
    }
  }
  EXPECT_TRUE(NamedShape("no such shape", 10).faces.empty());
}

TEST(Shapes, HaveTheTopologyOfWhatTheyAre) {
  const auto genus = [](const std::string& name) {
    return MustBuild(NamedShape(name, 0)).components()[0].genus();
  };
  for (const std::string& name : ShapeNames()) {
    SCOPED_TRACE(name);
    EXPECT_EQ(genus(name), name == "torus" || name == "tori" ? 1 : 0);
  }
  EXPECT_EQ(MustBuild(NamedShape("tori", 0)).components().size(), 2u);
  EXPECT_EQ(MustBuild(HollowBox()).components()[1].depth, 1);
}

TEST(PaperScenes, OverlapAllTheWayInABallOfThePapersSize) {
  const std::array<std::array<int, 2>, 4> sizes = {
      {{1000, 36}, {1300, 1008}, {950, 1600}, {2000, 2000}}};
  ASSERT_EQ(AllPaperScenes().size(), 4u);
  for (int i = 0; i < 4; ++i) {
    const PaperScene& scene = AllPaperScenes()[i];
    SCOPED_TRACE(scene.name);
    EXPECT_EQ(FindPaperScene(scene.name), &scene);
    const TriangleMesh a = MustBuild(scene.a), b = MustBuild(scene.b);
    EXPECT_EQ(a.face_count(), sizes[i][0]);
    EXPECT_EQ(b.face_count(), sizes[i][1]);
    EXPECT_LT(a.max_coordinate() + b.max_coordinate(), 2.0 * kPaperSumRadius);
    for (int frame = 0; frame <= kPaperFrames; frame += 5) {
      const MeshPair pair(a, b, scene.PoseAt(static_cast<double>(frame) / kPaperFrames));
      EXPECT_EQ(Membership(pair, Eigen::Vector3d::Zero().eval()).verdict, Verdict::kOverlap)
          << frame;
    }
  }
  EXPECT_EQ(FindPaperScene("no such scene"), nullptr);
}

TEST(Shapes, RefiningKeepsTheBody) {
  const Shape coarse = UShape(), fine = Refined(coarse, 501);
  const TriangleMesh mesh = MustBuild(fine);
  EXPECT_EQ(mesh.face_count(), 502);
  EXPECT_EQ(mesh.components()[0].euler_characteristic(), 2);
  // Every midpoint of these is exact, so every new edge between coplanar faces is flat.
  int bends = 0;
  for (int e = 0; e < mesh.edge_count(); ++e) bends += mesh.edge_kind(e) != EdgeKind::kFlat;
  double length = 0.0;
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const int h = mesh.half_edge_of(e);
    if (mesh.edge_kind(e) != EdgeKind::kFlat) {
      length += (mesh.vertex(mesh.head(h)) - mesh.vertex(mesh.tail(h))).norm();
    }
  }
  EXPECT_GT(bends, 24);
  // Edges along y: eight of length 1. Two profiles of length 3 + 3 + 1 + 2 + 1 + 2 + 1 + 3.
  EXPECT_DOUBLE_EQ(length, 8 * 1 + 2 * 16);
}

}  // namespace
}  // namespace touchstone
