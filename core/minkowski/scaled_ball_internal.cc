// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/scaled_ball_internal.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace touchstone::internal {
namespace {

using Eigen::Vector3d;

// Beyond this the ball's surface is a plane as far as M is concerned, and squares would overflow.
constexpr double kHuge = 0x1p400;

}  // namespace

ScaledBall::ScaledBall(const MeshPair& pair, const Ball& ball)
    : center_(pair.scale() * ball.center), radius_(pair.scale() * ball.radius) {
  const double size = center_.cwiseAbs().maxCoeff();
  if (size > kHuge || radius_ > kHuge) {
    // In units of the larger: M is a point at the origin.
    const double unit = std::max(size, radius_);
    const bool holds_m = (ball.center / (unit / pair.scale())).norm() <= radius_ / unit;
    center_ = Vector3d::Zero();
    radius_ = holds_m ? 0x1p10 : 0.0;
    if (!holds_m) center_[0] = 0x1p10;
  }
  slack_ = 0x1p-36 * (1.0 + center_.cwiseAbs().maxCoeff() + radius_);
}

double DistanceToSegment(const Vector3d& x, const Vector3d& from, const Vector3d& to) {
  const Vector3d edge = to - from, way = x - from;
  const double squared = edge.squaredNorm();
  const double along = squared > 0.0 ? std::clamp(way.dot(edge) / squared, 0.0, 1.0) : 0.0;
  return (way - along * edge).norm();
}

// The foot in the plane where it lies within all sides; else a side is nearest.
double DistanceToPolygon(const Vector3d& x, const Vector3d* corners, int count) {
  double nearest = DistanceToSegment(x, corners[count - 1], corners[0]);
  for (int k = 1; k < count; ++k) {
    nearest = std::min(nearest, DistanceToSegment(x, corners[k - 1], corners[k]));
  }
  const Vector3d normal =
      (corners[1] - corners[0]).cross(corners[count - 1] - corners[0]).normalized();
  for (int k = 0; k < count; ++k) {
    const Vector3d side = corners[(k + 1) % count] - corners[k];
    if (!(normal.cross(side).dot(x - corners[k]) >= 0.0)) return nearest;
  }
  return std::min(nearest, std::abs(normal.dot(x - corners[0])));
}

}  // namespace touchstone::internal
