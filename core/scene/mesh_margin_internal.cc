// SPDX-License-Identifier: MIT
#include "touchstone/core/scene/mesh_margin_internal.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "touchstone/core/mesh/nearest_points.h"
#include "touchstone/core/mesh/tree_items.h"

namespace touchstone::internal {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kUnit = 0x1p-52;
constexpr double kUp = 1.0 + 0x1p-46;
constexpr double kDown = 1.0 - 0x1p-46;
constexpr double kLeastSize = 0x1p-200, kLargestSize = 0x1p200;
constexpr int kMostNodes = 1 << 14;  // pairs of nodes opened, as many as a full placing costs

double MaxAbs(const Vector3d& v) { return v.cwiseAbs().maxCoeff(); }

double BoxesApart(const Vector3d& low_a, const Vector3d& high_a, const Vector3d& low_b,
                  const Vector3d& high_b) {
  double squared = 0.0;
  for (int i = 0; i < 3; ++i) {
    const double gap = std::max({0.0, low_b[i] - high_a[i], low_a[i] - high_b[i]});
    squared += gap * gap;
  }
  return std::sqrt(squared);
}

int ItemsOf(const TriangleMesh& mesh, int code, TreeItem items[kTreeWidth]) {
  return touchstone::ItemsOf(mesh.box_tree(), mesh.vertices(), mesh.faces(), code, items);
}

}  // namespace

// The error of a placed coordinate is that of MeshPair::Place, without its scale.
MeshMargin::MeshMargin(const ScenePart& a, const ScenePart& b, const RelativePose& pose)
    : a_(a), b_(b), pose_(pose), mesh_a_(a.mesh()), mesh_b_(b.mesh()) {
  size_ = a.max_coordinate() + 1.75 * b.max_coordinate() + MaxAbs(pose.translation());
  error_ = 4.1 * kUnit * size_ + 3.01 * pose.rotation_error() * b.max_coordinate() +
           1.01 * pose.translation_error();
  is_fair_ = std::min(a.max_coordinate(), b.max_coordinate()) > kLeastSize && size_ < kLargestSize;
}

Vector3d MeshMargin::PointOfB(int v) const {
  return pose_.rotation() * mesh_b_.vertex(v) + pose_.translation();
}

double MeshMargin::SurfacesApart(double enough, std::vector<std::pair<int, int>>* stack,
                                 long* nodes) const {
  if (!is_fair_) return 0.0;
  const Matrix3d& r = pose_.rotation();
  const Matrix3d abs_r = r.cwiseAbs();
  // A computed box of B may be off by as much as its points, and its halves by a unit more.
  const double slack = 2.0 * error_ + 8.0 * kUnit * size_;
  double best = enough;
  int opened = 0;
  stack->assign(1, {0, 0});
  while (!stack->empty()) {
    const auto [node_a, node_b] = stack->back();
    stack->pop_back();
    if (++opened > kMostNodes) return 0.0;
    TreeItem items_a[kTreeWidth], items_b[kTreeWidth];
    const int count_a = ItemsOf(mesh_a_, node_a, items_a);
    const int count_b = ItemsOf(mesh_b_, node_b, items_b);
    struct Near {
      double apart;
      int a, b;
    };
    Near near[kTreeWidth * kTreeWidth];
    int near_count = 0;
    for (int j = 0; j < count_b; ++j) {
      const Vector3d middle = r * (0.5 * (items_b[j].low + items_b[j].high)) + pose_.translation();
      const Vector3d half =
          abs_r * (0.5 * (items_b[j].high - items_b[j].low)) + Vector3d::Constant(slack);
      const Vector3d low = middle - half, high = middle + half;
      for (int i = 0; i < count_a; ++i) {
        const double apart = kDown * BoxesApart(items_a[i].low, items_a[i].high, low, high);
        if (apart < best) near[near_count++] = {apart, items_a[i].child, items_b[j].child};
      }
    }
    *nodes += static_cast<long>(count_a) * count_b;
    // The nearest are opened first: they come last onto the stack.
    std::sort(near, near + near_count, [](const Near& x, const Near& y) {
      return x.apart != y.apart ? x.apart > y.apart : std::pair(x.a, x.b) < std::pair(y.a, y.b);
    });
    for (int k = near_count - 1; k >= 0; --k) {
      if (near[k].a >= 0 || near[k].b >= 0 || near[k].apart >= best) continue;
      best = std::min(best, FacesApart(~near[k].a, ~near[k].b));
      if (!(best > 0.0)) return 0.0;
    }
    for (int k = 0; k < near_count; ++k) {
      if (near[k].a < 0 && near[k].b < 0) continue;
      if (near[k].apart < best) stack->emplace_back(near[k].a, near[k].b);
    }
  }
  return best;
}

