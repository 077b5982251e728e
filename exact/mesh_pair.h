// SPDX-License-Identifier: GPL-3.0-or-later
//
//   here            meaning
//   D, B, U         A's frame times a positive scale: D a for A, B b + U for B, integers
//   unit            true length = integer length * 2^exponent / D
#ifndef TOUCHSTONE_EXACT_MESH_PAIR_H_
#define TOUCHSTONE_EXACT_MESH_PAIR_H_

#include <Eigen/Core>
#include <span>
#include <utility>
#include <vector>

#include "touchstone/core/base/relative_pose.h"
#include "touchstone/core/mesh/triangle_mesh.h"
#include "touchstone/exact/integer.h"

namespace touchstone::exact {

// A binary tree of boxes over the faces of a mesh, in doubles.
class FaceTree {
 public:
  FaceTree() = default;
  FaceTree(const std::vector<Eigen::Vector3d>& points, std::span<const std::array<int, 3>> faces);

  struct Node {
    Eigen::Vector3d low, high;
    int left = -1, right = -1;  // children; -1: a single face
    int face = -1;
  };
  const std::vector<Node>& nodes() const { return nodes_; }  // node 0 is the root

 private:
  int Add(const std::vector<Node>& leaves, std::span<int> members);

  std::vector<Node> nodes_;
};

// Pairs of faces of a and of b moved by `offset` whose boxes come within `margin` of each other.
std::vector<std::pair<int, int>> NearFaces(const FaceTree& a, const FaceTree& b,
                                           const Eigen::Vector3d& offset, double margin);

// Two meshes placed by a pose, as integers, without loss, and in doubles with a bound for filters.
// The doubles of meshes and pose are taken at their word; a pose made from two world poses means
// both exact images, scaled by det Rp.
class PlacedMeshPair {
 public:
  PlacedMeshPair(const TriangleMesh& a, const TriangleMesh& b, const RelativePose& pose);

  const TriangleMesh& a() const { return a_; }
  const TriangleMesh& b() const { return b_; }

  const IntegerVector& point_a(int v) const { return points_a_[v]; }
  const IntegerVector& point_b(int v) const { return points_b_[v]; }
  int exponent() const { return exponent_; }
  const Integer& scale() const { return scale_; }  // D

  // In true units; each coordinate within 2^-50 of its size of the exact one.
  const std::vector<Eigen::Vector3d>& doubles_a() const { return doubles_a_; }
  const std::vector<Eigen::Vector3d>& doubles_b() const { return doubles_b_; }
  const FaceTree& tree_a() const { return tree_a_; }
  const FaceTree& tree_b() const { return tree_b_; }
  // The largest coordinate of either.
  double size() const { return size_; }

 private:
  const TriangleMesh a_, b_;
  int exponent_ = 0;
  Integer scale_ = 1;
  std::vector<IntegerVector> points_a_, points_b_;
  std::vector<Eigen::Vector3d> doubles_a_, doubles_b_;
  FaceTree tree_a_, tree_b_;
  double size_ = 0.0;
};

// An exact translation: coordinates / denominator * 2^exponent, in A's frame. The denominator is
// positive.
struct ExactTranslation {
  explicit ExactTranslation(const Eigen::Vector3d& x);
  // Coordinates as they are, each a fraction.
  explicit ExactTranslation(const std::array<mpq_class, 3>& x);

  IntegerVector coordinates;
  Integer denominator = 1;
  int exponent = 0;
};

}  // namespace touchstone::exact

#endif  // TOUCHSTONE_EXACT_MESH_PAIR_H_
