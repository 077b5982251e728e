// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_CPD_TRANSLATIONAL_COLLISION_H_
#define TOUCHSTONE_CORE_CPD_TRANSLATIONAL_COLLISION_H_

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "touchstone/core/mesh/membership.h"
#include "touchstone/core/mesh/mesh_pair.h"
#include "touchstone/core/minkowski/convolution.h"

namespace touchstone {

struct TranslationalCollisionResult {
  bool is_hit = false;
  // The part of the way to the first contact, in doubles; 1 if there is none.
  double fraction = 1.0;
  // The same or a little less: B moved so far was proven not to overlap A. 0 where not even the
  // start was.
  double safe_fraction = 0.0;
  SumFacet features;                                 // that touch first
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // of the contact, from A to B
  int node_pairs = 0, triangle_pairs = 0;
};

// Owned by the caller: storage.
struct TranslationalCollisionCache {
  std::vector<std::pair<int, int>> stack;
  MembershipCache membership;
};

// The first contact of B on its way from B + from to B + to, in A's frame, along the segment: where
// it first crosses a facet of M seen from outside.
//
// Requires finite ends, and B + from not to overlap A: the way out of an overlap is not looked for.
// The contact is found in doubles, to within 2^-40 of the pair's size; that the way up to
// `safe_fraction` ends outside M° is proven. Nothing rests on it in between: a body thinner than
// the rounding may be passed.
//
// Complexity: O(k + log n) for k pairs of triangles whose boxes the way crosses. No errors.
TranslationalCollisionResult TranslationalCollision(const MeshPair& pair,
                                                    const Eigen::Vector3d& from,
                                                    const Eigen::Vector3d& to,
                                                    TranslationalCollisionCache* cache = nullptr);

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_CPD_TRANSLATIONAL_COLLISION_H_
