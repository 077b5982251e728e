// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_MESH_TRANSLATION_H_
#define TOUCHSTONE_CORE_MESH_TRANSLATION_H_

#include <Eigen/Core>

#include "touchstone/core/base/dyadic.h"

namespace touchstone {

// A point of space with big numbers: coordinates / denominator, the denominator positive.
struct ExactPoint {
  DyadicVector coordinates;
  Dyadic denominator{1};
};

// A translation of B in A's frame: doubles taken exactly, or the rounding of an exact point.
struct Translation {
  Translation(const Eigen::Vector3d& x) : value(x) {}
  // Each coordinate of `exact_point` is within `bound` of that of `x`. The point must outlive this.
  Translation(const Eigen::Vector3d& x, double bound, const ExactPoint& exact_point)
      : value(x), error(bound), exact(&exact_point) {}

  Eigen::Vector3d value;
  double error = 0.0;
  const ExactPoint* exact = nullptr;  // none: `value` is exact
};

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_MESH_TRANSLATION_H_
