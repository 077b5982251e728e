// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_MINKOWSKI_LOCAL_SURFACE_INTERNAL_H_
#define TOUCHSTONE_CORE_MINKOWSKI_LOCAL_SURFACE_INTERNAL_H_

#include "touchstone/core/minkowski/local_sum.h"

namespace touchstone::internal {

// Fills `neighbors` and `is_border_vertex` from `triangles`. Complexity: O(n log n).
void FindNeighbors(LocalSum* sum);

// Fills `vertex_normals` from `triangle_normals`. A vertex whose mean vanishes has the normal of
// one of its triangles; one with none (of a sheet, a segment, a point) has a zero. Complexity:
// O(n).
void FindVertexNormals(LocalSum* sum);

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_MINKOWSKI_LOCAL_SURFACE_INTERNAL_H_
