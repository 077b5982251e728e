// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_MESH_ENCLOSURE_INTERNAL_H_
#define TOUCHSTONE_CORE_MESH_ENCLOSURE_INTERNAL_H_

#include "touchstone/core/base/orientation.h"
#include "touchstone/core/base/status.h"
#include "touchstone/core/mesh/triangle_mesh_data.h"

namespace touchstone::internal {

// Fills the depth of every component and checks that it faces the right way for it: kFlat or
// kInward, by the component's first face. Complexity: O(n c).
Status CheckEnclosure(const Orientation& orientation, TriangleMeshData* data);

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_MESH_ENCLOSURE_INTERNAL_H_
