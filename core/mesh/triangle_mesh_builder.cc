// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cassert>
#include <memory>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "touchstone/core/base/orientation.h"
#include "touchstone/core/base/vertex_checks.h"
#include "touchstone/core/mesh/enclosure_internal.h"
#include "touchstone/core/mesh/half_edges_internal.h"
#include "touchstone/core/mesh/triangle_mesh.h"

namespace touchstone {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kMaxFaces = std::size_t{1} << 28;  // half-edges are int

Status CheckFaces(std::span<const Triangle> faces, int vertex_count) {
  if (faces.size() < 4) {
    return {StatusCode::kTooFewFaces, ElementKind::kNone, -1, -1,
            "a closed mesh has four faces at least, not " + std::to_string(faces.size())};
  }
  if (faces.size() > kMaxFaces) {
    return {StatusCode::kOutOfRange, ElementKind::kNone, -1, -1,
            "a mesh has 2^28 faces at most, not " + std::to_string(faces.size())};
  }
  std::vector<char> is_used(vertex_count, 0);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const int f = static_cast<int>(i);
    const std::string name = "face " + std::to_string(f);
    for (int k = 0; k < 3; ++k) {
      const int v = faces[i][k];
      if (v < 0 || v >= vertex_count) {
        return {
            StatusCode::kBadIndex, ElementKind::kFace, f, v,
            name + " names vertex " + std::to_string(v) + " of " + std::to_string(vertex_count)};
      }
      if (v == faces[i][(k + 1) % 3]) {
        return {StatusCode::kDegenerateFace, ElementKind::kFace, f, v,
                name + " names vertex " + std::to_string(v) + " twice"};
      }
      is_used[v] = 1;
    }
  }
  const auto unused = std::find(is_used.begin(), is_used.end(), 0);
  if (unused != is_used.end()) {
    const int v = static_cast<int>(unused - is_used.begin());
    return {StatusCode::kUnreferencedVertex, ElementKind::kVertex, v, -1,
            "no face uses vertex " + std::to_string(v)};
  }
  return {};
}

// The face's vertices, begun at the one opposite the longest side.
Triangle BeginAtWidestAngle(const Orientation& orientation, const Triangle& face) {
  int widest = 0;
  double longest = -1.0;
  for (int k = 0; k < 3; ++k) {
    const Vector3d side =
        orientation.point(face[(k + 2) % 3]).scaled - orientation.point(face[(k + 1) % 3]).scaled;
    const double squared = side.squaredNorm();
    if (squared > longest) longest = squared, widest = k;
  }
  return {face[widest], face[(widest + 1) % 3], face[(widest + 2) % 3]};
}

Status FindNormals(const Orientation& orientation, TriangleMeshData* data) {
  data->face_normals.reserve(data->faces.size());
  for (int f = 0; f < data->face_count(); ++f) {
    const Triangle& face = data->faces[f];
    if (orientation.IsCollinear(face[0], face[1], face[2])) {
      return {StatusCode::kDegenerateFace, ElementKind::kFace, f, -1,
              "the vertices of face " + std::to_string(f) + " are collinear"};
    }
    data->face_normals.push_back(orientation.UnitNormal(BeginAtWidestAngle(orientation, face)));
  }
  return {};
}

// Whether coplanar faces f and g have normals that point opposite ways, exactly.
bool IsFolded(const Orientation& orientation, const TriangleMeshData& data, int f, int g) {
  const auto turn = [&](int face, int axis) {
    const auto& [a, b, c] = data.faces[face];
    return orientation.ExactTurn(a, b, c, axis);
  };
  int axis = 0;
  while (turn(f, axis) == 0) ++axis;
  return turn(f, axis) != turn(g, axis);
}

Status FindEdgeKinds(const Orientation& orientation, TriangleMeshData* data) {
  data->edge_kinds.reserve(data->half_edge_of_edge.size());
  for (const int h : data->half_edge_of_edge) {
    const int g = data->twins[h] / 3;
    const int side = orientation.ExactSide(data->faces[h / 3], data->apex(data->twins[h]));
    if (side == 0 && IsFolded(orientation, *data, h / 3, g)) {
      return {StatusCode::kFolded, ElementKind::kEdge, data->tail(h), data->head(h),
              "faces " + std::to_string(h / 3) + " and " + std::to_string(g) +
                  " lie on top of each other at edge " + std::to_string(data->tail(h)) + "-" +
                  std::to_string(data->head(h))};
    }
    data->edge_kinds.push_back(side < 0   ? EdgeKind::kConvex
                               : side > 0 ? EdgeKind::kReflex
                                          : EdgeKind::kFlat);
  }
  return {};
}

// Disjoint sets of faces joined by flat edges, each named by its smallest member.
void FindFacets(TriangleMeshData* data) {
  std::vector<int>& parent = data->facet_of_face;
  parent.resize(data->faces.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto find = [&](int f) {
    while (parent[f] != f) f = parent[f] = parent[parent[f]];
    return f;
  };
  for (int e = 0; e < data->edge_count(); ++e) {
    if (data->edge_kinds[e] != EdgeKind::kFlat) continue;
    const int h = data->half_edge_of_edge[e];
    const auto [small, large] = std::minmax({find(h / 3), find(data->twins[h] / 3)});
    parent[large] = small;
  }
  for (int f = 0; f < data->face_count(); ++f) parent[f] = find(f);
}

}  // namespace

StatusOr<TriangleMesh> TriangleMesh::Build(std::span<const Vector3d> vertices,
                                           std::span<const Triangle> faces) {
  if (Status status = CheckVertices(vertices); !status.ok()) return status;
  const int vertex_count = static_cast<int>(vertices.size());
  if (Status status = CheckFaces(faces, vertex_count); !status.ok()) return status;
  if (Status status = CheckDistinct(vertices); !status.ok()) return status;

  auto data = std::make_shared<TriangleMeshData>();
  data->vertices.assign(vertices.begin(), vertices.end());
  data->faces.assign(faces.begin(), faces.end());
  for (const Vector3d& vertex : vertices) {
    data->max_coordinate = std::max(data->max_coordinate, vertex.cwiseAbs().maxCoeff());
  }
  if (Status status = internal::BuildHalfEdges(data.get()); !status.ok()) return status;
  const Orientation orientation(data->vertices, data->max_coordinate);
  if (Status status = FindNormals(orientation, data.get()); !status.ok()) return status;
  if (Status status = FindEdgeKinds(orientation, data.get()); !status.ok()) return status;
  FindFacets(data.get());
  if (Status status = internal::CheckEnclosure(orientation, data.get()); !status.ok()) {
    return status;
  }
  data->box_tree = BoxTree(data->vertices, data->faces);
  TriangleMesh mesh(std::move(data));
  assert(mesh.FindValidationError().ok());
  return mesh;
}

}  // namespace touchstone
