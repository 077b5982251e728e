// SPDX-License-Identifier: MIT
//
//   paper         here                  meaning
//   A, B          a, b                  the bodies; B placed in A's frame by a RelativePose
//   B + x         translation           B moved by x, in A's frame
//   M° , x in M°  Membership            M° = int A ⊕ -int B: the interiors of A and B + x meet
#ifndef TOUCHSTONE_CORE_MESH_MESH_PAIR_H_
#define TOUCHSTONE_CORE_MESH_MESH_PAIR_H_

#include <Eigen/Core>
#include <array>
#include <unordered_map>
#include <vector>

#include "touchstone/core/base/exact_pose.h"
#include "touchstone/core/base/orientation.h"
#include "touchstone/core/base/relative_pose.h"
#include "touchstone/core/mesh/box_tree.h"
#include "touchstone/core/mesh/face_lanes.h"
#include "touchstone/core/mesh/triangle_mesh.h"

namespace touchstone {

// Bounds the relative rounding error of one operation in every rounding mode.
inline constexpr double kUnit = 0x1p-52;

// normal . difference, where each coordinate of the normal is off by at most normal_error, and of
// the difference by difference_error.
Estimate HeightAlong(const Eigen::Vector3d& normal, double normal_error,
                     const Eigen::Vector3d& difference, double difference_error);

// The sign of an estimate; 0: doubles cannot tell.
inline int TriageSign(const Estimate& estimate) {
  return estimate.value > estimate.error ? 1 : estimate.value < -estimate.error ? -1 : 0;
}

// A face's plane in doubles: a vertex of it, and the normal there (not of unit length). Each
// coordinate of the normal is within `error` of the exact one.
struct FacePlane {
  int vertex;
  double error;
  Eigen::Vector3d normal;
  double height;  // normal . vertex, as rounded
  double length;  // the sum of the normal's coordinates, each taken positive
};

// One mesh of a pair, placed in A's frame and scaled.
struct PlacedMesh {
  TriangleMesh mesh;
  std::vector<Eigen::Vector3d> points;  // each coordinate within point_error of the exact one
  double point_error = 0.0;
  std::vector<FacePlane> planes;
  BoxTree tree;
  std::vector<FaceLanes> leaves;  // of the tree, with slabs as thin as normals make them
};

// Two meshes at a pose, ready to be asked about many translations: coordinates in A's frame times a
// power of two that brings the pair's size (max |a| + max |R b| + |t|, by coordinates) to one at
// most, so that products neither overflow nor lose their bits, whatever the scale of the bodies.
//
// Complexity of making it: O(n). Immutable afterwards but for Place.
class MeshPair {
 public:
  MeshPair(TriangleMesh a, TriangleMesh b, const RelativePose& pose);

  // Moves B to another pose; storage is used again.
  void Place(const RelativePose& pose);

  const PlacedMesh& a() const { return a_; }
  const PlacedMesh& b() const { return b_; }
  const RelativePose& pose() const { return pose_; }
  // The power of two by which lengths were multiplied.
  double scale() const { return scale_; }

 private:
  void FindPlanes(const TriangleMesh& mesh, std::vector<FacePlane>* planes) const;
  void FindDirections();
  void PlacePlanesOfB();
  void PlaceTreeOfB();

  PlacedMesh a_, b_;
  // In B's frame: scaled planes without heights, and across what slabs round its leaves are thin.
  std::vector<FacePlane> own_planes_of_b_;
  std::vector<Eigen::Vector3d> own_directions_of_b_, directions_of_a_, directions_of_b_;
  RelativePose pose_;
  double scale_ = 1.0;
};

// The pair with big numbers: points and differences times pose().factor(), not scaled. Made on
// demand and kept; not for several threads at once.
class ExactMeshPair {
 public:
  explicit ExactMeshPair(const MeshPair& pair)
      : a_(pair.a().mesh), b_(pair.b().mesh), pose_(pair.pose()) {}

  const ExactPose& pose() const { return pose_; }
  const DyadicVector& PointOfA(int v);
  const DyadicVector& PointOfB(int v);

 private:
  TriangleMesh a_, b_;
  ExactPose pose_;
  std::unordered_map<int, DyadicVector> points_of_a_, points_of_b_;
};

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_MESH_MESH_PAIR_H_
