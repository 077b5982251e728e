// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_MESH_INNER_BALLS_H_
#define TOUCHSTONE_CORE_MESH_INNER_BALLS_H_

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "touchstone/core/mesh/mesh_pair.h"
#include "touchstone/core/mesh/triangle_mesh.h"

namespace touchstone {

// An open ball within a solid; a radius of 0 stands for none.
struct InnerBall {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double radius = 0.0;
};

// For every face a large ball that lies within the solid and comes near the face's middle from
// inside, within some thirtieth of its radius, in the body's own frame: proven to lie there,
// whatever was rounded on the way. A ball that cannot be proven is left out. Faces beside each
// other may share one.
//
// The ball begins large and shrinks onto a near point of the surface until nothing is inside it but
// near its rim (Ma, Bae, Choi, "3D medial axis point approximation using nearest neighbors and the
// normal field", 2012). Complexity: O(n sqrt n) on round bodies, if no faces share.
std::vector<InnerBall> InnerBalls(const TriangleMesh& mesh);

// The radius of an open ball round the point that lies within the solid, in the placed mesh's
// frame, as large as can be proven but for a sixty-fourth; nothing if the point cannot be. Each
// coordinate of the point may be off by `error`. Complexity: O(log n) on round bodies.
std::optional<double> InnerClearance(const PlacedMesh& mesh, const Eigen::Vector3d& point,
                                     double error);

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_MESH_INNER_BALLS_H_
