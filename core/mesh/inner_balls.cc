// SPDX-License-Identifier: MIT
#include "touchstone/core/mesh/inner_balls.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "touchstone/core/base/relative_pose.h"
#include "touchstone/core/mesh/mesh_pair.h"
#include "touchstone/core/mesh/point_in_mesh_internal.h"

namespace touchstone {
namespace {

using Eigen::Vector3d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// How much a distance below may exceed the true one, where coordinates are at most one. A face
// whose height over its longest side is below 2^-20 lies within that of its sides, whose distances
// are good to 2^-48. Of others the foot of the normal is off by at most 2^-27 along the face (the
// normal by 2^-50 over the sine of its angle, which is at least 2^-21): if it is taken to lie
// outside and does not, the nearest side is not further than that beyond the truth.
constexpr double kDistanceError = 0x1p-19;

constexpr int kShrinkLimit = 24;

Vector3d NearestOnSegment(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
  const Vector3d ab = b - a;
  const double t = std::clamp((p - a).dot(ab) / ab.squaredNorm(), 0.0, 1.0);
  return a + t * ab;
}

Vector3d NearestOnTriangle(const Vector3d& p, const Vector3d& a, const Vector3d& b,
                           const Vector3d& c) {
  const Vector3d normal = (b - a).cross(c - a);
  const bool is_over = normal.dot((b - a).cross(p - a)) > 0.0 &&
                       normal.dot((c - b).cross(p - b)) > 0.0 &&
                       normal.dot((a - c).cross(p - c)) > 0.0;
  if (is_over) return p - normal * (normal.dot(p - a) / normal.squaredNorm());
  const Vector3d feet[] = {NearestOnSegment(p, a, b), NearestOnSegment(p, b, c),
                           NearestOnSegment(p, c, a)};
  return *std::min_element(std::begin(feet), std::end(feet), [&](const auto& x, const auto& y) {
    return (x - p).squaredNorm() < (y - p).squaredNorm();
  });
}

class BallFinder {
 public:
  explicit BallFinder(const PlacedMesh& placed) : placed_(placed) {}

  // In the placed mesh's frame.
  InnerBall BallOf(int face) const {
    const Triangle& corners = placed_.mesh.face(face);
    const Vector3d middle =
        (placed_.points[corners[0]] + placed_.points[corners[1]] + placed_.points[corners[2]]) /
        3.0;
    const Vector3d inward = -placed_.planes[face].normal.normalized();
    double radius = 2.0;
    Vector3d centre = middle + radius * inward, nearest;
    double distance = Nearest(centre, &nearest);
    for (int i = 0; i < kShrinkLimit && distance < radius * (1.0 - 0x1p-10); ++i) {
      // The ball through the middle, tangent to the face there, and through the point found.
      const Vector3d to = nearest - middle;
      const double height = to.dot(inward);
      if (!(height > 0.0)) return {};
      radius = std::min(0.5 * to.squaredNorm() / height, 0.99 * radius);
      centre = middle + radius * inward;
      distance = Nearest(centre, &nearest);
    }
    InnerBall ball{centre, std::min(distance, radius) - kDistanceError - 0x1p-48};
    if (!(ball.radius > 0.0)) return {};
    const std::optional<bool> inside = internal::TriageInside(placed_, centre, 0x1p-48);
    return inside && *inside ? ball : InnerBall{};
  }

  double Nearest(const Vector3d& p, Vector3d* nearest) const {
    double best = kInfinity;
    std::pair<double, int> stack[8 * 12];  // squared distance to the node's box, node
    int size = 0;
    stack[size++] = {0.0, 0};
    while (size > 0) {
      const auto [bound, index] = stack[--size];
      if (bound >= best) continue;
      const BoxNode& node = placed_.tree.node(index);
      std::pair<double, int> lanes[kTreeWidth];
      for (int lane = 0; lane < node.lane_count; ++lane) {
        double squared = 0.0;
        for (int axis = 0; axis < 3; ++axis) {
          const double beyond =
              std::max({node.low[axis][lane] - p[axis], p[axis] - node.high[axis][lane], 0.0});
          squared += beyond * beyond;
        }
        // By insertion, the nearest last, to be popped first.
        int at = lane;
        for (; at > 0 && lanes[at - 1].first < squared; --at) lanes[at] = lanes[at - 1];
        lanes[at] = {squared, node.children[lane]};
      }
      for (int lane = 0; lane < node.lane_count; ++lane) {
        const auto& [squared, child] = lanes[lane];
        if (squared >= best) continue;
        if (child >= 0) {
          stack[size++] = lanes[lane];
          continue;
        }
        const Triangle& corners = placed_.mesh.face(~child);
        const Vector3d at = NearestOnTriangle(
            p, placed_.points[corners[0]], placed_.points[corners[1]], placed_.points[corners[2]]);
        const double distance = (at - p).squaredNorm();
        if (distance < best) best = distance, *nearest = at;
      }
    }
    return std::sqrt(best);
  }

 private:
  const PlacedMesh& placed_;
};

}  // namespace

std::optional<double> InnerClearance(const PlacedMesh& mesh, const Vector3d& point, double error) {
  const std::optional<bool> inside = internal::TriageInside(mesh, point, error);
  if (!inside || !*inside) return std::nullopt;
  Vector3d nearest;
  const double radius =
      BallFinder(mesh).Nearest(point, &nearest) - kDistanceError - 2.0 * error - 0x1p-48;
  if (!(radius > 0.0)) return std::nullopt;
  return radius;
}

std::vector<InnerBall> InnerBalls(const TriangleMesh& mesh) {
  const MeshPair pair(mesh, mesh, RelativePose());
  const BallFinder finder(pair.a());
  std::vector<InnerBall> balls(mesh.face_count());
  for (int f = 0; f < mesh.face_count(); ++f) {
    balls[f] = finder.BallOf(f);
    balls[f].centre /= pair.scale();
    balls[f].radius /= pair.scale();
  }
  return balls;
}

}  // namespace touchstone
