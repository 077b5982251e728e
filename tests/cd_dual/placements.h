// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TESTS_CD_DUAL_PLACEMENTS_H_
#define TOUCHSTONE_TESTS_CD_DUAL_PLACEMENTS_H_

#include <string>
#include <vector>

#include "touchstone/core/base/relative_pose.h"
#include "touchstone/core/convex/convex_polyhedron.h"
#include "touchstone/tests/testing/random.h"

namespace touchstone::testing {

struct Placement {
  std::string name;
  ConvexPolyhedron p, q;
  RelativePose pose;
};

RelativePose MustPose(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation);

// One of the 24 rotations that permute the axes: exact.
Eigen::Matrix3d AxisRotation(Random* random);

// Small bodies in contact and near it: boxes and prisms on a lattice (parallel faces, aligned
// edges, exact touches), tetrahedra of small integers, round bodies at any rotation.
std::vector<Placement> SmallPlacements(std::uint64_t seed, int count);

}  // namespace touchstone::testing

#endif  // TOUCHSTONE_TESTS_CD_DUAL_PLACEMENTS_H_
