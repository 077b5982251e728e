// SPDX-License-Identifier: MIT
#include "touchstone/core/mesh/mesh_pair.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace touchstone {
namespace {

using Eigen::Vector3d;

// A row of R has length at most 1 + 1e-6, so |(R x)_i| <= (1 + 1e-6) sqrt(3) max |x_j| < 1.75 max.
constexpr double kRowFactor = 1.75;
constexpr double kUnderflow = 0x1p-1000;

double MaxAbs(const Vector3d& v) { return v.cwiseAbs().maxCoeff(); }

// For each leaf the mean of its faces' normals, or that of the face in lane `lane`.
void FindNormals(const BoxTree& tree, std::span<const FacePlane> planes, std::optional<int> lane,
                 std::span<Vector3d> normals) {
  for (const BoxNode& node : tree.nodes()) {
    if (node.leaf < 0) continue;
    Vector3d& normal = normals[node.leaf];
    normal.setZero();
    for (int i = 0; i < node.lane_count; ++i) {
      if (!lane || i == *lane) normal += planes[~node.children[i]].normal;
    }
    normal.normalize();
  }
}

// Of these normals the ones across which the leaves' slabs are thinnest, which are set. Requires
// lanes whose corners are set.
void FindThinSlabs(const BoxTree& tree, std::span<const FacePlane> planes,
                   std::span<FaceLanes> leaves, std::vector<Vector3d>* directions) {
  directions->resize(leaves.size());
  FindNormals(tree, planes, std::nullopt, *directions);
  FindSlabs(*directions, leaves);
  std::vector<double> thickness(leaves.size());
  for (std::size_t l = 0; l < leaves.size(); ++l) thickness[l] = leaves[l].high - leaves[l].low;
  std::vector<Vector3d> normals(leaves.size());
  for (int lane = 0; lane < kTreeWidth; ++lane) {
    FindNormals(tree, planes, lane, normals);
    FindSlabs(normals, leaves);
    for (std::size_t l = 0; l < leaves.size(); ++l) {
      // Nothing is across a normal of no length.
      if (!(leaves[l].length > 0.5) || !(leaves[l].high - leaves[l].low < thickness[l])) continue;
      thickness[l] = leaves[l].high - leaves[l].low;
      (*directions)[l] = normals[l];
    }
  }
  FindSlabs(*directions, leaves);
}

}  // namespace

MeshPair::MeshPair(TriangleMesh a, TriangleMesh b, const RelativePose& pose)
    : a_{std::move(a), {}, 0.0, {}, {}, {}}, b_{std::move(b), {}, 0.0, {}, {}, {}} {
  for (PlacedMesh* placed : {&a_, &b_}) {
    placed->tree = placed->mesh.box_tree();
    placed->leaves.resize(placed->tree.leaf_count());
  }
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
    FindPlanes(a_.mesh, &a_.planes);
    for (FacePlane& plane : a_.planes) plane.height = plane.normal.dot(a_.points[plane.vertex]);
    a_.tree.Fit(a_.points, a_.mesh.faces(), a_.leaves);
    FindPlanes(b_.mesh, &own_planes_of_b_);
    if (is_new) {
      FindDirections();
    } else {
      FindSlabs(directions_of_a_, a_.leaves);
    }
  }
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
  PlacePlanesOfB();
  PlaceTreeOfB();
}

// Across which slabs are thin does not depend on the scale.
void MeshPair::FindDirections() {
  FindThinSlabs(a_.tree, a_.planes, a_.leaves, &directions_of_a_);
  b_.points.resize(b_.mesh.vertex_count());
  for (int v = 0; v < b_.mesh.vertex_count(); ++v) b_.points[v] = scale_ * b_.mesh.vertex(v);
  b_.tree.Fit(b_.points, b_.mesh.faces(), b_.leaves);
  FindThinSlabs(b_.tree, own_planes_of_b_, b_.leaves, &own_directions_of_b_);
}

void MeshPair::PlaceTreeOfB() {
  b_.tree.Fit(b_.points, b_.mesh.faces(), b_.leaves);
  const Eigen::Matrix3d& rotation = pose_.rotation();
  directions_of_b_.resize(own_directions_of_b_.size());
  for (std::size_t l = 0; l < directions_of_b_.size(); ++l) {
    const Vector3d& n = own_directions_of_b_[l];
    directions_of_b_[l] = n[0] * rotation.col(0) + n[1] * rotation.col(1) + n[2] * rotation.col(2);
  }
  FindSlabs(directions_of_b_, b_.leaves);
}

// In the mesh's own frame, scaled; leaves out heights.
void MeshPair::FindPlanes(const TriangleMesh& mesh, std::vector<FacePlane>* planes) const {
  planes->resize(mesh.face_count());
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
    const Vector3d& u = sides[(k + 2) % 3];
    const Vector3d& v = sides[(k + 1) % 3];  // runs to vertex k, and so does the negative of u
    const double lu = MaxAbs(u), lv = MaxAbs(v);
    // Rounded once; differences of doubles underflow exactly or not at all.
    const double u_error = 1.01 * kUnit * lu + kUnderflow, v_error = 1.01 * kUnit * lv + kUnderflow;
    FacePlane& plane = (*planes)[f];
    plane.vertex = face[k];
    plane.normal = v.cross(u);
    plane.length = plane.normal.cwiseAbs().sum();
    // A coordinate is u_i v_j - u_j v_i: two roundings on each path, 2.01 units of the absolute
    // terms, at most 2 |u||v|; errors of u and v add 2 (|u| e_v + |v| e_u + e_u e_v).
    plane.error =
        1.01 * (4.1 * kUnit * lu * lv + 2.0 * (lu * v_error + lv * u_error + u_error * v_error)) +
        kUnderflow;
  }
}

// R may be off orthonormal: (R v) x (R u) = cof(R) (v x u). An entry of cof(R) is a difference of
// two products of entries of R, which are at most 1 + 1e-6: two roundings on each path, 4.1 units,
// and 4.1 e + 2.1 e² by their errors e. Its rows are cross products of rows of R, of length at most
// 1 + 3e-6, so the sum of a row's absolute values is below 1.75, and no entry above 1.01. With L
// the sum of the absolute coordinates of a normal, each off by e_n, its image passes three
// roundings on each path, 3.01 units of 1.01 L; the data add 1.75 e_n + e_cof (L + 3 e_n).
void MeshPair::PlacePlanesOfB() {
  const Eigen::Matrix3d& rotation = pose_.rotation();
  Eigen::Matrix3d cofactors;
  for (int i = 0; i < 3; ++i) {
    cofactors.row(i) = rotation.row((i + 1) % 3).cross(rotation.row((i + 2) % 3));
  }
  const double e = pose_.rotation_error();
  const double cofactor_error = 1.01 * (4.1 * kUnit + 4.1 * e + 2.1 * e * e);
  const double per_length = 1.01 * (3.1 * kUnit + cofactor_error);
  const double per_error = 1.01 * (1.75 + 3.0 * cofactor_error);
  const std::size_t count = own_planes_of_b_.size();
  b_.planes.resize(count);
  for (std::size_t f = 0; f < count; ++f) {
    const FacePlane& own = own_planes_of_b_[f];
    FacePlane& plane = b_.planes[f];
    plane.vertex = own.vertex;
    plane.normal.noalias() = cofactors * own.normal;
    plane.height = plane.normal.dot(b_.points[own.vertex]);
    plane.length = plane.normal.cwiseAbs().sum();
    plane.error = per_length * own.length + per_error * own.error + kUnderflow;
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
