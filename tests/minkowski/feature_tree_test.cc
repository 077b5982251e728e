// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/feature_tree.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "touchstone/core/cpd/contact_body.h"
#include "touchstone/core/mesh/mesh_pair.h"
#include "touchstone/core/minkowski/convolution.h"
#include "touchstone/tests/testing/random.h"
#include "touchstone/tools/shapes/shapes.h"

namespace touchstone {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

using Lane = std::pair<int, int>;  // node, lane

// The lane of an item and all lanes round it, up to the root's.
std::vector<Lane> LanesRound(const FeatureTree& tree, int item) {
  std::vector<Lane> lanes;
  for (int n = 0; n < static_cast<int>(tree.nodes().size()); ++n) {
    const FeatureNode& node = tree.nodes()[n];
    for (int lane = 0; lane < node.lane_count; ++lane) {
      if (node.children[lane] == ~item) lanes.emplace_back(n, lane);
    }
  }
  if (lanes.size() != 1) return {};
  while (tree.nodes()[lanes.back().first].parent >= 0) {
    const FeatureNode& node = tree.nodes()[lanes.back().first];
    lanes.emplace_back(node.parent, node.parent_lane);
  }
  return lanes;
}

double DistanceToSegment(const Vector3d& a, const Vector3d& b) {
  const Vector3d ab = b - a;
  return (a + std::clamp(-a.dot(ab) / ab.squaredNorm(), 0.0, 1.0) * ab).norm();
}

struct Polygon {
  std::vector<Vector3d> corners;
  Vector3d normal = Vector3d::Zero();  // of twice the area

  double Height() const { return normal.dot(corners[0]) / normal.norm(); }
  double Distance() const {
    double least = 1e300;
    bool is_inside = true;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Vector3d &p = corners[k], &q = corners[(k + 1) % corners.size()];
      least = std::min(least, DistanceToSegment(p, q));
      is_inside &= normal.dot((q - p).cross(-p)) >= 0.0;
    }
    return is_inside ? std::abs(Height()) : least;
  }
};

Polygon PolygonOf(const MeshPair& pair, const SumFacet& facet) {
  const SumCorners corners = CornersOf(pair, facet);
  Polygon polygon;
  for (int k = 0; k < corners.count; ++k) {
    const SumVertex& v = corners.vertices[k];
    polygon.corners.push_back(pair.a().points[v.a] - pair.b().points[v.b]);
    if (k < 2) continue;
    polygon.normal += (polygon.corners[k - 1] - polygon.corners[0])
                          .cross(polygon.corners[k] - polygon.corners[0]);
  }
  return polygon;
}

