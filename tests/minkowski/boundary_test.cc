// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/boundary.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "touchstone/core/mesh/membership.h"
#include "touchstone/tests/testing/poses.h"
#include "touchstone/tests/testing/random.h"
#include "touchstone/tools/shapes/shapes.h"

namespace touchstone {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using touchstone::testing::PoseOf;

struct Sum {
  MeshPair pair;
  SumBoundary boundary;
};

Sum SumOf(const Shape& a, const Shape& b, const RelativePose& pose = {}) {
  const TriangleMesh mesh_a = MustBuild(a), mesh_b = MustBuild(b);
  MeshPair pair(mesh_a, mesh_b, pose);
  SumBoundary boundary = BuildSumBoundary(pair, GaussMap(mesh_a), GaussMap(mesh_b));
  return {std::move(pair), std::move(boundary)};
}

double Volume(const SumBoundary& sum) {
  double volume = 0.0;
  for (const auto& [a, b, c] : sum.triangles) {
    volume += sum.vertices[a].dot(sum.vertices[b].cross(sum.vertices[c])) / 6.0;
  }
  return volume;
}

// How often the surface winds round x: its solid angles over 4 pi (van Oosterom, Strackee 1983).
double WindingNumber(const SumBoundary& sum, const Vector3d& x) {
  double angle = 0.0;
  for (const auto& [a, b, c] : sum.triangles) {
    const Vector3d u = sum.vertices[a] - x, v = sum.vertices[b] - x, w = sum.vertices[c] - x;
    const double lu = u.norm(), lv = v.norm(), lw = w.norm();
    angle += 2.0 * std::atan2(u.dot(v.cross(w)),
                              lu * lv * lw + u.dot(v) * lw + v.dot(w) * lu + w.dot(u) * lv);
  }
  return angle / (4.0 * std::numbers::pi);
}

// What each component is counted to have, and which triangles it has, counted anew: triangles hang
// together over edges.
void ExpectCountsOfComponents(const SumBoundary& sum) {
  std::map<std::pair<int, int>, std::set<int>> components_of_edge;
  std::vector<std::set<int>> vertices(sum.components.size());
  std::vector<int> edges(sum.components.size(), 0), triangles(sum.components.size(), 0);
  for (std::size_t t = 0; t < sum.triangles.size(); ++t) {
    const int component = sum.component_of_triangle[t];
    ASSERT_LT(component, std::ssize(sum.components));
    ++triangles[component];
    for (int k = 0; k < 3; ++k) {
      const int u = sum.triangles[t][k], v = sum.triangles[t][(k + 1) % 3];
      vertices[component].insert(u);
      components_of_edge[std::minmax(u, v)].insert(component);
    }
  }
  for (const auto& [ends, components] : components_of_edge) {
    ASSERT_EQ(components.size(), 1u);
    ++edges[*components.begin()];
  }
  for (std::size_t c = 0; c < sum.components.size(); ++c) {
    EXPECT_EQ(sum.components[c].vertex_count, std::ssize(vertices[c]));
    EXPECT_EQ(sum.components[c].edge_count, edges[c]);
    EXPECT_EQ(sum.components[c].triangle_count, triangles[c]);
    EXPECT_EQ(sum.components[c].euler_characteristic(),
              std::ssize(vertices[c]) - edges[c] + triangles[c]);
  }
}

void ExpectClosed(const SumBoundary& sum) {
  ExpectCountsOfComponents(sum);
  EXPECT_EQ(sum.border_edges, 0);
  EXPECT_EQ(sum.detached_patches, 0);
  EXPECT_EQ(sum.triangles.size(), sum.facet_of_triangle.size());
  EXPECT_EQ(sum.triangles.size(), sum.component_of_triangle.size());
  EXPECT_EQ(sum.vertices.size(), sum.names.size());
}

// The surface separates what membership says it should, at random points.
void ExpectMembershipAgrees(const Sum& sum, int count, testing::Random& random) {
  Vector3d low = sum.boundary.vertices[0], high = low;
  for (const Vector3d& x : sum.boundary.vertices) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  const Vector3d margin = 0.05 * (high - low);
  int inside = 0;
  for (int i = 0; i < count; ++i) {
    Vector3d x;
    for (int k = 0; k < 3; ++k) x[k] = random.Uniform(low[k] - margin[k], high[k] + margin[k]);
    const double winding = WindingNumber(sum.boundary, x);
    ASSERT_NEAR(winding, std::round(winding), 1e-6);
    const Verdict verdict = Membership(sum.pair, x).verdict;
    ASSERT_EQ(std::lround(winding), verdict == Verdict::kOverlap ? 1 : 0) << x.transpose();
    inside += verdict == Verdict::kOverlap;
  }
  EXPECT_GT(inside, count / 20);
  EXPECT_LT(inside, count);
}

TEST(SumBoundary, BoxAndBox) {
  const Sum sum = SumOf(Box({0, 0, 0}, {1, 2, 3}), Box({0, 0, 0}, {2, 1, 1}));
  ExpectClosed(sum.boundary);
  EXPECT_NEAR(Volume(sum.boundary), 3.0 * 3.0 * 4.0, 1e-10);
  ASSERT_EQ(sum.boundary.components.size(), 1u);
  EXPECT_EQ(sum.boundary.components[0].euler_characteristic(), 2);
  EXPECT_TRUE(sum.boundary.sheets.empty());
  for (const Vector3d& x : sum.boundary.vertices) {
    EXPECT_TRUE(x[0] == -2 || x[0] == 1 || x[1] == -1 || x[1] == 2 || x[2] == -1 || x[2] == 3);
  }
}

TEST(SumBoundary, PinInAU) {
  // A pin thinner than the gap of the U leaves a gap, one as thick a sheet, a thicker one nothing.
  const Sum thin = SumOf(UShape(), Box({0, 0, 0}, {0.5, 1, 4}));
  ExpectClosed(thin.boundary);
  EXPECT_NEAR(Volume(thin.boundary), 3.5 * 2 * 7 - 0.5 * 2 * 2, 1e-10);
  EXPECT_TRUE(thin.boundary.sheets.empty());
  const Sum thick = SumOf(UShape(), Box({0, 0, 0}, {1.5, 1, 4}));
  ExpectClosed(thick.boundary);
  EXPECT_NEAR(Volume(thick.boundary), 4.5 * 2 * 7, 1e-10);
  EXPECT_TRUE(thick.boundary.sheets.empty());
  const Sum exact = SumOf(UShape(), Key());
  ExpectClosed(exact.boundary);
  EXPECT_NEAR(Volume(exact.boundary), 4.0 * 2 * 7, 1e-10);
  // The slot stays open: x = 1, from the floor z = 1 to the rims z = 3, all along y.
  double area = 0.0;
  for (const auto& [a, b, c] : exact.boundary.sheets) {
    const auto& at = exact.boundary.vertices;
    area += 0.5 * (at[b] - at[a]).cross(at[c] - at[a]).norm();
    for (const int v : {a, b, c}) EXPECT_NEAR(at[v][0], 1.0, exact.boundary.rounding);
  }
  EXPECT_NEAR(area, 2.0 * 2.0, 1e-12);
}

TEST(SumBoundary, KeyInAPocketLeavesASegment) {
  const Sum sum = SumOf(Pocket(), Key());
  ExpectClosed(sum.boundary);
  EXPECT_NEAR(Volume(sum.boundary), 6.0 * 6 * 7, 1e-10);
  EXPECT_TRUE(sum.boundary.sheets.empty());
  double length = 0.0;
  for (const auto& [a, b] : sum.boundary.segments) {
    const Vector3d &u = sum.boundary.vertices[a], &v = sum.boundary.vertices[b];
    EXPECT_LT((u.head<2>() - Eigen::Vector2d(2, 2)).norm(), 1e-12);
    EXPECT_LT((v.head<2>() - Eigen::Vector2d(2, 2)).norm(), 1e-12);
    length += (u - v).norm();
  }
  EXPECT_NEAR(length, 2.0, 1e-12);  // from the floor at 1 to the rim at 3
  EXPECT_TRUE(sum.boundary.points.empty());
}

TEST(SumBoundary, BodyThatFillsACavityLeavesAPoint) {
  const Sum sum = SumOf(HollowBox(), Box({0, 0, 0}, {2, 1.5, 1}));
  ExpectClosed(sum.boundary);
  EXPECT_NEAR(Volume(sum.boundary), 6.0 * 5.5 * 5, 1e-10);
  EXPECT_TRUE(sum.boundary.sheets.empty());
  EXPECT_TRUE(sum.boundary.segments.empty());
  ASSERT_EQ(sum.boundary.points.size(), 1u);
  EXPECT_LT((sum.boundary.vertices[sum.boundary.points[0]] - Vector3d(1, 1, 1)).norm(), 1e-12);
}

TEST(SumBoundary, SmallBodyLeavesACavity) {
  const Sum sum = SumOf(HollowBox(), Box({0, 0, 0}, {0.5, 0.5, 0.5}));
  ExpectClosed(sum.boundary);
  ASSERT_EQ(sum.boundary.components.size(), 2u);
  for (const SumComponent& component : sum.boundary.components) {
    EXPECT_EQ(component.euler_characteristic(), 2);
  }
  EXPECT_NEAR(Volume(sum.boundary), 4.5 * 4.5 * 4.5 - 1.5 * 1 * 0.5, 1e-10);
}

TEST(SumBoundary, TwoComponentsAndAHole) {
  const Shape two = Together(Box({0, 0, 0}, {1, 1, 1}), Box({5, 0, 0}, {6, 1, 1}));
  const Sum apart = SumOf(two, Box({0, 0, 0}, {1, 1, 1}));
  ExpectClosed(apart.boundary);
  EXPECT_EQ(apart.boundary.components.size(), 2u);
  EXPECT_NEAR(Volume(apart.boundary), 16.0, 1e-10);
  // A torus and a ball-like body that passes through its hole.
  const Sum ring = SumOf(Torus(12, 8, 3.0, 0.5), Moved(Cone(5, 1, 1), 0.5, Vector3d::Zero()));
  ExpectClosed(ring.boundary);
  ASSERT_EQ(ring.boundary.components.size(), 1u);
  EXPECT_EQ(ring.boundary.components[0].euler_characteristic(), 0);
}

TEST(SumBoundary, AgreesWithMembershipInGeneralPosition) {
  testing::Random random(31);
  for (const auto& [name_a, name_b] :
       {std::pair("star", "u"), std::pair("axes", "dimpled"), std::pair("torus", "torus"),
        std::pair("spoon", "cup"), std::pair("tori", "hollow"), std::pair("spiked", "fish"),
        std::pair("slot", "key"), std::pair("l", "star")}) {
    for (int i = 0; i < 3; ++i) {
      SCOPED_TRACE(std::string(name_a) + ' ' + name_b + ' ' + std::to_string(i));
      const Sum sum = SumOf(NamedShape(name_a, 100), NamedShape(name_b, 100),
                            PoseOf(random.Rotation(), random.Direction()));
      ExpectClosed(sum.boundary);
      ASSERT_NO_FATAL_FAILURE(ExpectMembershipAgrees(sum, 200, random));
    }
  }
}

// Faces and edges of the two bodies parallel, exactly and nearly.
TEST(SumBoundary, AgreesWithMembershipWhereFeaturesAlign) {
  testing::Random random(32);
  for (const auto& [name_a, name_b] :
       {std::pair("u", "u"), std::pair("slot", "l"), std::pair("axes", "axes"),
        std::pair("pocket", "axes"), std::pair("star", "star"), std::pair("dimpled", "spiked"),
        std::pair("cone", "cone"), std::pair("torus", "torus")}) {
    for (const double angle : {0.0, 1e-15, 1e-9, 1e-3, std::numbers::pi / 4}) {
      SCOPED_TRACE(std::string(name_a) + ' ' + name_b + ' ' + std::to_string(angle));
      const Matrix3d rotation = Eigen::AngleAxisd(angle, Vector3d::UnitZ()).toRotationMatrix();
      const Sum sum = SumOf(NamedShape(name_a, 0 == std::string(name_a).compare("torus") ? 64 : 40),
                            NamedShape(name_b, 40), PoseOf(rotation));
      ExpectClosed(sum.boundary);
      ASSERT_NO_FATAL_FAILURE(ExpectMembershipAgrees(sum, 100, random));
    }
  }
}

// That components do not meet is not checked of a mesh: what is built is the sum of their union.
TEST(SumBoundary, ComponentsThatCutEachOther) {
  testing::Random random(40);
  const Shape bars = Together(Box({-3.0, -0.5, -0.5}, {3.0, 0.5, 0.5}),
                              Moved(Box({-0.4, -3.0, -0.4}, {0.4, 3.0, 0.4}), 1.0, {0.3, 0.2, 0}));
  // Sharp corners reach into the creases.
  for (const Shape& other : {Cone(3, 0.2, 3.0), Cone(5, 1.0, 2.0), Box({0, 0, 0}, {1, 2, 3})}) {
    for (int i = 0; i < 8; ++i) {
      SCOPED_TRACE(i);
      const RelativePose pose = i == 0 ? RelativePose() : PoseOf(random.Rotation());
      const Sum sum = SumOf(bars, other, pose);
      ExpectClosed(sum.boundary);
      ASSERT_NO_FATAL_FAILURE(ExpectMembershipAgrees(sum, 200, random));
    }
  }
}

// Handles: a ring with a pin through it, two rings, a frame with two holes.
TEST(SumBoundary, EulerCharacteristics) {
  const auto characteristics = [](const Sum& sum) {
    ExpectClosed(sum.boundary);
    std::vector<int> all;
    for (const SumComponent& each : sum.boundary.components) {
      all.push_back(each.euler_characteristic());
    }
    std::sort(all.begin(), all.end());
    return all;
  };
  const Shape pin = Box({0, 0, 0}, {0.25, 0.25, 0.25});
  const Shape ring = Torus(12, 8, 3.0, 0.5);
  testing::Random random(39);
  const RelativePose turned = PoseOf(random.Rotation());
  EXPECT_EQ(characteristics(SumOf(ring, pin, turned)), (std::vector<int>{0}));
  EXPECT_EQ(characteristics(SumOf(Together(ring, Moved(ring, 1.0, {9, 0, 0})), pin, turned)),
            (std::vector<int>{0, 0}));
  std::vector<std::array<int, 3>> frame;
  for (int i = 0; i < 5; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (j != 1 || i % 2 == 0) frame.push_back({i, j, 0});
    }
  }
  EXPECT_EQ(characteristics(SumOf(Cubes(frame), pin)), (std::vector<int>{-2}));
  EXPECT_EQ(characteristics(SumOf(Cubes(frame), pin, turned)), (std::vector<int>{-2}));
  // The cavity of a hollow box, and a body that is too large for it.
  EXPECT_EQ(characteristics(SumOf(HollowBox(), pin, turned)), (std::vector<int>{2, 2}));
  EXPECT_EQ(characteristics(SumOf(HollowBox(), Box({0, 0, 0}, {3, 3, 3}), turned)),
            (std::vector<int>{2}));
}

