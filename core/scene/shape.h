// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_SCENE_SHAPE_H_
#define TOUCHSTONE_CORE_SCENE_SHAPE_H_

#include <Eigen/Core>
#include <array>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "touchstone/core/base/status.h"
#include "touchstone/core/convex/convex_polyhedron.h"
#include "touchstone/core/cpd/contact_body.h"
#include "touchstone/core/mesh/box_tree.h"
#include "touchstone/core/mesh/triangle_mesh.h"

namespace touchstone {

// One solid of a shape, in the body's frame: a convex body or a closed mesh, with bounds that hold
// in any rounding mode.
class ScenePart {
 public:
  explicit ScenePart(ConvexPolyhedron convex);
  explicit ScenePart(TriangleMesh mesh);
  ScenePart(const ScenePart&) = delete;
  ScenePart& operator=(const ScenePart&) = delete;

  bool is_convex() const { return convex_.has_value(); }
  // Requires is_convex().
  const ConvexPolyhedron& convex() const { return *convex_; }
  // The mesh; of a convex body its surface cut into triangles, made when first asked for. Any
  // number of threads may ask.
  const TriangleMesh& mesh() const;

  // What mesh() contributes to depths, made when first asked for; the same.
  const ContactBody& contact_body() const;

  // A point, inside where the part is convex, with a ball around it that holds the part and one
  // that the part holds (radius zero for meshes).
  const Eigen::Vector3d& middle() const { return middle_; }
  double outer_radius() const { return outer_radius_; }
  double inner_radius() const { return inner_radius_; }
  // max over vertices of the largest absolute coordinate.
  double max_coordinate() const { return max_coordinate_; }
  const Box3& box() const { return box_; }

  // Of each component of mesh(), in order: the vertices furthest along ±x, ±y, ±z.
  std::span<const std::array<int, 6>> extreme_vertices() const;

 private:
  struct Surface {
    TriangleMesh mesh;
    std::vector<std::array<int, 6>> extreme_vertices;
  };

  const Surface& surface() const;
  void Bound(std::span<const Eigen::Vector3d> vertices);

  std::optional<ConvexPolyhedron> convex_;
  Eigen::Vector3d middle_ = Eigen::Vector3d::Zero();
  double outer_radius_ = 0.0, inner_radius_ = 0.0, max_coordinate_ = 0.0;
  Box3 box_{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  mutable std::once_flag surface_made_;
  mutable std::optional<Surface> surface_;
  mutable std::once_flag contact_body_made_;
  mutable std::optional<ContactBody> contact_body_;
};

// What a body of a scene is: a convex body, the union of several (a compound), or a closed mesh.
// Immutable; a copy shares the data, and any number of bodies may have the same shape.
class SceneShape {
 public:
  // Complexity of all: O(n).
  static SceneShape Convex(const ConvexPolyhedron& body);
  static SceneShape Mesh(const TriangleMesh& mesh);
  // Parts may overlap each other. An error: kTooFewFaces if there are none.
  static StatusOr<SceneShape> Compound(std::span<const ConvexPolyhedron> parts);

  int part_count() const { return static_cast<int>(parts_->size()); }
  const ScenePart& part(int i) const { return *(*parts_)[i]; }

 private:
  using Parts = std::vector<std::unique_ptr<const ScenePart>>;
  explicit SceneShape(Parts parts) : parts_(std::make_shared<const Parts>(std::move(parts))) {}

  std::shared_ptr<const Parts> parts_;
};

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_SCENE_SHAPE_H_
