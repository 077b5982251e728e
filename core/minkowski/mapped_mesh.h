// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_MINKOWSKI_MAPPED_MESH_H_
#define TOUCHSTONE_CORE_MINKOWSKI_MAPPED_MESH_H_

#include <Eigen/Core>
#include <vector>

#include "touchstone/core/mesh/triangle_mesh.h"
#include "touchstone/core/minkowski/convex_map.h"
#include "touchstone/core/minkowski/gauss_map.h"

namespace touchstone {

// A mesh with its Gauss map and its convex map, C(A) of the paper: what a dynamic convolution needs
// of each body, whatever the pose. Made once for a mesh; a copy is cheap.
struct MappedMesh {
  explicit MappedMesh(const TriangleMesh& mesh);

  TriangleMesh mesh;
  GaussMap gauss_map;
  ConvexMap convex_map;               // conforming, of convex arcs
  std::vector<int> special_vertices;  // of kind kSpecial
  // Unit vectors, each coordinate within 2^-51: by edge, as its half-edge runs; and from each
  // vertex to the neighbours that bound its cone.
  std::vector<Eigen::Vector3d> along, cone_sides;
  std::vector<int> cone_begin;
};

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_MINKOWSKI_MAPPED_MESH_H_