// One body far inside what the other spans: M is nearly the larger one.
TEST(SumBoundary, StrictContainment) {
  testing::Random random(40);
  for (const double size : {0x1p-4, 0x1p-10, 0x1p-30}) {
    const Sum sum = SumOf(Torus(12, 8, 3.0, 0.5), Moved(Star(5), size, {0.5, 0.5, 0.5}),
                          PoseOf(random.Rotation()));
    ExpectClosed(sum.boundary);
    ASSERT_EQ(sum.boundary.components.size(), 1u);
    EXPECT_EQ(sum.boundary.components[0].euler_characteristic(), 0);
    // The speck within the solid, though no face is near.
    const Vector3d inside =
        Vector3d(3, 0, 0) - sum.pair.pose().rotation() * Vector3d(0.5, 0.5, 0.5);
    EXPECT_EQ(Membership(sum.pair, inside).verdict, Verdict::kOverlap);
    EXPECT_NEAR(WindingNumber(sum.boundary, inside), 1.0, 1e-6);
  }
}

TEST(SumBoundary, SwappingTheBodiesReflectsTheSum) {
  for (const auto& [name_a, name_b] : {std::pair("u", "l"), std::pair("star", "axes")}) {
    const Shape a = NamedShape(name_a, 0), b = NamedShape(name_b, 0);
    const Sum sum = SumOf(a, b), swapped = SumOf(b, a);
    EXPECT_NEAR(Volume(sum.boundary), Volume(swapped.boundary), 1e-10);
    std::vector<Vector3d> x = sum.boundary.vertices, y = swapped.boundary.vertices;
    for (Vector3d& v : y) v = -v;
    const auto less = [](const Vector3d& u, const Vector3d& v) {
      for (int i = 0; i < 3; ++i) {
        if (std::abs(u[i] - v[i]) > 1e-9) return u[i] < v[i];
      }
      return false;
    };
    std::sort(x.begin(), x.end(), less);
    std::sort(y.begin(), y.end(), less);
    ASSERT_EQ(x.size(), y.size());
    for (std::size_t i = 0; i < x.size(); ++i) EXPECT_LT((x[i] - y[i]).norm(), 1e-9);
  }
}

