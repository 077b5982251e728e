// SPDX-License-Identifier: MIT
//
// Two placed closed surfaces in their own frames: how far apart they are at least, opening only
// what comes near, and whether two faces still cross. What a pair of meshes is asked before it is
// placed whole.
#ifndef TOUCHSTONE_CORE_SCENE_MESH_MARGIN_INTERNAL_H_
#define TOUCHSTONE_CORE_SCENE_MESH_MARGIN_INTERNAL_H_

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "touchstone/core/base/relative_pose.h"
#include "touchstone/core/scene/shape.h"

namespace touchstone::internal {

// Lengths are A's, whose frame stretches the world's by no more than 1 + 1.6e-6, and shrinks it by
// no more.
class MeshMargin {
 public:
  // `b` is placed in A's frame by `pose`. Holds references.
  MeshMargin(const ScenePart& a, const ScenePart& b, const RelativePose& pose);

  // A lower bound of the distance between the surfaces, not above `enough`; not positive: nothing
  // is proven. Adds the pairs of boxes compared to *nodes. Descends both trees, nearest first, and
  // compares faces by the direction between their nearest points. Stops with nothing after a fixed
  // number of steps. Complexity: O(log n + k) for k pairs of faces about as near as the nearest.
  double SurfacesApart(double enough, std::vector<std::pair<int, int>>* stack, long* nodes) const;

  // Where the surfaces are apart: that no component of one can lie inside the other body, since a
  // vertex of it is outside of the other's box.
  bool NoneInside() const;

  // How far points may move so that an edge of one of these faces still passes through the other;
  // not positive: nothing is proven.
  double Crossing(int face_a, int face_b) const;

 private:
  Eigen::Vector3d PointOfB(int v) const;
  double FacesApart(int face_a, int face_b) const;
  // The edge (u, w) and the triangle of the points t.
  double EdgeCrosses(const Eigen::Vector3d& u, const Eigen::Vector3d& w,
                     const Eigen::Vector3d t[3]) const;

  const ScenePart& a_;
  const ScenePart& b_;
  const RelativePose& pose_;
  const TriangleMesh& mesh_a_;
  const TriangleMesh& mesh_b_;
  double size_;   // of the pair, as in MeshPair
  double error_;  // of a coordinate of B in A's frame
  bool is_fair_;  // products of lengths neither overflow nor underflow
};

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_SCENE_MESH_MARGIN_INTERNAL_H_