// Nearest points guess a direction; the least and greatest heights of the corners along it prove
// what it is worth. With |n| = 1 up to rounding, |n|_1 < 2: a height is off by 3.1 u of the size
// and B's by the error of its points.
double MeshMargin::FacesApart(int face_a, int face_b) const {
  std::array<Vector3d, 3> a, b;
  for (int k = 0; k < 3; ++k) {
    a[k] = mesh_a_.vertex(mesh_a_.face(face_a)[k]);
    b[k] = PointOfB(mesh_b_.face(face_b)[k]);
  }
  const NearestPoints nearest = NearestPointsOf(a, b);
  const Vector3d between = nearest.y - nearest.x;
  const double length = between.norm();
  if (!(length > 0.0)) return 0.0;
  const Vector3d n = between / length;
  const double highest_a = std::max({n.dot(a[0]), n.dot(a[1]), n.dot(a[2])});
  const double lowest_b = std::min({n.dot(b[0]), n.dot(b[1]), n.dot(b[2])});
  return kDown * ((lowest_b - highest_a) - kUp * (2.0 * error_ + 16.0 * kUnit * size_));
}

bool MeshMargin::NoneInside() const {
  if (!is_fair_) return false;
  const double slack = 4.0 * error_ + 8.0 * kUnit * size_;
  // B's components against A's box, in A's frame.
  for (const std::array<int, 6>& extremes : b_.extreme_vertices()) {
    const bool outside = std::any_of(extremes.begin(), extremes.end(), [&](int v) {
      const Vector3d x = PointOfB(v);
      return ((x - a_.box().high).array() > slack).any() ||
             ((a_.box().low - x).array() > slack).any();
    });
    if (!outside) return false;
  }
  // A's against B's box turned into A's frame: outside of a slab of it. A point x of B's box has
  // |column i . (R x + t - middle)| <= half_i |column i|^2 + the other columns', which are within
  // 1e-6 of square to it.
  const Matrix3d& r = pose_.rotation();
  const Vector3d half = 0.5 * (b_.box().high - b_.box().low);
  const Vector3d middle = r * (0.5 * (b_.box().low + b_.box().high)) + pose_.translation();
  const double off = 4e-6 * half.sum() + 2.0 * slack;
  for (const std::array<int, 6>& extremes : a_.extreme_vertices()) {
    const bool outside = std::any_of(extremes.begin(), extremes.end(), [&](int v) {
      const Vector3d along = r.transpose() * (mesh_a_.vertex(v) - middle);
      return ((along.cwiseAbs() - half).array() > off).any();
    });
    if (!outside) return false;
  }
  return true;
}

double MeshMargin::Crossing(int face_a, int face_b) const {
  if (!is_fair_ || face_a < 0 || face_b < 0 || face_a >= mesh_a_.face_count() ||
      face_b >= mesh_b_.face_count()) {
    return 0.0;
  }
  Vector3d a[3], b[3];
  for (int k = 0; k < 3; ++k) {
    a[k] = mesh_a_.vertex(mesh_a_.face(face_a)[k]);
    b[k] = PointOfB(mesh_b_.face(face_b)[k]);
  }
  double margin = 0.0;
  for (int k = 0; k < 3; ++k) {
    margin = std::max(margin, EdgeCrosses(a[k], a[(k + 1) % 3], b));
    margin = std::max(margin, EdgeCrosses(b[k], b[(k + 1) % 3], a));
  }
  return margin;
}

// The edge passes through while its ends stay on their sides of the plane and the segment stays off
// the lines of the triangle's sides: were a side's line to change sides, the segment would meet it.
// Seen from the triangle's body the segment's points move by no more than both bodies' bounds. The
// distance of a point x from the plane: N.(x - t0) / |N|; of the lines: D / |(w - u) x side|. In
// doubles, with e the largest length: a difference of two points is off by 2 E + u of itself; a
// cross product by 2 (|e| (2 E + u f) + ...) + 2 u e f; taken together, and along a third
// difference, 8 e f (2 E + 4 u e) covers them. Divided by |N|.
double MeshMargin::EdgeCrosses(const Vector3d& u, const Vector3d& w, const Vector3d t[3]) const {
  const Vector3d e1 = t[1] - t[0], e2 = t[2] - t[0], edge = w - u;
  const double reach =
      std::max({MaxAbs(e1), MaxAbs(e2), MaxAbs(edge), MaxAbs(u - t[0]), MaxAbs(w - t[0])});
  const double per_area = 16.0 * reach * reach * (2.0 * error_ + 4.0 * kUnit * reach);
  const Vector3d normal = e1.cross(e2);
  const double area = normal.norm() * kUp + 8.0 * reach * (2.0 * error_ + 4.0 * kUnit * reach);
  const double height_u = normal.dot(u - t[0]), height_w = normal.dot(w - t[0]);
  if (!(height_u < 0.0 ? height_w > 0.0 : height_u > 0.0 && height_w < 0.0)) return 0.0;
  double margin = (std::min(std::abs(height_u), std::abs(height_w)) - per_area) / area;
  const double sense = height_u > 0.0 ? 1.0 : -1.0;  // the edge runs against the normal, or along
  for (int k = 0; k < 3; ++k) {
    const Vector3d side = t[(k + 1) % 3] - t[k];
    const Vector3d across = edge.cross(side);
    // (w - u) x side . (t_k - u): for an edge against the normal, positive inside of the side.
    const double signed_volume = sense * across.dot(t[k] - u);
    const double spread = across.norm() * kUp + 8.0 * reach * (2.0 * error_ + 4.0 * kUnit * reach);
    margin = std::min(margin, (signed_volume - per_area) / spread);
  }
  return kDown * margin;
}

}  // namespace touchstone::internal
