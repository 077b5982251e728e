// SPDX-License-Identifier: MIT
#include "touchstone/core/mesh/crossing_prism.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace touchstone {
namespace {

using Eigen::Vector3d;

constexpr double kUnderflow = 0x1p-1000;
// Of coordinates from 1/2 to 1: a normal less certain than this tells nothing.
constexpr double kWorstNormal = 0x1p-16;

double MaxAbs(const Vector3d& v) { return v.cwiseAbs().maxCoeff(); }

// Bounds the error of a difference of points, in doubles, of two bodies or of one.
double DifferenceError(double error_a, double error_b) {
  return 1.01 * (2.0 * std::max(error_a, error_b) + 4.0 * kUnit) + kUnderflow;
}

}  // namespace

bool CrossingPrism::Set(int k, const Vector3d& normal, double error, double side,
                        const Vector3d& at) {
  const double size = MaxAbs(normal);
  if (!(size > 0.0 && error < kWorstNormal * size)) return false;
  int exponent = 0;
  std::frexp(size, &exponent);
  normals_[k] = std::ldexp(1.0, -exponent) * normal;
  heights_[k] = normals_[k].dot(at);
  normal_error_ = std::max(normal_error_, std::ldexp(error, -exponent));
  turns_move_ = std::max(turns_move_, std::ldexp(4.1 * side, -exponent));
  return true;
}

// The edge from p along u, the face's corners r_j, its sides v_j, its normal N outward. Where the
// line crosses the face upward, N . u > 0, it passes the sides with (u x v_j) . (r_j - p) < 0; the
// ends lie on either side. Downward all signs turn.
bool CrossingPrism::Make(const MeshPair& pair, const Crossing& crossing) {
  const PlacedMesh& of_edge = crossing.edge_is_of_a ? pair.a() : pair.b();
  const PlacedMesh& of_face = crossing.edge_is_of_a ? pair.b() : pair.a();
  crossing_ = {};
  error_a_ = pair.a().point_error;
  error_b_ = pair.b().point_error;
  side_ = crossing.half_edge % 3;
  const Triangle& edge_face = of_edge.mesh.face(TriangleMesh::face_of(crossing.half_edge));
  points_[0] = of_edge.points[edge_face[side_]];
  points_[1] = of_edge.points[edge_face[side_ == 2 ? 0 : side_ + 1]];
  for (int k = 0; k < 3; ++k) points_[2 + k] = of_face.points[of_face.mesh.face(crossing.face)[k]];
  const Vector3d &p = points_[0], &q = points_[1];
  const Vector3d* r = points_ + 2;

  const double e = difference_error_ = DifferenceError(error_a_, error_b_);
  const FacePlane& plane = of_face.planes[crossing.face];
  const Vector3d u = q - p;
  const int way = TriageSign(HeightAlong(plane.normal, plane.error, u, e));
  if (way == 0) return false;
  normal_error_ = turns_move_ = 0.0;
  if (!Set(0, way * plane.normal, plane.error, 0.0, p - r[0]) ||
      !Set(1, -way * plane.normal, plane.error, 0.0, q - r[0])) {
    return false;
  }
  for (int j = 0; j < 3; ++j) {
    const Vector3d v = r[(j + 1) % 3] - r[j];
    const double lu = MaxAbs(u), lv = MaxAbs(v);
    // Two roundings on each of two paths, and the data: as for a face's normal.
    const double error =
        1.01 * (4.1 * kUnit * lu * lv + 2.0 * (lu * e + lv * e + e * e)) + kUnderflow;
    if (!Set(2 + j, -way * u.cross(v), error, std::max(lu, lv), p - r[j])) return false;
  }
  crossing_ = crossing;
  return true;
}

bool CrossingPrism::IsOf(const MeshPair& pair) const {
  const PlacedMesh& of_edge = crossing_.edge_is_of_a ? pair.a() : pair.b();
  const PlacedMesh& of_face = crossing_.edge_is_of_a ? pair.b() : pair.a();
  if (crossing_.face < 0 || crossing_.face >= of_face.mesh.face_count() ||
      crossing_.half_edge >= of_edge.mesh.half_edge_count() || error_a_ != pair.a().point_error ||
      error_b_ != pair.b().point_error) {
    return false;
  }
  const Triangle& edge_face = of_edge.mesh.face(TriangleMesh::face_of(crossing_.half_edge));
  const Triangle& face = of_face.mesh.face(crossing_.face);
  return of_edge.points[edge_face[side_]] == points_[0] &&
         of_edge.points[edge_face[side_ == 2 ? 0 : side_ + 1]] == points_[1] &&
         of_face.points[face[0]] == points_[2] && of_face.points[face[1]] == points_[3] &&
         of_face.points[face[2]] == points_[4];
}

// n . y - c, where n is off by e_n at most and the point c was taken at, of coordinates below 2, by
// e; y by its own error. So it is off by 3 e + e_n (|y| + 6 + 3 e) from the data, with the sum of
// coordinates for |y|; each dot product by 3.01 units of |y| or 6, the difference by one more.
//
// The two triangles compared have the same five signs to find. There the sides of B are taken where
// B was moved to: a side's normal is off by as much more as turns_move_ tells. With that the bounds
// there are at most twice these; what is above five times the bound here is four times above it
// exactly, so above the other's bound by more than its error.
bool CrossingPrism::Holds(const MeshPair& pair, const Translation& x) const {
  const double scale = crossing_.edge_is_of_a ? pair.scale() : -pair.scale();
  const Vector3d y = scale * x.value;
  const double length = y.cwiseAbs().sum();
  const double moved = 1.01 * pair.scale() * x.error + 2.1 * kUnit * length;
  const double e = difference_error_ + moved;
  const double normal_error = normal_error_ + turns_move_ * moved;
  const double error = 1.01 * (3.0 * e + (normal_error + 5.1 * kUnit) * (length + 6.0 + 3.0 * e));
  // No branch between the planes: a warm question is all about these.
  const auto above = [&](int k) -> int { return normals_[k].dot(y) - heights_[k] > 5.0 * error; };
  return (above(0) & above(1) & above(2) & above(3) & above(4)) != 0;
}

}  // namespace touchstone
