// SPDX-License-Identifier: MIT
#include "touchstone/core/scene/shape.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>
#include <utility>

#include "touchstone/core/scene/surface_internal.h"

namespace touchstone {
namespace {

using Eigen::Vector3d;

constexpr double kUp = 1.0 + 0x1p-46;  // more than a handful of roundings in a row

// The radius of a ball around `middle` inside the body: the least height of a face's plane over it.
// The normal's coordinates are within 2^-46 of the exact ones, and the dot product adds 3.01
// roundings of 2^-52 each: together below 2^-45 |a - middle|_1.
double InnerRadius(const ConvexPolyhedron& body, const Vector3d& middle) {
  double least = HUGE_VAL;
  for (int f = 0; f < body.face_count(); ++f) {
    const Vector3d to_plane = body.vertex(body.face_plane(f)[0]) - middle;
    least = std::min(least, body.face_normal(f).dot(to_plane) - 0x1p-44 * to_plane.lpNorm<1>());
  }
  return std::max(0.0, least);
}

std::vector<std::array<int, 6>> ExtremeVertices(const TriangleMesh& mesh) {
  std::vector<std::array<int, 6>> extremes(mesh.components().size());
  for (std::size_t c = 0; c < extremes.size(); ++c) {
    extremes[c].fill(mesh.face(mesh.components()[c].first_face)[0]);
  }
  for (int f = 0; f < mesh.face_count(); ++f) {
    std::array<int, 6>& found = extremes[mesh.component_of_face(f)];
    for (const int v : mesh.face(f)) {
      for (int axis = 0; axis < 3; ++axis) {
        if (mesh.vertex(v)[axis] > mesh.vertex(found[2 * axis])[axis]) found[2 * axis] = v;
        if (mesh.vertex(v)[axis] < mesh.vertex(found[2 * axis + 1])[axis]) found[2 * axis + 1] = v;
      }
    }
  }
  return extremes;
}

}  // namespace

ScenePart::ScenePart(ConvexPolyhedron convex) : convex_(std::move(convex)) {
  Bound(convex_->vertices());
  middle_ = convex_->interior_point(0);
  outer_radius_ = convex_->bounding_ellipsoid().ball_radius;
  inner_radius_ = InnerRadius(*convex_, middle_);
}

ScenePart::ScenePart(TriangleMesh mesh) {
  Bound(mesh.vertices());
  std::call_once(surface_made_, [&] {
    auto extremes = ExtremeVertices(mesh);
    surface_.emplace(Surface{std::move(mesh), std::move(extremes)});
  });
}

void ScenePart::Bound(std::span<const Vector3d> vertices) {
  box_ = {vertices[0], vertices[0]};
  for (const Vector3d& v : vertices) {
    box_.low = box_.low.cwiseMin(v);
    box_.high = box_.high.cwiseMax(v);
    max_coordinate_ = std::max(max_coordinate_, v.cwiseAbs().maxCoeff());
  }
  middle_ = 0.5 * box_.low + 0.5 * box_.high;
  // Scaled, so that squares neither overflow nor underflow.
  double largest = 0.0;
  for (const Vector3d& v : vertices) {
    largest = std::max(largest, ((v - middle_) / max_coordinate_).squaredNorm());
  }
  outer_radius_ = kUp * max_coordinate_ * std::sqrt(largest);
}

const ScenePart::Surface& ScenePart::surface() const {
  std::call_once(surface_made_, [this] {
    auto built = TriangleMesh::Build(convex_->vertices(), internal::TrianglesOf(*convex_));
    assert(built.ok());  // what a convex body's own validation proved
    TriangleMesh mesh = *std::move(built);
    auto extremes = ExtremeVertices(mesh);
    surface_.emplace(Surface{std::move(mesh), std::move(extremes)});
  });
  return *surface_;
}

const TriangleMesh& ScenePart::mesh() const { return surface().mesh; }

const ContactBody& ScenePart::contact_body() const {
  std::call_once(contact_body_made_, [this] { contact_body_.emplace(mesh()); });
  return *contact_body_;
}

std::span<const std::array<int, 6>> ScenePart::extreme_vertices() const {
  return surface().extreme_vertices;
}

SceneShape SceneShape::Convex(const ConvexPolyhedron& body) {
  Parts parts;
  parts.push_back(std::make_unique<const ScenePart>(body));
  return SceneShape(std::move(parts));
}

SceneShape SceneShape::Mesh(const TriangleMesh& mesh) {
  Parts parts;
  parts.push_back(std::make_unique<const ScenePart>(mesh));
  return SceneShape(std::move(parts));
}

StatusOr<SceneShape> SceneShape::Compound(std::span<const ConvexPolyhedron> bodies) {
  if (bodies.empty()) {
    return Status{StatusCode::kTooFewFaces, ElementKind::kNone, -1, -1,
                  "a compound has one part at least"};
  }
  Parts parts;
  for (const ConvexPolyhedron& body : bodies) {
    parts.push_back(std::make_unique<const ScenePart>(body));
  }
  return SceneShape(std::move(parts));
}

}  // namespace touchstone
