// SPDX-License-Identifier: MIT
//
//   here          meaning, in A's frame
//   x, y          points of A's surface and of B's: sums of corners of one face each
//   n             a direction; n.b - n.a >= h for all corners a, b of two faces puts these at least
//                 h / |n| apart
#ifndef TOUCHSTONE_CORE_MESH_SURFACE_DISTANCE_H_
#define TOUCHSTONE_CORE_MESH_SURFACE_DISTANCE_H_

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "touchstone/core/mesh/mesh_pair.h"

namespace touchstone {

struct SurfaceDistanceResult {
  // |y - x| in doubles, and bounds of the exact distance, each proven by itself: no two faces are
  // nearer than the lower one, and x and y no further apart than the upper one.
  double distance = 0.0, lower_bound = 0.0, upper_bound = 0.0;
  int face_a = -1, face_b = -1;
  // Up to rounding; in the caller's unit.
  Eigen::Vector3d point_on_a = Eigen::Vector3d::Zero(), point_on_b = Eigen::Vector3d::Zero();
  // From A to B, of unit length; zero where x and y fall together.
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  long node_pairs = 0, face_pairs = 0;  // compared
};

// Owned by the caller: storage, which answers do not depend on. One per thread; any pair.
struct SurfaceDistanceCache {
  struct Waiting {
    double apart;
    int a, b;
  };
  std::vector<Waiting> queue;
};

// The distance between the surfaces of A and B, which is that of the bodies where they share no
// point. The bounds hold for any two surfaces; for such as cross, the lower one is zero.
//
// The bounds are within 1e-12 of the size of the pair of each other but for faces whose nearest
// features are parallel up to rounding and no plane through them is well defined by their sides.
// Unchanged under a swap of the bodies and a rigid motion of both, up to the bounds.
//
// Complexity: O(k log n) for k pairs of faces about as near as the nearest. Best boxes first; ends,
// for a pair of boxes is opened once. No errors.
SurfaceDistanceResult SurfaceDistance(const MeshPair& pair, SurfaceDistanceCache* cache = nullptr);

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_MESH_SURFACE_DISTANCE_H_
