// SPDX-License-Identifier: MIT
//
// Any numbers and any indices as a body and as a mesh: a status, or something valid.
#include <cstdint>
#include <vector>

#include "touchstone/core/convex/convex_polyhedron.h"
#include "touchstone/core/mesh/triangle_mesh.h"
#include "touchstone/tests/fuzz/bytes.h"

namespace touchstone {
namespace {

void TryBuilders(Bytes bytes) {
  std::vector<Eigen::Vector3d> vertices(static_cast<std::size_t>(bytes.Below(24)));
  for (Eigen::Vector3d& v : vertices) v = bytes.Point();
  std::vector<std::vector<int>> faces(static_cast<std::size_t>(bytes.Below(48)));
  for (std::vector<int>& face : faces) {
    // Mostly triangles, and indices mostly in range.
    const int corners = bytes.Below(8) == 0 ? bytes.Below(12) : 3;
    for (int k = 0; k < corners; ++k)
      face.push_back(static_cast<int>(bytes.Byte()) - (bytes.Below(64) == 0 ? 128 : 0));
  }
  const StatusOr<ConvexPolyhedron> body = ConvexPolyhedron::Build(vertices, faces);
  if (body.ok()) Require(body->FindValidationError().ok(), "a built body is valid");
  std::vector<std::array<int, 3>> triangles;
  for (const std::vector<int>& face : faces) {
    if (face.size() == 3) triangles.push_back({face[0], face[1], face[2]});
  }
  const StatusOr<TriangleMesh> mesh = TriangleMesh::Build(vertices, triangles);
  if (mesh.ok()) Require(mesh->FindValidationError().ok(), "a built mesh is valid");
}

}  // namespace
}  // namespace touchstone

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  touchstone::TryBuilders(touchstone::Bytes(data, size));
  return 0;
}
