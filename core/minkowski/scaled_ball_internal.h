// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_MINKOWSKI_SCALED_BALL_INTERNAL_H_
#define TOUCHSTONE_CORE_MINKOWSKI_SCALED_BALL_INTERNAL_H_

#include <Eigen/Core>

#include "touchstone/core/mesh/mesh_pair.h"
#include "touchstone/core/minkowski/local_sum.h"

namespace touchstone::internal {

// A ball in the pair's scaled frame, where M has size one at most.
//
// What is judged by roundings of points, each within 2^-38 there, counts as meeting the ball within
// `slack` of it, 2^-36 (1 + |center| + radius): a distance between doubles of that size adds a few
// units of 2^-52. Facets within twice the slack are gathered, so that every facet that holds a
// point within one slack, as judged, is among them.
class ScaledBall {
 public:
  ScaledBall() = default;
  // Requires a finite centre and a finite radius that is not negative.
  ScaledBall(const MeshPair& pair, const Ball& ball);

  const Eigen::Vector3d& center() const { return center_; }
  double radius() const { return radius_; }
  double slack() const { return slack_; }
  // A radius within which points count as in the ball, and one within which facets are gathered.
  double reach() const { return radius_ + slack_; }
  double gathering_reach() const { return radius_ + 2.0 * slack_; }

 private:
  Eigen::Vector3d center_ = Eigen::Vector3d::Zero();
  double radius_ = 0.0, slack_ = 0.0;
};

// How far x is from a segment, and from a convex polygon of `count` corners: in doubles, off by a
// few units of the distances between the points.
double DistanceToSegment(const Eigen::Vector3d& x, const Eigen::Vector3d& from,
                         const Eigen::Vector3d& to);
double DistanceToPolygon(const Eigen::Vector3d& x, const Eigen::Vector3d* corners, int count);

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_MINKOWSKI_SCALED_BALL_INTERNAL_H_
