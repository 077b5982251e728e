// SPDX-License-Identifier: MIT
#include "touchstone/core/convex/convex_polyhedron.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "touchstone/core/base/orientation.h"
#include "touchstone/core/convex/convexity_internal.h"
#include "touchstone/core/convex/interior_points_internal.h"

namespace touchstone {
namespace {

Status Fail(StatusCode code, ElementKind kind, int index, const std::string& what) {
  return {code, kind, index, -1, std::string(ToString(kind)) + ' ' + std::to_string(index) + what};
}

// Every face's edges join its vertices and know the face on the proper side.
Status CheckFaces(const ConvexPolyhedron& body) {
  std::vector<int> uses(body.edge_count(), 0);
  for (int f = 0; f < body.face_count(); ++f) {
    const auto loop = body.face(f);
    const auto edges = body.face_edges(f);
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const int v = loop[i], w = loop[(i + 1) % loop.size()];
      const Edge& edge = body.edge(edges[i]);
      const bool forward = edge.tail == v && edge.head == w && edge.left == f;
      const bool backward = edge.tail == w && edge.head == v && edge.right == f;
      if (!forward && !backward) {
        return Fail(StatusCode::kNonManifold, ElementKind::kFace, f, " and its edges disagree");
      }
      ++uses[edges[i]];
    }
  }
  for (int e = 0; e < body.edge_count(); ++e) {
    if (uses[e] != 2) {
      return Fail(StatusCode::kOpen, ElementKind::kEdge, body.edge(e).tail, " has not two faces");
    }
  }
  return {};
}

// The lists round every vertex run in step.
Status CheckRings(const ConvexPolyhedron& body) {
  std::size_t total = 0;
  for (int v = 0; v < body.vertex_count(); ++v) {
    const auto neighbors = body.vertex_neighbors(v);
    const auto edges = body.vertex_edges(v);
    const auto faces = body.vertex_faces(v);
    total += neighbors.size();
    for (std::size_t k = 0; k < neighbors.size(); ++k) {
      const Edge& edge = body.edge(edges[k]);
      const Edge& next = body.edge(edges[(k + 1) % neighbors.size()]);
      const bool out = edge.tail == v && edge.head == neighbors[k] && edge.left == faces[k];
      const bool in = edge.head == v && edge.tail == neighbors[k] && edge.right == faces[k];
      const int right_of_next = next.tail == v ? next.right : next.left;
      if ((!out && !in) || right_of_next != faces[k]) {
        return Fail(StatusCode::kNonManifold, ElementKind::kVertex, v, ": its lists disagree");
      }
    }
  }
  if (total != 2 * static_cast<std::size_t>(body.edge_count()) ||
      body.vertex_count() - body.edge_count() + body.face_count() != 2) {
    return Fail(StatusCode::kNonManifold, ElementKind::kNone, -1, ": not a sphere");
  }
  return {};
}

// Planes, bends at edges, facets and normals.
Status CheckPlanes(const ConvexPolyhedron& body, const Orientation& orientation) {
  for (int f = 0; f < body.face_count(); ++f) {
    const std::array<int, 3>& plane = body.face_plane(f);
    for (int v : body.face(f)) {
      if (v == plane[0] || v == plane[1] || v == plane[2]) continue;
      if (orientation.ExactSide(plane, v) != 0) {
        return Fail(StatusCode::kNonPlanarFace, ElementKind::kFace, f, " is not planar");
      }
    }
    if (std::abs(body.face_normal(f).norm() - 1.0) > 1e-15) {
      return Fail(StatusCode::kDegenerateFace, ElementKind::kFace, f, ": its normal is not a unit");
    }
  }
  for (int e = 0; e < body.edge_count(); ++e) {
    const Edge& edge = body.edge(e);
    int side = 0;
    for (int v : body.face_plane(edge.right)) {
      if (v == edge.tail || v == edge.head) continue;
      const int s = orientation.ExactSide(body.face_plane(edge.left), v);
      if (s > 0) return Fail(StatusCode::kNotConvex, ElementKind::kFace, edge.left, ": not convex");
      side = std::min(side, s);
    }
    if ((side == 0) != (body.facet_of_face(edge.left) == body.facet_of_face(edge.right))) {
      return Fail(StatusCode::kNotConvex, ElementKind::kEdge, edge.tail, ": facets disagree");
    }
  }
  return {};
}

}  // namespace

bool ConvexPolyhedron::is_corner(int v) const {
  int bends = 0;
  for (const int e : vertex_edges(v)) bends += is_bend(e);
  return bends >= 3;
}

Status ConvexPolyhedron::FindValidationError() const {
  if (Status status = CheckFaces(*this); !status.ok()) return status;
  if (Status status = CheckRings(*this); !status.ok()) return status;
  const Orientation orientation(data_->vertices, data_->max_coordinate);
  if (Status status = CheckPlanes(*this, orientation); !status.ok()) return status;
  for (int i = 0; i < 2; ++i) {
    if (!internal::IsStrictlyInside(orientation, *data_, interior_point(i))) {
      return Fail(StatusCode::kNoInteriorPoint, ElementKind::kNone, i, ": not inside");
    }
  }
  if (interior_point(0) == interior_point(1)) {
    return Fail(StatusCode::kNoInteriorPoint, ElementKind::kNone, 1, ": not distinct");
  }
  return internal::CheckSingleWinding(orientation, *data_, orientation.Scale(interior_point(0)));
}

}  // namespace touchstone
