// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "touchstone/core/mesh/triangle_lanes_internal.h"
#include "touchstone/tests/testing/random.h"
#include "touchstone/tools/shapes/shapes.h"

namespace touchstone::internal {
namespace {

using Eigen::Vector3d;

TriangleMesh Scaled(Shape shape, double factor) {
  for (Vector3d& vertex : shape.vertices) vertex *= factor;
  return MustBuild(shape);
}

// A node of eight faces of a mesh, or of fewer and some inner nodes.
BoxNode NodeOf(const TriangleMesh& mesh, testing::Random* random) {
  BoxNode node;
  node.lane_count = kTreeWidth;
  for (int lane = 0; lane < kTreeWidth; ++lane) {
    node.children[lane] = random->Int(0, 9) == 0 ? 3 : ~random->Int(0, mesh.face_count() - 1);
  }
  return node;
}

struct Counts {
  int parted = 0, apart = 0, met = 0;
};

// What is parted shares no point, exactly; and little that triage knows apart is not parted.
void ExpectParted(const MeshPair& pair, bool lanes_of_b, const Translation& x,
                  testing::Random* random, Counts* counts) {
  const PlacedMesh& one = lanes_of_b ? pair.a() : pair.b();
  const PlacedMesh& many = lanes_of_b ? pair.b() : pair.a();
  const Offset offset = MakeOffset(pair, x);
  const BoxNode node = NodeOf(many.mesh, random);
  TriangleLanes lanes;
  lanes.Gather(many, node, offset);
  const int face = random->Int(0, one.mesh.face_count() - 1);
  const Vector3d move = lanes_of_b ? offset.value : Vector3d(-offset.value);
  const unsigned doubtful = LanesNotParted(one, face, lanes, move, offset);
  ExactContact contact(pair, x);
  for (int lane = 0; lane < kTreeWidth; ++lane) {
    const bool is_parted = (doubtful >> lane & 1) == 0;
    if (node.children[lane] >= 0) {
      EXPECT_FALSE(is_parted);
      continue;
    }
    const int other = ~node.children[lane];
    const int face_a = lanes_of_b ? face : other, face_b = lanes_of_b ? other : face;
    Crossing crossing;
    const Triage triage = TriageTriangles(pair, face_a, face_b, offset, &crossing);
    counts->parted += is_parted;
    counts->apart += triage == Triage::kApart;
    counts->met += triage == Triage::kCross;
    if (is_parted) {
      EXPECT_NE(triage, Triage::kCross);
      EXPECT_EQ(contact.Meet(face_a, face_b), Verdict::kSeparate) << face_a << " " << face_b;
    }
  }
}

// Vertices on vertices, aligned and turned, down to an ulp from contact; slivers, huge and tiny
// bodies.
TEST(TriangleLanes, PartsOnlyWhatSharesNoPoint) {
  testing::Random random(17);
  Counts counts;
  const char* const names[] = {"box", "cone", "star", "torus", "spoon", "axes"};
  for (int i = 0; i < 1500; ++i) {
    const double size = i % 5 == 0 ? 1e-60 : i % 5 == 1 ? 1e60 : 1.0;
    const TriangleMesh a = Scaled(NamedShape(names[random.Int(0, 5)], 60), size),
                       b = Scaled(NamedShape(names[random.Int(0, 5)], 40), size);
    const Eigen::Matrix3d turn =
        i % 3 == 0 ? Eigen::Matrix3d(Eigen::Matrix3d::Identity()) : random.Rotation();
    const MeshPair pair(a, b, *RelativePose::Make(turn, Vector3d::Zero()));
    const Vector3d touch = a.vertex(random.Int(0, a.vertex_count() - 1)) -
                           turn * b.vertex(random.Int(0, b.vertex_count() - 1));
    const double off = std::pow(10.0, -random.Int(0, 17)) * size;
    const Vector3d x = i % 4 == 0 ? touch : Vector3d(touch + off * random.Direction());
    ExpectParted(pair, i % 2 == 0, x, &random, &counts);
  }
  EXPECT_GT(counts.met, 100);
  EXPECT_GT(counts.apart, 5000);
  EXPECT_GT(counts.parted, 0.9 * counts.apart);
}

}  // namespace
}  // namespace touchstone::internal
