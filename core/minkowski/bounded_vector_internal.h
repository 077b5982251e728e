// SPDX-License-Identifier: MIT
//
// Vectors in doubles with a bound on the error of each coordinate.
#ifndef TOUCHSTONE_CORE_MINKOWSKI_BOUNDED_VECTOR_INTERNAL_H_
#define TOUCHSTONE_CORE_MINKOWSKI_BOUNDED_VECTOR_INTERNAL_H_

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "touchstone/core/mesh/mesh_pair.h"

namespace touchstone::internal {

// More than all that a bound can lose below the least normal number, where sizes are at most a few.
inline constexpr double kUnderflow = 0x1p-1000;

inline double MaxAbs(const Eigen::Vector3d& v) { return v.cwiseAbs().maxCoeff(); }

struct BoundedVector {
  Eigen::Vector3d value;
  double error;
};

// The cross product of u and v, whose coordinates are off by the errors given. u_i v_j - u_j v_i
// passes two roundings on each path, 2.01 units of at most 2 |u||v|; the data add 2 (|u| e_v + |v|
// e_u + e_u e_v).
inline BoundedVector CrossOf(const Eigen::Vector3d& u, double u_error, const Eigen::Vector3d& v,
                             double v_error) {
  const double lu = MaxAbs(u), lv = MaxAbs(v);
  const double error =
      1.01 * (4.1 * kUnit * lu * lv + 2.0 * (lu * v_error + lv * u_error + u_error * v_error)) +
      kUnderflow;
  return {u.cross(v), error};
}

// 0 where the error leaves the sign open, also where it is infinite, and for NaN.
inline int SignOf(double value, double error) {
  return value > error ? 1 : value < -error ? -1 : 0;
}

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_MINKOWSKI_BOUNDED_VECTOR_INTERNAL_H_
