// SPDX-License-Identifier: GPL-3.0-or-later
//
// Bodies, poses and known-good results for the tests of the exact half; nothing here uses the
// core's search.
#ifndef TOUCHSTONE_TESTS_EXACT_SHAPES_H_
#define TOUCHSTONE_TESTS_EXACT_SHAPES_H_

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "touchstone/core/base/relative_pose.h"
#include "touchstone/core/cd_dual/result.h"
#include "touchstone/core/convex/convex_polyhedron.h"
#include "touchstone/exact/exact_body.h"

namespace touchstone::exact {

// SplitMix64: the same numbers on every machine.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t Next();
  int Integer(int low, int high);  // both included
  double Real(double low, double high);
  Eigen::Vector3d OnSphere();

 private:
  std::uint64_t state_;
};

using Points = std::vector<Eigen::Vector3d>;

ConvexPolyhedron Hull(const Points& points, bool merge_coplanar = true);
ConvexPolyhedron Box(const Eigen::Vector3d& low, const Eigen::Vector3d& high);
// A hull of `count` points with integer coordinates up to `reach`.
ConvexPolyhedron GridHull(Random* random, int count, int reach, bool merge_coplanar);
// `count` points on the ellipsoid with these half axes.
ConvexPolyhedron EllipsoidHull(Random* random, int count, const Eigen::Vector3d& axes);

// One of the 24 rotations of a cube; a rotation rounded to doubles.
Eigen::Matrix3d CubeRotation(Random* random);
Eigen::Matrix3d RoundedRotation(Random* random);
RelativePose Pose(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation);

// What a search without fault would return, made from Decide and the supporting features: the exit
// face of its exact class, values within an ulp, and a certificate by that face. No phases, no
// counts.
CollideResult GoodResult(const ExactBody& p, const ExactBody& q, const RelativePose& pose);

// Fills the reports of all three phases with the exact maxima of their classes, found by evaluating
// every face and every crossing edge pair exactly.
void AddPhaseMaxima(const ExactBody& p, const ExactBody& q, const RelativePose& pose,
                    CollideResult* result);

}  // namespace touchstone::exact

#endif  // TOUCHSTONE_TESTS_EXACT_SHAPES_H_
