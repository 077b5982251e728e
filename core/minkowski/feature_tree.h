// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_MINKOWSKI_FEATURE_TREE_H_
#define TOUCHSTONE_CORE_MINKOWSKI_FEATURE_TREE_H_

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "touchstone/core/mesh/triangle_mesh.h"
#include "touchstone/core/minkowski/gauss_map.h"

namespace touchstone {

// Where a feature is, and which way it can be in contact: along normals in a cone and no more than
// `belt` off the plane across `pole`, for an edge's normals are an arc, and those of vertices on a
// ridge are all but one. The centre is a point of the feature, or of the plane or line that it lies
// in.
struct FeatureBound {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double radius = 0.0;
  NormalCone cone;
  Eigen::Vector3d pole = Eigen::Vector3d::UnitZ();
  double belt = 1.0;                       // all
  std::vector<Eigen::Vector3d> rays = {};  // of unit length, where the normals are what they span
};

inline constexpr int kFeatureTreeWidth = 8;

// Eight bounds, their numbers in lanes. Lane l is round node children[l], or the item ~children[l].
// A cone that bounds nothing has cosine -2. Along any normal in contact a feature is higher than
// the centre by something within `flat` of `lift`: what is left of its extent, as faces and edges
// lie across their normals.
template <class Scalar>
struct alignas(64) FeatureNodeOf {
  Scalar centre[3][kFeatureTreeWidth];
  Scalar radius[kFeatureTreeWidth];
  Scalar lift[kFeatureTreeWidth], flat[kFeatureTreeWidth];
  Scalar axis[3][kFeatureTreeWidth];
  Scalar cosine[kFeatureTreeWidth], sine[kFeatureTreeWidth];
  Scalar pole[3][kFeatureTreeWidth], belt[kFeatureTreeWidth];
  std::int32_t children[kFeatureTreeWidth];
  int lane_count;
  std::int32_t parent, parent_lane;  // the lane round this node; -1 at the root
};
using FeatureNode = FeatureNodeOf<double>;       // in the body's frame
using PlacedFeatureNode = FeatureNodeOf<float>;  // with room for what is rounded

// A node, or one lane of it, to go against the nodes of a deeper tree. Its code is the node's
// number, or ~(width node + lane).
struct FeatureLanes {
  const PlacedFeatureNode* node;
  int lane = -1;                              // all
  const PlacedFeatureNode* parent = nullptr;  // of a node as a whole, but for the root

  // The code of what is under a lane: a node, or an item, whose lane goes on alone.
  static int Next(int child, int code, int lane) {
    return child >= 0 ? child : code < 0 ? code : ~(kFeatureTreeWidth * code + lane);
  }
};

// A tree of spheres, normal cones and belts over features of one kind, in the body's frame.
// Cosines, sines and belts are padded by 1e-5 and radii by 1e-5 of themselves: a pose may be off
// orthonormal by 1e-6. Immutable; a copy shares the nodes.
class FeatureTree {
 public:
  FeatureTree() = default;
  // Over the items listed, item k with bounds[items[k]]. Complexity: O(n log n).
  FeatureTree(std::span<const FeatureBound> bounds, std::vector<int> items);

  // Node 0 is the root.
  std::span<const FeatureNode> nodes() const {
    return nodes_ == nullptr ? std::span<const FeatureNode>() : std::span(*nodes_);
  }
  // Whether the other is a copy.
  bool IsSameAs(const FeatureTree& other) const { return nodes_ == other.nodes_; }

 private:
  std::shared_ptr<const std::vector<FeatureNode>> nodes_;
};

// Over a body's faces; its vertices that a face of another body can rest on; its convex edges.
FeatureTree FaceTree(const TriangleMesh& mesh);
FeatureTree VertexTree(const TriangleMesh& mesh, const GaussMap& map);
FeatureTree ConvexEdgeTree(const TriangleMesh& mesh, const GaussMap& map);

// A feature tree placed in another frame: x to scale (R x + t), node by node as they are asked for.
// Storage is used again, and nodes stay where they are as long as they are to. Bounds are padded,
// so that they hold of any place where points are within `distance` and normals within `angle` of
// where they are. They are singles, for coordinates of the size of one (MeshPair's, below 2).
class PlacedFeatureTree {
 public:
  void Place(const FeatureTree& tree, const Eigen::Matrix3d& rotation,
             const Eigen::Vector3d& translation, double scale, double distance = 0.0,
             double angle = 0.0);

  bool empty() const { return tree_.nodes().empty(); }
  const PlacedFeatureNode& node(int i) {
    if (stamps_[i] != stamp_) PlaceNode(i);
    return nodes_[i];
  }
  FeatureLanes lanes(int code) {
    if (code >= 0) {
      const PlacedFeatureNode& all = node(code);
      return {&all, -1, all.parent < 0 ? nullptr : &node(all.parent)};
    }
    return {&node(~code / kFeatureTreeWidth), ~code % kFeatureTreeWidth};
  }

 private:
  void PlaceNode(int i);

  FeatureTree tree_;
  Eigen::Matrix3d rotation_;
  Eigen::Vector3d translation_;
  double scale_ = 1.0, distance_ = 0.0, angle_ = 0.0, cosine_ = 1.0, sine_ = 0.0;
  std::uint32_t stamp_ = 0;
  std::vector<std::uint32_t> stamps_;
  std::vector<PlacedFeatureNode> nodes_;
};

// Which facets are asked for: those that come within `reach` of a point, with it on the inner side
// of their plane, or on the outer by no more than `-lowest`.
struct FeatureQuery {
  double reach;
  double lowest = 0.0;
  Eigen::Vector3d around = Eigen::Vector3d::Zero();
};

// Pairs of lanes that may have such a facet: whose sums a - b come near, and whose cones meet (A's
// with minus B's): bit i of masks[j] for lane i of A and lane j of B.
void MeetingFeatures(const FeatureLanes& a, const FeatureLanes& b, const FeatureQuery& query,
                     std::uint8_t masks[kFeatureTreeWidth]);

// No more than the distance from the origin of any sum of lane i of A and lane j of B.
double NearestSum(const PlacedFeatureNode& a, int i, const PlacedFeatureNode& b, int j);

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_MINKOWSKI_FEATURE_TREE_H_
