// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TESTS_CPD_DEPTH_BODIES_H_
#define TOUCHSTONE_TESTS_CPD_DEPTH_BODIES_H_

#include "touchstone/core/cpd/mesh_penetration_depth.h"
#include "touchstone/tools/shapes/shapes.h"

namespace touchstone::testing {

// Two meshes, and their depth at any pose.
struct DepthBodies {
  TriangleMesh mesh_a, mesh_b;
  ContactBody a, b;

  DepthBodies(const Shape& shape_a, const Shape& shape_b)
      : mesh_a(MustBuild(shape_a)), mesh_b(MustBuild(shape_b)), a(mesh_a), b(mesh_b) {}

  MeshPair At(const RelativePose& pose) const { return MeshPair(mesh_a, mesh_b, pose); }
  MeshDepthResult Depth(const RelativePose& pose, const MeshDepthOptions& options = {},
                        MeshDepthCache* cache = nullptr) const {
    return MeshPenetrationDepth(At(pose), a, b, options, cache);
  }
};

}  // namespace touchstone::testing

#endif  // TOUCHSTONE_TESTS_CPD_DEPTH_BODIES_H_
