// SPDX-License-Identifier: MIT
//
//   paper          here                 meaning
//   S(X), S_X      SphereConeTree       bounding spheres of the features of X, with normal cones
//   Theorem 2      MeetingLanes         (S_A ⊕ -S_B) ∩ S = ∅ implies (A' ⊕ -B') ∩ S = ∅, with
//                                       A' = A ∩ S_A, B' = B ∩ S_B; S_A ⊕ -S_B is the sphere round
//                                       c_A - c_B of radius r_A + r_B
//
// The paper prints unions where the theorem means intersections, and c_A + c_B.
#ifndef TOUCHSTONE_CORE_MINKOWSKI_SPHERE_HIERARCHY_INTERNAL_H_
#define TOUCHSTONE_CORE_MINKOWSKI_SPHERE_HIERARCHY_INTERNAL_H_

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "touchstone/core/mesh/mesh_pair.h"
#include "touchstone/core/minkowski/gather_internal.h"
#include "touchstone/core/minkowski/gauss_map.h"
#include "touchstone/core/minkowski/support_signs_internal.h"

namespace touchstone::internal {

// A sphere that holds a feature, and a cone that holds its normals.
struct FeatureBound {
  Eigen::Vector3d center;
  double radius;
  NormalCone cone;
};

// The same with the cone's angle by cosine and sine; a cosine below -1 for all directions.
struct LaneBound {
  double center[3], radius;
  double axis[3], cosine, sine;
};

// A tree of such, eight to a node: all of them in lanes.
class SphereConeTree {
 public:
  static constexpr int kWidth = 8;
  struct alignas(64) Node {
    double center[3][kWidth], radius[kWidth];
    double axis[3][kWidth], cosine[kWidth], sine[kWidth];
    std::int32_t children[kWidth];  // a node, or ~item
    int lane_count;
    LaneBound all;  // round all lanes
  };

  SphereConeTree() = default;
  // Over the items listed, item k with bounds[items[k]]. Complexity: O(n log n).
  SphereConeTree(std::span<const FeatureBound> bounds, std::vector<int> items);

  std::span<const Node> nodes() const { return nodes_; }

 private:
  FeatureBound AddNode(std::span<const FeatureBound> bounds, std::span<int> items);
  std::vector<Node> nodes_;
};

// Such a tree under x -> sense * (linear x + shift), which places the nodes that are asked for.
class PlacedSphereConeTree {
 public:
  explicit PlacedSphereConeTree(SphereConeTree tree);
  // `linear` is `scale` times a matrix within 1e-6 of a rotation. Cones are widened by an angle.
  void Place(const Eigen::Matrix3d& linear, const Eigen::Vector3d& shift, double scale,
             double sense, double widening);

  bool empty() const { return tree_.nodes().empty(); }
  const SphereConeTree::Node& node(int i) {
    if (stamps_[i] != stamp_) PlaceNode(i);
    return placed_[i];
  }

 private:
  void PlaceNode(int i);
  void PlaceSize(double radius, double cosine, double sine, double* placed_radius,
                 double* placed_cosine, double* placed_sine) const;

  SphereConeTree tree_;
  std::vector<SphereConeTree::Node> placed_;
  std::vector<std::uint32_t> stamps_;
  std::uint32_t stamp_ = 0;
  Eigen::Matrix3d linear_, turn_;
  Eigen::Vector3d shift_;
  double scale_ = 1.0;
  double widening_ = 0.0, widening_cosine_ = 1.0, widening_sine_ = 0.0;
};

// All that is within a reach of a box, given by its middle and half its sides; a ball has none.
struct GatherTarget {
  Eigen::Vector3d center, half;
  double reach;
};

// Both bodies' trees over faces, vertices that can support, and convex edges.
class SphereHierarchy {
 public:
  SphereHierarchy(const TriangleMesh& a, const GaussMap& map_a, const TriangleMesh& b,
                  const GaussMap& map_b);

  // Widened by an angle, cones that meet at any rotation within it of the pair's meet at the
  // pair's.
  void Place(const MeshPair& pair, double widening = 0.0);

  // All pairs of features, named as facets, whose cones meet and whose sum may meet a ball, and
  // some others. Edges' `is_along_cross` is not set. Complexity: O(k + log n) on round bodies.
  void NearBall(const Eigen::Vector3d& center, double radius, std::vector<SumFacet>* candidates);
  // The same of those whose sum may meet one of the boxes.
  void NearAnyOf(const NearBoxes& near, std::vector<SumFacet>* candidates);

 private:
  enum Kind { kFaces, kVertices, kEdges, kKinds };
  void AllPairs(const GatherTarget& target, const NearBoxes* near,
                std::vector<SumFacet>* candidates);
  void Pairs(Kind kind_a, Kind kind_b, SumFacetKind kind, const GatherTarget& target,
             const NearBoxes* near, std::vector<SumFacet>* candidates);

  std::vector<PlacedSphereConeTree> trees_[2];  // of A; of B, reflected: centres add
  std::vector<std::pair<int, int>> stack_;
};

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_MINKOWSKI_SPHERE_HIERARCHY_INTERNAL_H_
