// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_CONVEX_FACE_PLANES_INTERNAL_H_
#define TOUCHSTONE_CORE_CONVEX_FACE_PLANES_INTERNAL_H_

#include <vector>

#include "touchstone/core/base/orientation.h"
#include "touchstone/core/base/status.h"
#include "touchstone/core/convex/convex_polyhedron_data.h"

namespace touchstone::internal {

// A coordinate axis that a face's normal is not orthogonal to, and the normal's exact sign along
// it: seen along that axis the face is a polygon, counterclockwise iff sign > 0.
struct FaceAxis {
  int axis;
  int sign;
};

// Fills face_planes and face_normals from the loops. Returns kDegenerateFace, kNonPlanarFace or
// kNotConvex unless every loop is a convex simple polygon that lies exactly in one plane; vertices
// within an edge of it are legal. `axes` receives one entry per face. Complexity: O(n).
Status BuildFacePlanes(const Orientation& orientation, ConvexPolyhedronData* data,
                       std::vector<FaceAxis>* axes);

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_CONVEX_FACE_PLANES_INTERNAL_H_
