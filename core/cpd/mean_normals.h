// SPDX-License-Identifier: MIT
//
//   design      here              meaning
//   h           radius            of the ball that the mean is taken over
//   K           1 - r^2 / h^2     its weight at distance r from the point, 0 beyond h
//   n(x)        MeanNormals::At   Σ_T n_T ∫_T K(|y - x|) dy over the surface's triangles T
//   o           the origin
#ifndef TOUCHSTONE_CORE_CPD_MEAN_NORMALS_H_
#define TOUCHSTONE_CORE_CPD_MEAN_NORMALS_H_

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "touchstone/core/cpd/phong_projection.h"

namespace touchstone {

// Normals averaged over the surface within a radius.
//
// By the divergence theorem n(x) is -∫ ∇_y K(|y - x|) dy over the solid: it depends on the solid
// alone and not on how its surface is cut into facets and triangles, and it changes by little when
// the solid does so in volume. Where a facet comes or goes, a slot closes or a corner splits in
// two, n(x) is continuous; so are its first derivatives with x in a plane.
class MeanNormals {
 public:
  // Takes the surface's triangles; its normals and neighbours have no say. Complexity: O(n).
  void Set(const PhongSurface& surface);

  // n(x), outward, over radius^2; zero where no triangle comes within the radius. The surface must
  // be whole there. Each integral is in closed form, good to some 1e-14 of radius^2.
  // Complexity: O(n), most of it one comparison a triangle.
  Eigen::Vector3d At(const Eigen::Vector3d& x, double radius) const;

 private:
  struct Placed {
    Eigen::Vector3d center;  // of a ball that holds the triangle
    double reach;
    Eigen::Vector3d normal;
    Eigen::Matrix<double, 2, 3> axes;        // of its plane
    std::array<Eigen::Vector2d, 3> corners;  // by them
  };
  std::vector<Placed> triangles_;
};

struct MeanProjectionOptions {
  double radius_ratio = 0.3;  // h over |q - o|
  double least_radius = 0.0;  // h is never below
  // The surface is whole in this ball: what needs more ends the search.
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double reach = 0.0;
  int step_limit = 60;
};

enum class MeanProjectionStatus : std::uint8_t {
  kFound,
  kLeft,     // it needs the surface beyond the ball, round `position`
  kNoFound,  // no solution within the steps; what came nearest
};

struct MeanProjection {
  MeanProjectionStatus status = MeanProjectionStatus::kNoFound;
  // As of a Phong projection: the sine of the angle between q and n(q), and the rate.
  PhongPoint point = {-1, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), 1.0, std::nullopt};
};

// From a point of the surface on to a q with q x n(q) = 0 that is a stable one: moved off it along
// the surface, the mean normal points the way back, as at the nearest point of a solid's surface.
// One on a triangle that faces inward, seen from o, is none: at a sharp crease the mean normal can
// be along q there, but the way out along q has left the solid before. The search goes on from
// where it last does, once.
//
// Steps are Newton's in the plane of a triangle, with differences for derivatives, no longer than a
// quarter of h, and put back on the nearest triangle; where Newton would lead to no stable
// solution, along the tangent part of q.
//
// Complexity: O(n) a step. No errors.
MeanProjection ProjectByMeanNormals(const PhongSurface& surface, const MeanNormals& normals,
                                    const Eigen::Vector3d& from,
                                    const MeanProjectionOptions& options);

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_CPD_MEAN_NORMALS_H_
