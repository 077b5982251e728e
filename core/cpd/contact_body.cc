// SPDX-License-Identifier: MIT
#include "touchstone/core/cpd/contact_body.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

namespace touchstone {
namespace {

using Eigen::Vector3d;

// Directions d and an angle such that the solid at v holds all directions within it of d: the
// middle of the faces' inward normals, and the least height of the link's sides over it. Nothing if
// the solid does not hold a cap there.
std::optional<NormalCone> ConeOfHollow(const TriangleMesh& mesh, int v) {
  Vector3d outward = Vector3d::Zero();
  for (const int h : mesh.vertex_half_edges(v)) {
    outward += mesh.face_normal(TriangleMesh::face_of(h));
  }
  if (!(outward.norm() > 1e-3)) return std::nullopt;
  outward.normalize();
  // The cap round -outward within which no side of the link comes: the angle to a side is at least
  // the smaller of those to its great circle and, past its ends, to these.
  double cosine = -1.0;  // of the angle from -outward to the nearest side
  for (const int h : mesh.vertex_half_edges(v)) {
    const Vector3d first = (mesh.vertex(mesh.head(h)) - mesh.vertex(v)).normalized();
    const Vector3d second = (mesh.vertex(mesh.apex(h)) - mesh.vertex(v)).normalized();
    cosine = std::max({cosine, -outward.dot(first), -outward.dot(second)});
    const Vector3d normal = first.cross(second);
    const double length = normal.norm();
    if (!(length > 1e-6)) return std::nullopt;
    const Vector3d foot = -outward + normal * (normal.dot(outward) / (length * length));
    const bool is_between =
        normal.dot(first.cross(foot)) >= 0.0 && normal.dot(foot.cross(second)) >= 0.0;
    if (is_between) cosine = std::max(cosine, foot.norm());
  }
  // The solid holds -outward iff the nearest side is seen from inside; there a face looks away.
  for (const int h : mesh.vertex_half_edges(v)) {
    if (mesh.face_normal(TriangleMesh::face_of(h)).dot(outward) <= 0.0) return std::nullopt;
  }
  // A cap of angle γ leaves to contacts what two of them do not cover: cones of π/2 - γ.
  return NormalCone{outward, std::sqrt(std::max(0.0, 1.0 - cosine * cosine))};
}

FeatureTree HollowTree(const TriangleMesh& mesh) {
  std::vector<FeatureBound> bounds(mesh.vertex_count());
  std::vector<int> items;
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    const auto ring = mesh.vertex_half_edges(v);
    const auto count = std::count_if(ring.begin(), ring.end(), [&](int h) {
      return mesh.edge_kind(mesh.edge_of(h)) == EdgeKind::kReflex;
    });
    if (count == 0) continue;
    bounds[v].centre = mesh.vertex(v);
    if (const auto cone = ConeOfHollow(mesh, v)) bounds[v].cone = *cone;
    items.push_back(v);
  }
  constexpr bool kHasNormals = false;
  return FeatureTree(bounds, std::move(items), kHasNormals);
}

}  // namespace

ContactBody::Data ContactBody::MakeData(const TriangleMesh& mesh) {
  const GaussMap map(mesh);
  Data data{mesh,
            map,
            {},
            InnerBalls(mesh),
            FaceTree(mesh),
            VertexTree(mesh, map),
            ConvexEdgeTree(mesh, map),
            HollowTree(mesh)};
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const int h = mesh.half_edge_of(e);
    data.edges.push_back({mesh.tail(h), mesh.head(h), TriangleMesh::face_of(h),
                          TriangleMesh::face_of(mesh.twin(h))});
  }
  return data;
}

ContactBody::ContactBody(const TriangleMesh& mesh)
    : data_(std::make_shared<const Data>(MakeData(mesh))) {}

}  // namespace touchstone
