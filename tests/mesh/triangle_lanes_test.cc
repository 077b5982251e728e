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

const BoxNode& LeafOf(const PlacedMesh& body, testing::Random* random) {
  const auto nodes = body.tree.nodes();
  while (true) {
    const BoxNode& node = nodes[random->Int(0, static_cast<int>(nodes.size()) - 1)];
    if (node.leaf >= 0) return node;
  }
}

struct Counts {
  int by_slab_or_box = 0, by_direction = 0, apart = 0, met = 0;
};

// What is parted shares no point, exactly; and little that triage knows apart is not parted.
void ExpectParted(const MeshPair& pair, const Translation& x, testing::Random* random,
                  Counts* counts) {
  const PlacedMesh &a = pair.a(), &b = pair.b();
  const Offset offset = MakeOffset(pair, x);
  const BoxNode& leaf_a = LeafOf(a, random);
  const BoxNode& leaf_b = LeafOf(b, random);
  const FaceLanes &lanes_a = a.leaves[leaf_a.leaf], &lanes_b = b.leaves[leaf_b.leaf];
  const std::uint64_t meeting = MeetingFacesInEights(a, leaf_a, b, leaf_b, offset);
  EXPECT_EQ(MeetingFacesInFours(a, leaf_a, b, leaf_b, offset), meeting);
  std::uint64_t left = meeting, kept = 0;
  while (left != 0) {
    const std::uint64_t first = left & -left;
    for (int round = 0; round < kPartingRounds && (left & first) != 0; ++round) {
      left = PartFirst(lanes_a, lanes_b, offset, left, round);
    }
    kept |= left & first;
    left &= ~first;
  }
  ExactContact contact(pair, x);
  for (int bit = 0; bit < 64; ++bit) {
    const int i = bit % kTreeWidth, j = bit / kTreeWidth;
    const bool meets = (meeting >> bit & 1) != 0, is_parted = (kept >> bit & 1) == 0;
    if (i >= leaf_a.lane_count || j >= leaf_b.lane_count) {
      EXPECT_FALSE(meets);
      continue;
    }
    const int face_a = ~leaf_a.children[i], face_b = ~leaf_b.children[j];
    Crossing crossing;
    const Triage triage = TriageTriangles(pair, face_a, face_b, offset, &crossing);
    counts->by_slab_or_box += !meets;
    counts->by_direction += meets && is_parted;
    counts->apart += meets && triage == Triage::kApart;
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
    for (int k = 0; k < 4; ++k) ExpectParted(pair, x, &random, &counts);
  }
  EXPECT_GT(counts.met, 100);
  EXPECT_GT(counts.by_slab_or_box, 5000);
  EXPECT_GT(counts.by_direction, 5000);
  EXPECT_GT(counts.by_direction, 0.9 * counts.apart);
}

}  // namespace
}  // namespace touchstone::internal