// Of one pose: no facet of the convolution may be passed over at any level of the trees, alone or
// as one of eight, nor be called further than it is. `moved` is a pose near the one that the trees
// are placed at, within their room.
struct Counts {
  int facets = 0, parted = 0;  // pairs of lanes round no facet that are told apart
};
void ExpectBounds(const ContactBody& a, const ContactBody& b, const RelativePose& placed_at,
                  double distance, double angle, const RelativePose& moved, Counts* counts) {
  const MeshPair pair(a.mesh(), b.mesh(), moved);
  PlacedFeatureTree trees_a[3], trees_b[3];
  const FeatureTree* of_a[] = {&a.faces(), &a.vertices(), &a.convex_edges()};
  const FeatureTree* of_b[] = {&b.vertices(), &b.faces(), &b.convex_edges()};
  for (int k = 0; k < 3; ++k) {
    trees_a[k].Place(*of_a[k], Matrix3d::Identity(), Vector3d::Zero(), pair.scale());
    trees_b[k].Place(*of_b[k], placed_at.rotation(), placed_at.translation(), pair.scale(),
                     distance, angle);
  }
  const double slack = 1e-12 + distance;
  for (const SumFacet& facet : ConvolutionByBruteForce(pair, a.gauss_map(), b.gauss_map()).facets) {
    const Polygon polygon = PolygonOf(pair, facet);
    if (!(polygon.normal.norm() > 1e-9)) continue;
    ++counts->facets;
    const double far = polygon.Distance();
    const int kind = static_cast<int>(facet.kind);
    const auto lanes_a = LanesRound(*of_a[kind], facet.a),
               lanes_b = LanesRound(*of_b[kind], facet.b);
    ASSERT_FALSE(lanes_a.empty());
    ASSERT_FALSE(lanes_b.empty());
    for (const auto& [n, i] : lanes_a) {
      for (const auto& [m, j] : lanes_b) {
        const FeatureLanes all_a = trees_a[kind].lanes(n), all_b = trees_b[kind].lanes(m);
        EXPECT_LE(NearestSum(*all_a.node, i, *all_b.node, j), far + slack);
        for (const bool faces_away : {false, true}) {
          if (faces_away && !(polygon.Height() > 1e-9 + distance)) continue;
          for (const FeatureLanes& from_a : {all_a, FeatureLanes{all_a.node, i}}) {
            for (const FeatureLanes& from_b : {all_b, FeatureLanes{all_b.node, j}}) {
              std::uint8_t masks[kFeatureTreeWidth];
              MeetingFeatures(from_a, from_b, {far + slack, faces_away ? 0.0 : -far - slack},
                              masks);
              EXPECT_TRUE((masks[j] >> i) & 1) << far << " " << polygon.Height();
            }
          }
        }
      }
    }
  }
  std::uint8_t masks[kFeatureTreeWidth];
  MeetingFeatures(trees_a[0].lanes(0), trees_b[0].lanes(0), {1e-3}, masks);
  for (int j = 0; j < trees_b[0].node(0).lane_count; ++j) {
    for (int i = 0; i < trees_a[0].node(0).lane_count; ++i)
      counts->parted += !((masks[j] >> i) & 1);
  }
}

// Few planes and many, slivers, hollows; refined ones have many features in one plane.
const char* const kShapes[] = {"box", "key", "slot", "star", "cone", "torus", "dimpled", "spiked"};

TEST(FeatureTree, PassesOverNoFacet) {
  Counts counts;
  testing::Random random(5);
  for (const char* name_a : kShapes) {
    for (const char* name_b : kShapes) {
      const ContactBody a(MustBuild(NamedShape(name_a, random.Int(12, 80)))),
          b(MustBuild(NamedShape(name_b, random.Int(12, 80))));
      SCOPED_TRACE(std::string(name_a) + " " + name_b);
      for (int i = 0; i < 2; ++i) {
        const Matrix3d rotation = i == 0 ? Matrix3d(Matrix3d::Identity()) : random.Rotation();
        // Mostly where much comes near the origin.
        const Vector3d from = a.mesh().vertex(random.Int(0, a.mesh().vertex_count() - 1)),
                       to = b.mesh().vertex(random.Int(0, b.mesh().vertex_count() - 1));
        const RelativePose pose =
            *RelativePose::Make(rotation, from - rotation * to + 0.2 * random.Direction());
        ExpectBounds(a, b, pose, 0.0, 0.0, pose, &counts);
      }
    }
  }
  EXPECT_GT(counts.facets, 20000);
  EXPECT_GT(counts.parted, 500);
}

// The pose with B moved so that the plane of a facet passes a hair beyond the origin.
RelativePose WherePlanePassesOrigin(const MeshPair& pair, const Polygon& polygon,
                                    testing::Random* random) {
  const double height = std::pow(10.0, -random->Int(5, 8));
  const Vector3d shift = (polygon.Height() - height) * polygon.normal.normalized();
  return *RelativePose::Make(pair.pose().rotation(),
                             pair.pose().translation() + shift / pair.scale());
}

