// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_CPD_CONTACT_SPACE_PROJECTION_H_
#define TOUCHSTONE_CORE_CPD_CONTACT_SPACE_PROJECTION_H_

#include <Eigen/Core>
#include <optional>

#include "touchstone/core/cpd/translational_collision.h"
#include "touchstone/core/mesh/mesh_pair.h"

namespace touchstone {

struct ContactSpaceOptions {
  int iteration_limit = 24;  // collisions along segments, at most
};

struct ContactSpaceResult {
  bool is_separate = false;  // the interiors do not meet: depth 0
  // Proven: B moved by it does not overlap A. A local optimum: an upper bound of the depth, no
  // more.
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  int iterations = 0;
  bool reached_limit = false;
};

// Keeps the last answer, where the next search begins.
struct ContactSpaceCache {
  std::optional<Eigen::Vector3d> last;
  TranslationalCollisionCache collision;
};

// Penetration depth by iterative contact-space projection, in the manner of PolyDepth: from a
// placement without overlap B moves toward the origin until it touches; the origin is projected
// onto what the contacts met leave of their tangent half-spaces, and B moves there, until nothing
// becomes shorter. Cold it begins at the six placements beside A's box; else at the last answer,
// pushed outward until it is free.
//
// Complexity: as many collisions along segments as iterations. No errors.
// Source: Je, Tang, Lee, Lee, Kim, "PolyDepth" (2012), the paper's initialiser.
ContactSpaceResult ContactSpaceProjection(const MeshPair& pair,
                                          const ContactSpaceOptions& options = {},
                                          ContactSpaceCache* cache = nullptr);

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_CPD_CONTACT_SPACE_PROJECTION_H_
