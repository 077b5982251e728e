// SPDX-License-Identifier: MIT
//
// One triangle against eight: most whose boxes meet are parted by the plane of one of them.
#ifndef TOUCHSTONE_CORE_MESH_TRIANGLE_LANES_INTERNAL_H_
#define TOUCHSTONE_CORE_MESH_TRIANGLE_LANES_INTERNAL_H_

#include "touchstone/core/mesh/triangle_contact_internal.h"

namespace touchstone::internal {

// The faces among a node's children, and their planes, in lanes.
struct alignas(64) TriangleLanes {
  double corners[3][3][kTreeWidth];  // of corner k, axis i
  double normal[3][kTreeWidth], height[kTreeWidth], least[kTreeWidth];
  std::uint8_t faces;  // bit l: whether lane l is one

  void Gather(const PlacedMesh& body, const BoxNode& node, const Offset& offset);
};

// Which lanes the planes of both triangles leave in doubt, or are no faces: of the others doubles
// prove that they are apart from the face. `move` is the offset of the lanes' body from the other.
std::uint8_t LanesNotParted(const PlacedMesh& body, int face, const TriangleLanes& lanes,
                            const Eigen::Vector3d& move, const Offset& offset);

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_MESH_TRIANGLE_LANES_INTERNAL_H_
