// SPDX-License-Identifier: GPL-3.0-or-later
//
// The judge of Minkowski boundaries can fail: each planted fault is found, and sound boundaries
// pass. And the oracles that it rests on agree with each other and with what is known by hand.
#include "touchstone/exact/judge_minkowski.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "touchstone/core/minkowski/boundary.h"
#include "touchstone/exact/sum_cells.h"
#include "touchstone/tests/testing/poses.h"
#include "touchstone/tests/testing/random.h"
#include "touchstone/tools/shapes/shapes.h"

namespace touchstone::exact {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using ::testing::Contains;
using ::testing::IsEmpty;
using touchstone::testing::PoseOf;

std::vector<std::string> Texts(const std::vector<SumFinding>& findings) {
  std::vector<std::string> texts;
  for (const SumFinding& finding : findings) {
    texts.push_back(std::string(ToString(finding.kind)) + ": " + finding.detail);
  }
  return texts;
}

std::vector<SumFindingKind> Kinds(const std::vector<SumFinding>& findings) {
  std::vector<SumFindingKind> kinds;
  for (const SumFinding& finding : findings) kinds.push_back(finding.kind);
  return kinds;
}

struct Judged {
  Judged(const Shape& shape_a, const Shape& shape_b, const RelativePose& at = {})
      : a(MustBuild(shape_a)), b(MustBuild(shape_b)), pose(at) {
    boundary = BuildSumBoundary(MeshPair(a, b, pose), GaussMap(a), GaussMap(b));
  }

  std::vector<SumFinding> Judge(const SumJudgeOptions& options) const {
    return JudgeMinkowski(a, b, pose, boundary, options);
  }

  const TriangleMesh a, b;
  const RelativePose pose;
  SumBoundary boundary;
};

constexpr SumJudgeOptions kSamples{.samples = 4, .lines = 3};
constexpr SumJudgeOptions kAllCells{.samples = 4, .lines = 2, .enumerate = true};
constexpr SumJudgeOptions kEverything{
    .samples = 4, .lines = 2, .enumerate = true, .construct = true};

Shape Cube(double side) { return Box({0, 0, 0}, {side, side, side}); }

TEST(JudgeMinkowski, SoundBoundariesPass) {
  EXPECT_THAT(
      Texts(Judged(Box({0, 0, 0}, {1, 2, 3}), Box({0, 0, 0}, {2, 1, 1})).Judge(kEverything)),
      IsEmpty());
  EXPECT_THAT(Texts(Judged(UShape(), Key()).Judge(kEverything)), IsEmpty());
  EXPECT_THAT(Texts(Judged(Pocket(), Key()).Judge(kEverything)), IsEmpty());
  EXPECT_THAT(Texts(Judged(HollowBox(), Box({0, 0, 0}, {2, 1.5, 1})).Judge(kEverything)),
              IsEmpty());
  EXPECT_THAT(Texts(Judged(HollowBox(), Cube(0.5)).Judge(kEverything)), IsEmpty());
}

double Volume(const SumBoundary& sum) {
  double volume = 0.0;
  for (const auto& [a, b, c] : sum.triangles) {
    volume += sum.vertices[a].dot(sum.vertices[b].cross(sum.vertices[c])) / 6.0;
  }
  return volume;
}

mpq_class ExactVolume(const TriangleMesh& a, const TriangleMesh& b, const RelativePose& pose) {
  const PlacedMeshPair pair(a, b, pose);
  const ExactSum sum(pair);
  return VolumeOf(sum, FindSumCells(sum, true));
}

// Volumes by hand; by the cells, in fractions, which know nothing of the surface; and of the
// surface.
TEST(JudgeMinkowski, VolumesAreTheExactOnes) {
  struct Sum {
    Shape a, b;
    mpq_class by_hand;
  };
  const std::vector<Sum> sums = {
      {Box({0, 0, 0}, {1, 2, 3}), Box({0, 0, 0}, {2, 1, 1}), 36},
      {UShape(), Box({0, 0, 0}, {0.5, 1, 4}), 47},  // 3.5 x 2 x 7 less 0.5 x 2 x 2
      {HollowBox(), Cube(0.5), mpq_class(723, 8)},  // 4.5 x 4.5 x 4.5 less 1.5 x 1 x 0.5
  };
  for (const Sum& sum : sums) {
    const TriangleMesh a = MustBuild(sum.a), b = MustBuild(sum.b);
    EXPECT_EQ(ExactVolume(a, b, {}), sum.by_hand);
    EXPECT_NEAR(Volume(Judged(sum.a, sum.b).boundary), sum.by_hand.get_d(), 1e-10);
  }
}

// In general position; and with the bodies swapped, exactly the same. Here a vertex touches a face
// in the middle of the piece that membership looks at: rays from there had no end.
TEST(JudgeMinkowski, VolumesInGeneralPosition) {
  Shape slanted;
  slanted.vertices = {{0, 0, 0}, {0.75, 0.25, 0}, {0.25, 1, 0.25}, {0.25, 0.5, 1.25}};
  slanted.faces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  for (const Shape& shape : {Cube(1), LShape()}) {
    const Judged judged(shape, slanted), swapped(slanted, shape);
    const mpq_class exact = ExactVolume(judged.a, judged.b, judged.pose);
    EXPECT_EQ(ExactVolume(swapped.a, swapped.b, swapped.pose), exact);
    // Coordinates of at most ten, each within 1e-14, on a surface below a thousand.
    EXPECT_NEAR(Volume(judged.boundary), exact.get_d(), 1e-10);
    EXPECT_NEAR(Volume(swapped.boundary), exact.get_d(), 1e-10);
  }
}

// What is planted, and what must be said of it. The judge gets no more than it needs.
class PlantedFault : public ::testing::Test {
 protected:
  PlantedFault() : judged_(UShape(), Key()), boundary_(judged_.boundary) {}

