// SPDX-License-Identifier: MIT
#include "touchstone/core/mesh/triangle_mesh.h"

#include <cmath>
#include <string>
#include <vector>

#include "touchstone/core/base/orientation.h"

namespace touchstone {
namespace {

Status Fail(StatusCode code, ElementKind kind, int index, const std::string& what) {
  return {code, kind, index, -1, std::string(ToString(kind)) + ' ' + std::to_string(index) + what};
}

// Twins run opposite ways and share an edge, whose kind is the exact one.
Status CheckEdges(const TriangleMesh& mesh, const Orientation& orientation) {
  for (int h = 0; h < mesh.half_edge_count(); ++h) {
    const int twin = mesh.twin(h);
    if (mesh.twin(twin) != h || mesh.tail(twin) != mesh.head(h) ||
        mesh.head(twin) != mesh.tail(h) || mesh.edge_of(h) != mesh.edge_of(twin)) {
      return Fail(StatusCode::kNonManifold, ElementKind::kEdge, h, ": its half-edges disagree");
    }
    const int side = orientation.ExactSide(mesh.face(mesh.face_of(h)), mesh.apex(twin));
    const EdgeKind kind = side < 0   ? EdgeKind::kConvex
                          : side > 0 ? EdgeKind::kReflex
                                     : EdgeKind::kFlat;
    const bool same_facet =
        mesh.facet_of_face(mesh.face_of(h)) == mesh.facet_of_face(mesh.face_of(twin));
    if (mesh.edge_kind(mesh.edge_of(h)) != kind || (kind == EdgeKind::kFlat && !same_facet)) {
      return Fail(StatusCode::kFolded, ElementKind::kEdge, mesh.edge_of(h), ": its kind is wrong");
    }
  }
  return {};
}

// The half-edges listed at v leave v, in order, and all do.
Status CheckRings(const TriangleMesh& mesh) {
  std::size_t total = 0;
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    const auto ring = mesh.vertex_half_edges(v);
    total += ring.size();
    for (std::size_t k = 0; k < ring.size(); ++k) {
      if (mesh.tail(ring[k]) != v ||
          mesh.twin(mesh.previous(ring[k])) != ring[(k + 1) % ring.size()]) {
        return Fail(StatusCode::kNonManifold, ElementKind::kVertex, v, ": its lists disagree");
      }
    }
  }
  if (total != static_cast<std::size_t>(mesh.half_edge_count())) {
    return Fail(StatusCode::kNonManifold, ElementKind::kNone, -1, ": half-edges are missing");
  }
  return {};
}

Status CheckComponents(const TriangleMesh& mesh) {
  int vertices = 0, edges = 0, faces = 0;
  for (const MeshComponent& component : mesh.components()) {
    vertices += component.vertex_count;
    edges += component.edge_count;
    faces += component.face_count;
    if (component.euler_characteristic() % 2 != 0 || component.genus() < 0) {
      return Fail(StatusCode::kNonManifold, ElementKind::kFace, component.first_face,
                  ": its component is no closed surface");
    }
  }
  if (vertices != mesh.vertex_count() || edges != mesh.edge_count() || faces != mesh.face_count()) {
    return Fail(StatusCode::kNonManifold, ElementKind::kNone, -1, ": components disagree");
  }
  for (int h = 0; h < mesh.half_edge_count(); ++h) {
    if (mesh.component_of_face(mesh.face_of(h)) !=
        mesh.component_of_face(mesh.face_of(mesh.twin(h)))) {
      return Fail(StatusCode::kNonManifold, ElementKind::kFace, mesh.face_of(h),
                  ": its component ends");
    }
  }
  return {};
}

}  // namespace

std::string_view ToString(EdgeKind kind) {
  switch (kind) {
    case EdgeKind::kConvex:
      return "convex";
    case EdgeKind::kFlat:
      return "flat";
    case EdgeKind::kReflex:
      return "reflex";
  }
  return "?";
}

Status TriangleMesh::FindValidationError() const {
  const Orientation orientation(data_->vertices, data_->max_coordinate);
  if (Status status = CheckEdges(*this, orientation); !status.ok()) return status;
  if (Status status = CheckRings(*this); !status.ok()) return status;
  if (Status status = CheckComponents(*this); !status.ok()) return status;
  for (int f = 0; f < face_count(); ++f) {
    if (std::abs(face_normal(f).norm() - 1.0) > 1e-15) {
      return Fail(StatusCode::kDegenerateFace, ElementKind::kFace, f, ": its normal is not a unit");
    }
  }
  return {};
}

}  // namespace touchstone