TEST(SumBoundary, ScalingByPowersOfTwoAndMovingChangeNothingElse) {
  testing::Random random(33);
  const Shape a = NamedShape("star", 0), b = NamedShape("u", 0);
  const Matrix3d rotation = random.Rotation();
  const Sum sum = SumOf(a, b, PoseOf(rotation));
  for (const double scale : {0x1p-320, 0x1p-3, 0x1p320}) {
    const Sum scaled = SumOf(Moved(a, scale, Vector3d::Zero()), Moved(b, scale, Vector3d::Zero()),
                             PoseOf(rotation));
    ASSERT_EQ(scaled.boundary.triangles, sum.boundary.triangles);
    for (std::size_t i = 0; i < sum.boundary.vertices.size(); ++i) {
      EXPECT_EQ(scaled.boundary.vertices[i], scale * sum.boundary.vertices[i]);
    }
  }
  const Vector3d shift(1, 2, -3);
  const Sum moved = SumOf(a, b, PoseOf(rotation, shift));
  ASSERT_EQ(moved.boundary.triangles.size(), sum.boundary.triangles.size());
  EXPECT_NEAR(Volume(moved.boundary), Volume(sum.boundary), 1e-10);
  for (std::size_t i = 0; i < sum.boundary.vertices.size(); ++i) {
    EXPECT_LT((moved.boundary.vertices[i] + shift - sum.boundary.vertices[i]).norm(), 1e-10);
  }
}