  void ExpectFound(SumFindingKind kind, const SumJudgeOptions& options = kSamples) {
    const std::vector<SumFinding> findings = judged_.Judge(options);
    EXPECT_THAT(Kinds(findings), Contains(kind)) << ::testing::PrintToString(Texts(findings));
  }

  // Leaves all else consistent.
  void Erase(std::size_t t) {
    const auto at = static_cast<std::ptrdiff_t>(t);
    --boundary_.components[boundary_.component_of_triangle[t]].triangle_count;
    boundary_.triangles.erase(boundary_.triangles.begin() + at);
    boundary_.facet_of_triangle.erase(boundary_.facet_of_triangle.begin() + at);
    boundary_.component_of_triangle.erase(boundary_.component_of_triangle.begin() + at);
  }

  Judged judged_;
  SumBoundary& boundary_;
};

TEST_F(PlantedFault, DroppedTriangle) {
  Erase(3);
  ExpectFound(SumFindingKind::kNotClosed);
}

TEST_F(PlantedFault, FlippedTriangle) {
  std::swap(boundary_.triangles[5][0], boundary_.triangles[5][1]);
  ExpectFound(SumFindingKind::kNotClosed);
  ExpectFound(SumFindingKind::kNotAContact);
}

TEST_F(PlantedFault, SurfaceInsideOut) {
  for (auto& t : boundary_.triangles) std::swap(t[0], t[1]);
  ExpectFound(SumFindingKind::kNotAContact);
}

TEST_F(PlantedFault, ShiftedVertex) {
  boundary_.vertices[2][1] += 1e-9;
  ExpectFound(SumFindingKind::kWrongPoint);
}

TEST_F(PlantedFault, ClaimTooWide) {
  boundary_.vertices[2][1] += 1e-9;
  boundary_.rounding = 2e-9;
  ExpectFound(SumFindingKind::kLooseBound);
}

TEST_F(PlantedFault, NotANumber) {
  boundary_.vertices[2][1] = std::nan("");
  ExpectFound(SumFindingKind::kWrongPoint);
  boundary_.rounding = std::nan("");
  ExpectFound(SumFindingKind::kLooseBound);
}

TEST_F(PlantedFault, WrongName) {
  const auto found =
      std::find_if(boundary_.names.begin(), boundary_.names.end(),
                   [](const SumPointName& each) { return each.kind == SumPointKind::kVertex; });
  ASSERT_NE(found, boundary_.names.end());
  SumPointName& name = *found;
  name.vertices[0].a = (name.vertices[0].a + 1) % judged_.a.vertex_count();
  ExpectFound(SumFindingKind::kWrongPoint);
  name.vertices[0].a = judged_.a.vertex_count();
  ExpectFound(SumFindingKind::kBadName);
}

TEST_F(PlantedFault, IndexOutOfRange) {
  boundary_.triangles[0][1] = static_cast<int>(boundary_.vertices.size());
  ExpectFound(SumFindingKind::kBadName);
}

TEST_F(PlantedFault, TriangleOfAnotherFacet) {
  // A facet of another plane.
  const int facet = boundary_.facet_of_triangle[0];
  for (const int other : boundary_.facet_of_triangle) {
    if (boundary_.facets[other].kind != boundary_.facets[facet].kind) {
      boundary_.facet_of_triangle[0] = other;
    }
  }
  ASSERT_NE(boundary_.facet_of_triangle[0], facet);
  ExpectFound(SumFindingKind::kNotAContact);
}

TEST_F(PlantedFault, PointTwice) {
  const int v = boundary_.triangles[0][0];
  boundary_.vertices.push_back(boundary_.vertices[v]);
  boundary_.names.push_back(boundary_.names[v]);
  ExpectFound(SumFindingKind::kWrongPoint);
}

TEST_F(PlantedFault, WrongCounts) {
  ++boundary_.components[0].edge_count;
  ExpectFound(SumFindingKind::kWrongCounts);
  --boundary_.components[0].edge_count;
  boundary_.components.push_back({});
  ExpectFound(SumFindingKind::kWrongCounts);
}

TEST_F(PlantedFault, SwallowedSlot) {
  boundary_.sheets.clear();
  boundary_.facet_of_sheet.clear();
  ExpectFound(SumFindingKind::kNotAsByNef, {.samples = 0, .lines = 0, .construct = true});
}

TEST_F(PlantedFault, PartOfASlotSwallowed) {
  ASSERT_GT(boundary_.sheets.size(), 1u);
  boundary_.sheets.pop_back();
  boundary_.facet_of_sheet.pop_back();
  ExpectFound(SumFindingKind::kMissing, kAllCells);
}

TEST_F(PlantedFault, PieceOfTheSurfaceToldAsASheet) {
  boundary_.sheets.push_back(boundary_.triangles[0]);
  boundary_.facet_of_sheet.push_back(boundary_.facet_of_triangle[0]);
  ExpectFound(SumFindingKind::kWrongSide, {.samples = 100, .lines = 0});
}

TEST_F(PlantedFault, SegmentAndPointThatAreNone) {
  const auto& t = boundary_.triangles[0];
  boundary_.segments.push_back({t[0], t[1]});
  ExpectFound(SumFindingKind::kWrongSide);
  boundary_.segments.clear();
  boundary_.points.push_back(t[0]);
  ExpectFound(SumFindingKind::kWrongSide);
}

// A body in the cavity fills it as far as B goes. The cavity's walls are contacts still, closed and
// with names that hold, but they lie within M°.
TEST(JudgeMinkowskiFault, InnerPatchKept) {
  const Judged empty(HollowBox(), Cube(0.5));
  Judged filled(Together(HollowBox(), Box({1.2, 1.2, 1.2}, {2.8, 2.3, 1.8})), Cube(0.5));
  EXPECT_THAT(Texts(filled.Judge(kSamples)), IsEmpty());
  const SumBoundary& from = empty.boundary;
  SumBoundary& to = filled.boundary;
  ASSERT_EQ(from.components.size(), 2u);
  ASSERT_EQ(to.components.size(), 1u);
  const int facets = static_cast<int>(to.facets.size());
  to.facets.insert(to.facets.end(), from.facets.begin(), from.facets.end());
  to.components.push_back(from.components[1]);
  std::map<int, int> numbers;
  for (std::size_t t = 0; t < from.triangles.size(); ++t) {
    if (from.component_of_triangle[t] != 1) continue;
    std::array<int, 3> triangle = from.triangles[t];
    for (int& v : triangle) {
      const auto [place, added] = numbers.try_emplace(v, static_cast<int>(to.vertices.size()));
      if (added) {
        to.vertices.push_back(from.vertices[v]);
        to.names.push_back(from.names[v]);
        for (int& f : to.names.back().facets) f += f >= 0 ? facets : 0;
      }
      v = place->second;
    }
    to.triangles.push_back(triangle);
    to.facet_of_triangle.push_back(from.facet_of_triangle[t] + facets);
    to.component_of_triangle.push_back(1);
  }
  // Only membership can tell.
  const std::vector<SumFinding> findings = filled.Judge(kSamples);
  EXPECT_THAT(Kinds(findings), ::testing::Each(::testing::AnyOf(SumFindingKind::kWrongSide,
                                                                SumFindingKind::kMissing)));
  EXPECT_THAT(Kinds(findings), Contains(SumFindingKind::kWrongSide));
}

TEST(JudgeMinkowskiFault, MissingCavity) {
  Judged judged(HollowBox(), Cube(0.5));
  SumBoundary& boundary = judged.boundary;
  ASSERT_EQ(boundary.components.size(), 2u);
  SumBoundary without = boundary;
  without.triangles.clear();
  without.facet_of_triangle.clear();
  without.component_of_triangle.clear();
  for (std::size_t t = 0; t < boundary.triangles.size(); ++t) {
    if (boundary.component_of_triangle[t] != 0) continue;
    without.triangles.push_back(boundary.triangles[t]);
    without.facet_of_triangle.push_back(boundary.facet_of_triangle[t]);
    without.component_of_triangle.push_back(0);
  }
  without.components.resize(1);
  boundary = without;
  EXPECT_THAT(Kinds(judged.Judge({.samples = 0, .lines = 20})), Contains(SumFindingKind::kMissing));
  EXPECT_THAT(Kinds(judged.Judge({.samples = 0, .lines = 0, .construct = true})),
              Contains(SumFindingKind::kNotAsByNef));
}

TEST(JudgeMinkowskiFault, NothingAtAll) {
  Judged judged(Cube(1), Cube(1));
  judged.boundary = {};
  EXPECT_THAT(Kinds(judged.Judge(kSamples)), Contains(SumFindingKind::kMissing));
}

// The boundary of another pose, names and all.
TEST(JudgeMinkowskiFault, StaleBoundary) {
  testing::Random random(53);
  const Judged turned(LShape(), Cube(1), PoseOf(random.Rotation()));
  EXPECT_FALSE(
      JudgeMinkowski(turned.a, turned.b, RelativePose(), turned.boundary, kSamples).empty());
}

}  // namespace
}  // namespace touchstone::exact
