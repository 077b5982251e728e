// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_BASE_ORIENTATION_H_
#define TOUCHSTONE_CORE_BASE_ORIENTATION_H_

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

namespace touchstone {

// A point taken exactly, and its coordinates over the body's power of two, below 1 in magnitude;
// the latter may be off by 2^-1022 where the scaling underflows.
struct ScaledPoint {
  Eigen::Vector3d exact;
  Eigen::Vector3d scaled;
};

// A double and a bound on its distance from the number it stands for.
struct Estimate {
  double value;
  double error;
};

// Exact orientation signs among a body's vertices and points inside it: in doubles with an error
// bound, then by big numbers. Independent of the rounding mode.
class Orientation {
 public:
  // Requires `max_coordinate`, the largest absolute coordinate, within [1e-100, 1e100].
  Orientation(std::span<const Eigen::Vector3d> vertices, double max_coordinate);

  // `exact` is a point whose coordinates do not exceed the body's.
  ScaledPoint Scale(const Eigen::Vector3d& exact) const { return {exact, exact * scale_}; }
  const ScaledPoint& point(int v) const { return points_[v]; }

  // The sign of (b - a) x (c - a) . (d - a): 1 when d lies beyond the plane, on the side that a, b,
  // c run counterclockwise seen from; 0 when it lies in the plane.
  static int ExactSide(const ScaledPoint& a, const ScaledPoint& b, const ScaledPoint& c,
                       const ScaledPoint& d);
  int ExactSide(const std::array<int, 3>& plane, int d) const {
    return ExactSide(point(plane[0]), point(plane[1]), point(plane[2]), point(d));
  }
  int ExactSide(const std::array<int, 3>& plane, const ScaledPoint& d) const {
    return ExactSide(point(plane[0]), point(plane[1]), point(plane[2]), d);
  }
  // The same determinant in scaled coordinates.
  static Estimate TriageSide(const ScaledPoint& a, const ScaledPoint& b, const ScaledPoint& c,
                             const ScaledPoint& d);

  // The sign of component `axis` of (b - a) x (c - a): the turn a, b, c seen along that axis.
  int ExactTurn(int a, int b, int c, int axis) const;

  // Whether three vertices lie on one line, exactly.
  bool IsCollinear(int a, int b, int c) const;

  // The normal of the plane, on the side that its vertices run counterclockwise seen from: of unit
  // length, each entry within 2^-46 of the exact one's. Requires vertices that are not collinear,
  // the first of them best where the angle is widest.
  Eigen::Vector3d UnitNormal(const std::array<int, 3>& plane) const;

 private:
  double scale_;
  std::vector<ScaledPoint> points_;
};

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_BASE_ORIENTATION_H_