TEST(SumBoundary, KeyInASlotLeavesASheet) {
  const Sum sum = SumOf(Slot(), Key());
  ExpectClosed(sum.boundary);
  EXPECT_NEAR(Volume(sum.boundary), 6.0 * 4 * 7, 1e-10);
  double area = 0.0;
  for (const auto& [a, b, c] : sum.boundary.sheets) {
    const auto& at = sum.boundary.vertices;
    area += 0.5 * (at[b] - at[a]).cross(at[c] - at[a]).norm();
    for (const int v : {a, b, c}) EXPECT_NEAR(at[v][0], 2.0, sum.boundary.rounding);
  }
  EXPECT_NEAR(area, 4.0 * 2.0, 1e-12);  // all along the groove, from its floor to the rims
  EXPECT_EQ(Membership(sum.pair, Vector3d(2, 1, 2)).verdict, Verdict::kTouch);
}

// The apex of a dent supports nothing; a spike that fits the dent at its apex alone touches there.
TEST(SumBoundary, SpikeInADimple) {
  const Shape dent = Dimpled(6), spike = Spiked(6);
  const Matrix3d over = Vector3d(1, -1, -1).asDiagonal();  // upside down
  const Sum sum = SumOf(dent, spike, PoseOf(over));
  ExpectClosed(sum.boundary);
  ASSERT_EQ(sum.boundary.components.size(), 1u);
  EXPECT_EQ(sum.boundary.components[0].euler_characteristic(), 2);
  testing::Random random(36);
  ExpectMembershipAgrees(sum, 200, random);
  // No facet names the dent's apex, though the surface has a dent.
  int apex = -1;
  const TriangleMesh& a = sum.pair.a().mesh;
  for (int v = 0; v < a.vertex_count(); ++v) {
    if (a.vertex(v)[0] == 0 && a.vertex(v)[1] == 0) apex = v;
  }
  ASSERT_GE(apex, 0);
  for (const SumFacet& facet : sum.boundary.facets) {
    EXPECT_FALSE(facet.kind == SumFacetKind::kVertexFace && facet.a == apex);
  }
  // Apex on apex, the bodies touch: a vertex of the surface.
  int tip = -1;
  const TriangleMesh& b = sum.pair.b().mesh;
  for (int v = 0; v < b.vertex_count(); ++v) {
    if (tip < 0 || b.vertex(v)[2] > b.vertex(tip)[2]) tip = v;
  }
  const Vector3d contact = a.vertex(apex) - over * b.vertex(tip);
  EXPECT_EQ(Membership(sum.pair, contact).verdict, Verdict::kTouch);
  const auto named = std::find_if(
      sum.boundary.names.begin(), sum.boundary.names.end(), [&](const SumPointName& name) {
        return name.kind == SumPointKind::kVertex && name.vertices[0] == SumVertex{apex, tip};
      });
  EXPECT_NE(named, sum.boundary.names.end());
  EXPECT_LT(Volume(sum.boundary),
            Volume(SumOf(Box({-2, -2, -2}, {2, 2, 0}), spike, PoseOf(over)).boundary) - 1e-3);
}

