// SPDX-License-Identifier: MIT
//
// Meshes and poses as the program's arguments.
#ifndef TOUCHSTONE_TOOLS_MESH_ARGUMENTS_H_
#define TOUCHSTONE_TOOLS_MESH_ARGUMENTS_H_

#include <string>
#include <vector>

#include "touchstone/core/base/relative_pose.h"
#include "touchstone/core/mesh/triangle_mesh.h"

namespace touchstone {

inline constexpr const char* kMeshHelp =
    "a closed mesh: a file (OFF, OBJ, STL, PLY), or shape:NAME or shape:NAME:FACES";

// Both throw BadInput with one line that says what is wrong. Polygons of more than three vertices
// are cut from their first.
TriangleMesh LoadMesh(const std::string& word);
// 12 numbers, the rows of [R | t]; none: the identity.
RelativePose ParsePose(const std::vector<std::string>& words);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_MESH_ARGUMENTS_H_
