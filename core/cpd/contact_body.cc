// SPDX-License-Identifier: MIT
#include "touchstone/core/cpd/contact_body.h"

#include <Eigen/Core>
#include <utility>

namespace touchstone {
namespace {

using Eigen::Vector3d;

// Whether the solid near v, moved along some direction, stays within itself: one that no face there
// looks along. Such a vertex never locks, as the body can back out that way from whatever it only
// touches there. Sought by steps away from the face that looks along it most (the perceptron),
// which finds it if there is one that looks away from all by a sine of 0.01.
bool CanBackOut(const TriangleMesh& mesh, int v) {
  constexpr int kMostSteps = 10'000;
  constexpr double kHair = 1e-9;  // above the roundings of normals and of the product
  Vector3d way = Vector3d::Zero();
  for (const int h : mesh.vertex_half_edges(v)) way -= mesh.face_normal(TriangleMesh::face_of(h));
  for (int step = 0; step < kMostSteps; ++step) {
    Vector3d worst = Vector3d::Zero();
    double most = -1e300;
    for (const int h : mesh.vertex_half_edges(v)) {
      const Vector3d& normal = mesh.face_normal(TriangleMesh::face_of(h));
      if (normal.dot(way) > most) most = normal.dot(way), worst = normal;
    }
    if (most < -kHair * way.norm()) return true;
    way -= worst;
  }
  return false;
}

FeatureTree LockingTree(const TriangleMesh& mesh) {
  std::vector<FeatureBound> bounds(mesh.vertex_count());
  std::vector<int> items;
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    if (CanBackOut(mesh, v)) continue;
    bounds[v].centre = mesh.vertex(v);
    items.push_back(v);
  }
  return FeatureTree(bounds, std::move(items));
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
            LockingTree(mesh)};
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
