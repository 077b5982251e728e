// SPDX-License-Identifier: MIT
#include "touchstone/core/mesh/inner_balls.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "touchstone/core/base/relative_pose.h"
#include "touchstone/core/base/vector_clones.h"
#include "touchstone/core/mesh/mesh_pair.h"
#include "touchstone/core/mesh/nearest_on_triangle.h"
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
constexpr double kMostRadius = 2.0;
// Of a face's ball over that of the one before, to begin with.
constexpr double kGuess = 1.25;
// Of the cosine between a face's normal and the way from a ball's centre to its middle.
constexpr double kSameWay = 0.9;

// A nearest point is looked for no closer than this: round the middle of a tube all of a ring is
// equally near, and need not be gone through.
constexpr double kNearEnough = 1.0 - 0x1p-6;

// Of the lanes' boxes from p.
TOUCHSTONE_VECTOR_CLONES
void SquaredDistances(const BoxNode& node, const Vector3d& p, double squared[kTreeWidth]) {
  for (int i = 0; i < kTreeWidth; ++i) squared[i] = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double x = p[axis];
    for (int i = 0; i < kTreeWidth; ++i) {
      const double under = node.low[axis][i] - x, over = x - node.high[axis][i];
      const double most = under > over ? under : over, beyond = most > 0.0 ? most : 0.0;
      squared[i] += beyond * beyond;
    }
  }
}

// Whether a plane through zero is further from p than that, squared, up to 2^-27: the normal of a
// needle does not tell.
bool IsPlaneBeyond(const FacePlane& plane, const Vector3d& p, double squared) {
  const double height = plane.normal.dot(p), length = plane.normal.squaredNorm();
  return height * height > squared * length && plane.error * plane.error < 0x1p-64 * length;
}

class BallFinder {
 public:
  explicit BallFinder(const PlacedMesh& placed) : placed_(placed) {}

  // In the placed mesh's frame. The radius begins at a guess, and is doubled until something is in
  // the ball.
  InnerBall BallOf(int face, double guess) const {
    const Vector3d middle = MiddleOf(face), inward = InwardOf(face);
    double radius = guess;
    bool has_met = false;
    for (int i = 0; i < kShrinkLimit; ++i) {
      const Vector3d centre = middle + radius * inward;
      const std::optional<bool> inside = internal::TriageInside(placed_, centre, 0x1p-48);
      const bool is_inside = inside && *inside;
      Vector3d nearest;
      // From beyond a thin wall its far side is all but as near as the middle is.
      if (Nearest(centre, radius, is_inside ? kNearEnough : 1.0, &nearest) == radius) {
        if (is_inside && !has_met && radius < kMostRadius) {
          radius = std::min(2.0 * radius, kMostRadius);
          continue;
        }
        const double proven = kNearEnough * radius - kDistanceError - 0x1p-48;
        return is_inside && proven > 0.0 ? InnerBall{centre, proven} : InnerBall{};
      }
      has_met = true;
      // The ball through the middle, tangent to the face there, and through the point found; where
      // that is no higher than the face, half the ball.
      const Vector3d to = nearest - middle;
      const double height = to.dot(inward);
      radius =
          height > 0.0 ? std::min(0.5 * to.squaredNorm() / height, 0.99 * radius) : 0.5 * radius;
    }
    return {};
  }

  // Whether a ball comes as near to a face's middle as its own would.
  bool IsAsGood(const InnerBall& ball, int face) const {
    const Vector3d way = ball.centre - MiddleOf(face);
    const double length = way.norm();
    return ball.radius > 0.0 && length * kNearEnough * kNearEnough < ball.radius &&
           way.dot(InwardOf(face)) > kSameWay * length;
  }

  // The distance of some point of the surface, or `most` and none: no point is nearer than `enough`
  // times that.
  double Nearest(const Vector3d& p, double most, double enough, Vector3d* nearest) const {
    double found = most, least = enough * most * (enough * most);
    struct Entry {
      double squared;  // distance to the box
      int child;
    };
    Entry stack[kTreeWidth * 12];
    int size = 0;
    stack[size++] = {0.0, 0};
    while (size > 0) {
      const auto [bound, child] = stack[--size];
      if (bound >= least) continue;
      if (child < 0) {
        const Triangle& corners = placed_.mesh.face(~child);
        const Vector3d& corner = placed_.points[corners[0]];
        if (IsPlaneBeyond(placed_.planes[~child], p - corner, least)) continue;
        const Vector3d at =
            NearestOnTriangle(p, corner, placed_.points[corners[1]], placed_.points[corners[2]]);
        const double distance = (at - p).squaredNorm();
        if (distance >= least) continue;
        found = std::sqrt(distance);
        least = enough * enough * distance;
        *nearest = at;
        continue;
      }
      const BoxNode& node = placed_.tree.node(child);
      const int first = size;
      double distances[kTreeWidth];
      SquaredDistances(node, p, distances);
      for (int lane = 0; lane < node.lane_count; ++lane) {
        const double squared = distances[lane];
        if (squared >= least) continue;
        // By insertion, the nearest last, to be popped first.
        int at = size++;
        for (; at > first && stack[at - 1].squared < squared; --at) stack[at] = stack[at - 1];
        stack[at] = {squared, node.children[lane]};
      }
    }
    return found;
  }

 private:
  Vector3d MiddleOf(int face) const {
    const Triangle& corners = placed_.mesh.face(face);
    return (placed_.points[corners[0]] + placed_.points[corners[1]] + placed_.points[corners[2]]) /
           3.0;
  }
  Vector3d InwardOf(int face) const { return -placed_.planes[face].normal.normalized(); }

  const PlacedMesh& placed_;
};

}  // namespace

std::optional<double> InnerClearance(const PlacedMesh& mesh, const Vector3d& point, double error) {
  const std::optional<bool> inside = internal::TriageInside(mesh, point, error);
  if (!inside || !*inside) return std::nullopt;
  Vector3d nearest;
  const double radius =
      kNearEnough * BallFinder(mesh).Nearest(point, kInfinity, kNearEnough, &nearest) -
      kDistanceError - 2.0 * error - 0x1p-48;
  if (!(radius > 0.0)) return std::nullopt;
  return radius;
}

std::vector<InnerBall> InnerBalls(const TriangleMesh& mesh) {
  const MeshPair pair(mesh, mesh, RelativePose());
  const BallFinder finder(pair.a());
  std::vector<InnerBall> balls(mesh.face_count());
  double guess = kMostRadius;
  for (int f = 0; f < mesh.face_count(); ++f) {
    // Round a tube, and in a cone's slivers, one ball does for many.
    for (const int h : {3 * f, 3 * f + 1, 3 * f + 2}) {
      const int beside = TriangleMesh::face_of(mesh.twin(h));
      if (beside < f && finder.IsAsGood(balls[beside], f)) balls[f] = balls[beside];
    }
    if (balls[f].radius > 0.0) continue;
    balls[f] = finder.BallOf(f, guess);
    if (balls[f].radius > 0.0) guess = std::min(kGuess * balls[f].radius, kMostRadius);
  }
  for (InnerBall& ball : balls) {
    ball.centre /= pair.scale();
    ball.radius /= pair.scale();
  }
  return balls;
}

}  // namespace touchstone
