// SPDX-License-Identifier: MIT
#include "touchstone/core/mesh/mesh_pair.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

namespace touchstone {
namespace {

using Eigen::Vector3d;

// A row of R has length at most 1 + 1e-6, so |(R x)_i| <= (1 + 1e-6) sqrt(3) max |x_j| < 1.75 max.
constexpr double kRowFactor = 1.75;
constexpr double kUnderflow = 0x1p-1000;

double MaxAbs(const Vector3d& v) { return v.cwiseAbs().maxCoeff(); }

}  // namespace

MeshPair::MeshPair(TriangleMesh a, TriangleMesh b, const RelativePose& pose)
    : a_{std::move(a), {}, 0.0, {}, {}}, b_{std::move(b), {}, 0.0, {}, {}} {
  a_.tree = a_.mesh.box_tree();
  b_.tree = b_.mesh.box_tree();
  Place(pose);
}

void MeshPair::Place(const RelativePose& pose) {
  const bool is_new = a_.points.empty();
  const double scale_before = scale_;
  pose_ = pose;
  const double size =
      a_.mesh.max_coordinate() + kRowFactor * b_.mesh.max_coordinate() + MaxAbs(pose.translation());
  int exponent = 0;
  std::frexp(size, &exponent);
  scale_ = std::ldexp(1.0, -exponent);

  if (is_new || scale_ != scale_before) {
    a_.points.resize(a_.mesh.vertex_count());
    for (int v = 0; v < a_.mesh.vertex_count(); ++v) a_.points[v] = scale_ * a_.mesh.vertex(v);
    a_.point_error = kUnderflow;
    a_.tree.Fit(a_.points, a_.mesh.faces());
    FindPlanes(&a_);
  }
  b_.points.resize(b_.mesh.vertex_count());
  const Vector3d translation = scale_ * pose.translation();
  for (int v = 0; v < b_.mesh.vertex_count(); ++v) {
    const Vector3d scaled = scale_ * b_.mesh.vertex(v);
    b_.points[v] = pose.rotation() * scaled + translation;
  }
  // Three products and three sums: each term passes at most four roundings, 4.01 units of the sum
  // of absolute terms, which is at most size * scale <= 1. The entries of a pose made from two
  // world poses add their own errors.
  b_.point_error = 4.1 * kUnit + kUnderflow +
                   scale_ * (3.01 * pose.rotation_error() * b_.mesh.max_coordinate() +
                             1.01 * pose.translation_error());
  b_.tree.Fit(b_.points, b_.mesh.faces());
  FindPlanes(&b_);
}

void MeshPair::FindPlanes(PlacedMesh* placed) const {
  const bool is_b = placed == &b_;
  const Eigen::Matrix3d rotation = is_b ? pose_.rotation() : Eigen::Matrix3d::Identity();
  const double rotation_error = is_b ? pose_.rotation_error() : 0.0;
  const TriangleMesh& mesh = placed->mesh;
  placed->planes.resize(mesh.face_count());
  for (int f = 0; f < mesh.face_count(); ++f) {
    // Begun opposite the longest side, where the sine of the angle is largest.
    const Triangle& face = mesh.face(f);
    Vector3d sides[3];  // side k is opposite vertex k
    double squared[3];
    for (int k = 0; k < 3; ++k) {
      sides[k] = scale_ * (mesh.vertex(face[(k + 2) % 3]) - mesh.vertex(face[(k + 1) % 3]));
      squared[k] = sides[k].squaredNorm();
    }
    const int k = static_cast<int>(std::max_element(squared, squared + 3) - squared);
    const Vector3d& in_u = sides[(k + 2) % 3];
    const Vector3d& in_v = sides[(k + 1) % 3];  // runs to vertex k: v is its negative
    const double u_max = MaxAbs(in_u), v_max = MaxAbs(in_v);
    const Vector3d u = is_b ? Vector3d(rotation * in_u) : in_u;
    const Vector3d v = is_b ? Vector3d(rotation * in_v) : in_v;
    // A difference is rounded once; the rotation adds four roundings of sums of at most 1.75 max,
    // and its own error. Differences of doubles underflow exactly or not at all.
    const double row = is_b ? 1.75 * 5.1 * kUnit + 3.01 * rotation_error : 1.01 * kUnit;
    const double u_error = row * u_max + kUnderflow, v_error = row * v_max + kUnderflow;
    const double lu = MaxAbs(u), lv = MaxAbs(v);
    FacePlane& plane = placed->planes[f];
    plane.vertex = face[k];
    plane.normal = v.cross(u);
    plane.height = plane.normal.dot(placed->points[plane.vertex]);
    plane.length = plane.normal.cwiseAbs().sum();
    // A coordinate is u_i v_j - u_j v_i: two roundings on each path, 2.01 units of the absolute
    // terms, at most 2 |u||v|; errors of u and v add 2 (|u| e_v + |v| e_u + e_u e_v).
    plane.error =
        1.01 * (4.1 * kUnit * lu * lv + 2.0 * (lu * v_error + lv * u_error + u_error * v_error)) +
        kUnderflow;
  }
}

// Three products and two sums are off by 3.01 units of the sum of absolute terms, below 3.1 max|n|
// sum|d|; the data add sum|n| e_d + e_n (sum|d| + 3 e_d).
Estimate HeightAlong(const Vector3d& normal, double normal_error, const Vector3d& difference,
                     double difference_error) {
  const double length = difference.cwiseAbs().sum();
  const double error = 1.01 * (normal.cwiseAbs().sum() * difference_error +
                               (3.1 * kUnit * MaxAbs(normal) + normal_error) * length +
                               3.0 * normal_error * difference_error) +
                       kUnderflow;
  return {normal.dot(difference), error};
}

const DyadicVector& ExactMeshPair::PointOfA(int v) {
  auto [place, added] = points_of_a_.try_emplace(v);
  if (added) place->second = pose_.FromP(ToDyadic(a_.vertex(v)));
  return place->second;
}

const DyadicVector& ExactMeshPair::PointOfB(int v) {
  auto [place, added] = points_of_b_.try_emplace(v);
  if (added) place->second = pose_.PointFromQ(ToDyadic(b_.vertex(v)));
  return place->second;
}

}  // namespace touchstone