// Both bodies turned by a rotation without rounding: the same sum, turned.
TEST(SumBoundary, TurningBothTurnsTheSum) {
  const Matrix3d turn = (Matrix3d() << 0, -1, 0, 0, 0, -1, 1, 0, 0).finished();
  const auto turned = [&](Shape shape) {
    for (Vector3d& x : shape.vertices) x = turn * x;
    return shape;
  };
  testing::Random random(37);
  const Matrix3d rotation = random.Rotation();
  for (const auto& [name_a, name_b] : {std::pair("u", "key"), std::pair("star", "axes")}) {
    const Shape a = NamedShape(name_a, 0), b = NamedShape(name_b, 0);
    const Sum sum = SumOf(a, b, PoseOf(rotation));
    const Sum other = SumOf(turned(a), turned(b), PoseOf(turn * rotation * turn.transpose()));
    EXPECT_EQ(other.boundary.facets, sum.boundary.facets);
    EXPECT_EQ(other.boundary.triangles.size(), sum.boundary.triangles.size());
    EXPECT_EQ(other.boundary.cells, sum.boundary.cells);
    EXPECT_NEAR(Volume(other.boundary), Volume(sum.boundary), 1e-10);
  }
}

// Coordinates with all their bits, and rounded to a grid, where features align and coincide.
TEST(SumBoundary, SnappedAndUnsnappedInputs) {
  testing::Random random(38);
  const auto snapped = [](Shape shape, double grid) {
    for (Vector3d& x : shape.vertices) {
      for (int i = 0; i < 3; ++i) x[i] = grid * std::round(x[i] / grid);
    }
    return shape;
  };
  const Matrix3d turn = Eigen::AngleAxisd(0.6, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  Shape a = NamedShape("torus", 64), b = NamedShape("star", 0);
  for (Vector3d& x : b.vertices) x = turn * x;
  double before = 0.0;
  for (const double grid : {0x1p-40, 0x1p-10, 0x1p-4}) {
    const Sum sum = SumOf(snapped(a, grid), snapped(b, grid));
    ExpectClosed(sum.boundary);
    ExpectMembershipAgrees(sum, 100, random);
    const double volume = Volume(sum.boundary);
    if (before > 0.0) {
      EXPECT_NEAR(volume, before, 0.1 * before);
    }
    before = volume;
  }
}

TEST(SumBoundary, WorldPosesMeanBothImages) {
  testing::Random random(34);
  // Turned alike, faces stay exactly parallel though no entry of the rotation is exact.
  const Matrix3d rotation = random.Rotation();
  const auto pose = RelativePose::FromWorld({rotation, {1, 2, 3}}, {rotation, {1, 2, 3}});
  const Sum sum = SumOf(UShape(), Key(), *pose);
  ExpectClosed(sum.boundary);
  EXPECT_NEAR(Volume(sum.boundary), 4.0 * 2 * 7, 1e-9);
  EXPECT_FALSE(sum.boundary.sheets.empty());
}

TEST(SumBoundary, NamesDescribeTheVertices) {
  testing::Random random(35);
  const Sum sum = SumOf(NamedShape("star", 0), NamedShape("axes", 0), PoseOf(random.Rotation()));
  const auto at = [&](const SumVertex& x) {
    return Vector3d((sum.pair.a().points[x.a] - sum.pair.b().points[x.b]) / sum.pair.scale());
  };
  const auto height = [&](int facet, const Vector3d& x) {
    const SumCorners corners = CornersOf(sum.pair, sum.boundary.facets[facet]);
    const Vector3d o = at(corners.vertices[0]);
    return (at(corners.vertices[1]) - o).cross(at(corners.vertices[2]) - o).normalized().dot(x - o);
  };
  std::array<int, 4> kinds{};
  for (std::size_t i = 0; i < sum.boundary.names.size(); ++i) {
    const SumPointName& name = sum.boundary.names[i];
    const Vector3d& x = sum.boundary.vertices[i];
    ++kinds[static_cast<int>(name.kind)];
    if (name.kind == SumPointKind::kVertex) {
      EXPECT_LT((at(name.vertices[0]) - x).norm(), 1e-12);
    }
    if (name.kind == SumPointKind::kEdgeFacet) {
      const Vector3d u = at(name.vertices[0]), v = at(name.vertices[1]);
      EXPECT_LT((x - u).cross(v - u).norm(), 1e-9);
    }
    for (const int f : name.facets) {
      if (f >= 0) {
        EXPECT_LT(std::abs(height(f, x)), 1e-9);
      }
    }
  }
  EXPECT_GT(kinds[0], 10);
  EXPECT_GT(kinds[1], 10);
  EXPECT_GT(kinds[3], 0);
  for (std::size_t t = 0; t < sum.boundary.triangles.size(); ++t) {
    for (const int v : sum.boundary.triangles[t]) {
      EXPECT_LT(std::abs(height(sum.boundary.facet_of_triangle[t], sum.boundary.vertices[v])),
                1e-9);
    }
  }
}

}  // namespace
}  // namespace touchstone
