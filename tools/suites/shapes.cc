// SPDX-License-Identifier: MIT
#include "touchstone/tools/suites/shapes.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "touchstone/exact/convex_hull.h"

namespace touchstone {
namespace {

ConvexPolyhedron HullOfKnownGood(std::span<const Eigen::Vector3d> points, FacetStyle style) {
  StatusOr<ConvexPolyhedron> body = HullBody(points, style);
  assert(body.ok());
  return *body;
}

// Every lattice point of the circle of this radius.
std::vector<Eigen::Vector2d> LatticeCircle(int radius) {
  std::vector<Eigen::Vector2d> points;
  for (int x = -radius; x <= radius; ++x) {
    const int squared = radius * radius - x * x;
    const int y = static_cast<int>(std::sqrt(static_cast<double>(squared)));
    if (y * y != squared) continue;
    points.emplace_back(x, y);
    if (y != 0) points.emplace_back(x, -y);
  }
  return points;
}

// By angle from the positive x axis, counterclockwise.
bool AngleLess(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const auto lower = [](const Eigen::Vector2d& v) {
    return v[1] < 0.0 || (v[1] == 0.0 && v[0] < 0.0);
  };
  if (lower(a) != lower(b)) return lower(b);
  return a[0] * b[1] - a[1] * b[0] > 0.0;
}

bool HoldsOrigin(const std::vector<Eigen::Vector2d>& polygon) {
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Eigen::Vector2d& a = polygon[k];
    const Eigen::Vector2d& b = polygon[(k + 1) % polygon.size()];
    if (a[0] * b[1] - a[1] * b[0] <= 0.0) return false;
  }
  return true;
}

}  // namespace

StatusOr<ConvexPolyhedron> HullBody(std::span<const Eigen::Vector3d> points, FacetStyle style) {
  return exact::ConvexHull(points, {.merge_coplanar = style == FacetStyle::kMerged});
}

ConvexPolyhedron EllipsoidBody(Random& random, int count, const Eigen::Vector3d& semi_axes) {
  for (;;) {
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < count; ++i) {
      const Eigen::Vector3d unit = random.SpherePoint();
      points.emplace_back(unit[0] * semi_axes[0], unit[1] * semi_axes[1], unit[2] * semi_axes[2]);
    }
    StatusOr<ConvexPolyhedron> body = HullBody(points, FacetStyle::kMerged);
    if (body.ok()) return *body;
  }
}

ConvexPolyhedron BoxBody(const Eigen::Vector3d& half_extents, FacetStyle style) {
  std::vector<Eigen::Vector3d> points;
  for (int corner = 0; corner < 8; ++corner) {
    Eigen::Vector3d point;
    for (int i = 0; i < 3; ++i)
      point[i] = (corner >> i & 1) != 0 ? half_extents[i] : -half_extents[i];
    points.push_back(point);
  }
  return HullOfKnownGood(points, style);
}

std::vector<Eigen::Vector2d> LatticePolygon(Random& random, int corners) {
  const int radius = corners <= 8 ? 5 : corners <= 16 ? 25 : corners <= 30 ? 65 : 1105;
  const std::vector<Eigen::Vector2d> circle = LatticeCircle(radius);
  assert(corners >= 3 && corners <= static_cast<int>(circle.size()));
  for (;;) {
    std::vector<Eigen::Vector2d> polygon = circle;
    for (int i = 0; i < corners; ++i) {
      std::swap(polygon[i], polygon[random.Integer(i, static_cast<int>(circle.size()) - 1)]);
    }
    polygon.resize(corners);
    std::sort(polygon.begin(), polygon.end(), AngleLess);
    if (HoldsOrigin(polygon)) return polygon;
  }
}

ConvexPolyhedron PrismBody(std::span<const Eigen::Vector2d> polygon, double height, bool anti,
                           FacetStyle style) {
  std::vector<Eigen::Vector3d> points;
  for (const Eigen::Vector2d& corner : polygon) points.emplace_back(corner[0], corner[1], -height);
  for (const Eigen::Vector2d& corner : polygon) {
    points.emplace_back(anti ? -corner[1] : corner[0], anti ? corner[0] : corner[1], height);
  }
  return HullOfKnownGood(points, style);
}

ConvexPolyhedron BipyramidBody(std::span<const Eigen::Vector2d> polygon, double height,
                               FacetStyle style) {
  std::vector<Eigen::Vector3d> points;
  for (const Eigen::Vector2d& corner : polygon) points.emplace_back(corner[0], corner[1], 0.0);
  points.emplace_back(0.0, 0.0, -height);
  points.emplace_back(0.0, 0.0, height);
  return HullOfKnownGood(points, style);
}

}  // namespace touchstone