// Planes that pass a hair beyond the origin, of facets far aside, and rotations that are as far off
// orthonormal as they may be.
TEST(FeatureTree, PassesOverNoFacetWhosePlaneIsNear) {
  Counts counts;
  testing::Random random(7);
  for (const char* name_a : {"star", "cone", "torus", "spiked"}) {
    for (const char* name_b : {"star", "key", "torus"}) {
      const ContactBody a(MustBuild(NamedShape(name_a, 60))), b(MustBuild(NamedShape(name_b, 40)));
      SCOPED_TRACE(std::string(name_a) + " " + name_b);
      for (int i = 0; i < 30; ++i) {
        Matrix3d rotation = random.Rotation();
        const Vector3d u = random.Direction(), v = random.Direction();
        if (i % 2 == 0)
          rotation *= Matrix3d::Identity() + 2.4e-7 * (u * v.transpose() + v * u.transpose());
        const Vector3d translation = random.Direction();
        const MeshPair pair(a.mesh(), b.mesh(), *RelativePose::Make(rotation, translation));
        const auto facets = ConvolutionByBruteForce(pair, a.gauss_map(), b.gauss_map()).facets;
        const int last = static_cast<int>(facets.size()) - 1;
        const Polygon polygon = PolygonOf(pair, facets[random.Int(0, last)]);
        if (!(polygon.normal.norm() > 1e-6)) continue;
        const RelativePose pose = WherePlanePassesOrigin(pair, polygon, &random);
        ExpectBounds(a, b, pose, 0.0, 0.0, pose, &counts);
      }
    }
  }
  EXPECT_GT(counts.facets, 10000);
}

// Edges that are all but parallel, whose plane passes a hair beyond the origin: what two belts
// leave of the normals is told by the rounding of their poles' cross product, unless there is room
// for it.
TEST(FeatureTree, PassesOverNoFacetOfEdgesThatAreAllButParallel) {
  Counts counts;
  testing::Random random(8);
  for (const char* name : {"box", "key", "slot", "cone", "torus", "star"}) {
    const ContactBody a(MustBuild(NamedShape(name, 40))), b(MustBuild(NamedShape(name, 36)));
    SCOPED_TRACE(name);
    for (int i = 0; i < 60; ++i) {
      const double angle = std::pow(10.0, -random.Uniform(0.5, 5.0));
      const Matrix3d rotation = Eigen::AngleAxisd(angle, random.Direction()).toRotationMatrix();
      const Vector3d translation = random.Direction();
      const MeshPair pair(a.mesh(), b.mesh(), *RelativePose::Make(rotation, translation));
      auto facets = ConvolutionByBruteForce(pair, a.gauss_map(), b.gauss_map()).facets;
      std::erase_if(facets, [&](const SumFacet& facet) {
        return facet.kind != SumFacetKind::kEdgeEdge ||
               !(PolygonOf(pair, facet).normal.norm() > 1e-9);
      });
      if (facets.empty()) continue;
      const Polygon polygon =
          PolygonOf(pair, facets[random.Int(0, static_cast<int>(facets.size()) - 1)]);
      const RelativePose pose = WherePlanePassesOrigin(pair, polygon, &random);
      ExpectBounds(a, b, pose, 0.0, 0.0, pose, &counts);
    }
  }
  EXPECT_GT(counts.facets, 10000);
}

TEST(FeatureTree, HasRoomForMotions) {
  Counts counts;
  testing::Random random(6);
  for (const char* name : kShapes) {
    const ContactBody a(MustBuild(NamedShape(name, 40))), b(MustBuild(NamedShape("star", 40)));
    SCOPED_TRACE(name);
    const Matrix3d rotation = random.Rotation();
    const Vector3d translation = 0.5 * random.Direction();
    const double angle = 0.05;
    const Matrix3d turn = Eigen::AngleAxisd(angle, random.Direction()).toRotationMatrix();
    const RelativePose pose = *RelativePose::Make(rotation, translation),
                       moved = *RelativePose::Make(turn * rotation, translation);
    const MeshPair pair(a.mesh(), b.mesh(), pose);
    const double distance = 1.0001 * angle * pair.scale() * 2.0 * b.mesh().max_coordinate();
    ExpectBounds(a, b, pose, distance, 1.0001 * angle, moved, &counts);
  }
  EXPECT_GT(counts.facets, 2000);
}

}  // namespace
}  // namespace touchstone
