// SPDX-License-Identifier: MIT
//
//   paper            here              meaning
//   ∂M               PhongSurface      a triangulated surface with normals at its vertices
//   q_1, q_2, q_3    vertices          of a triangle
//   λ                PhongPoint::at    barycentric coordinates
//   Ψ(λ)             TangentBasis      the interpolated tangent plane (tangent_basis.h)
//   o                the origin
#ifndef TOUCHSTONE_CORE_CPD_PHONG_PROJECTION_H_
#define TOUCHSTONE_CORE_CPD_PHONG_PROJECTION_H_

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "touchstone/core/cpd/tangent_basis.h"

namespace touchstone {

// A view of a surface: triangles counterclockwise seen from outside.
struct PhongSurface {
  std::span<const Eigen::Vector3d> vertices;
  std::span<const std::array<int, 3>> triangles;
  // neighbors[t][k] across the side from corner k to k + 1; -1: none.
  std::span<const std::array<int, 3>> neighbors;
  std::span<const Eigen::Vector3d> normals;  // of vertices, of unit length
};

struct PhongOptions {
  PhongInterpolation interpolation = PhongInterpolation::kTangentBasis;
  // Newton from the barycentre, as in the paper; or every solution, by a subdivision of the
  // triangle that shows of each part that it holds none or one.
  bool find_all = false;
  // Where Newton begins first, if not all are looked for.
  std::optional<Eigen::Vector3d> begin_at = std::nullopt;
  int newton_limit = 20;
};

// A Phong projection of the origin: λ >= 0, and q orthogonal to the tangent plane there, outward.
struct PhongPoint {
  int triangle = -1;
  Eigen::Vector3d at;        // λ, adds up to one
  Eigen::Vector3d position;  // q
  // |Ψ(λ) q| / |q| for a basis of two orthonormal rows: the sine of the angle between q and the
  // normal.
  double residual = 0.0;
  // The rate of q with a motion of the origin, 3 x 3; of a simple solution.
  std::optional<Eigen::Matrix3d> rate;
  // 1: simple. 2: two meet there, up to 2^-20 of the triangle, which are told as one. 0: not told:
  // more meet, or it is at a corner, where Ψ has no derivative.
  int multiplicity = 1;
  // Of a simple one, the sense of the map from the origin to q, along the plane: 1 where it is
  // kept, as by the foot on a plane, -1 where it is turned over. Two that meet and vanish have
  // opposite ones. 0 where it is not told.
  int index = 0;
};

struct PhongCount {
  int points = 0;  // appended
  // Proven: every solution on the triangle, with λ >= -1e-9, is one of these. The proof is about
  // Ψ as its rows at corners are in doubles, and bounds all roundings from there on. Where it fails
  // (solutions that meet, or a curve of them) other starts of Newton's are tried too.
  bool is_complete = false;
};

// Appends the Phong projections of the origin onto one triangle. Complexity: O(1). No errors;
// needles and vanishing normals have none.
PhongCount ProjectOntoTriangle(const PhongSurface& surface, int triangle,
                               const PhongOptions& options, std::vector<PhongPoint>* points);

// The sine of the angle between the barycentre, seen from the origin, and the normal there: how
// nearly a triangle without a solution has one. The argmin of Algorithm 2, made a number.
double MisfitAtBarycentre(const PhongSurface& surface, int triangle,
                          PhongInterpolation interpolation);

// The largest angle between the normals at two corners of a triangle, in radians.
double CornerAngle(const PhongSurface& surface, int triangle);

// Breadth-first from a triangle across sides until one has a projection: that one's. Or nothing.
std::vector<PhongPoint> ProjectByBreadthFirst(const PhongSurface& surface, int from,
                                              const PhongOptions& options);

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_CPD_PHONG_PROJECTION_H_
