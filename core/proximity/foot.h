// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_PROXIMITY_FOOT_H_
#define TOUCHSTONE_CORE_PROXIMITY_FOOT_H_

#include <Eigen/Core>

#include "touchstone/core/cd_dual/signs.h"
#include "touchstone/core/proximity/nearest_point.h"

namespace touchstone {

// The foot x of o on the point, line or plane through the vertices of a simplex, in P's frame and
// the caller's lengths, with error bounds that hold for the exact foot.
struct Foot {
  double distance = 0.0;  // |x|
  double distance_error = 0.0;
  Eigen::Vector3d point;  // x
  double point_error = 0.0;
  // Of length one up to 4 u: the triangle's normal, outward when its points run counterclockwise
  // from outside; along -x for one or two points.
  Eigen::Vector3d outward;
  // The sums of the vertices of P and of Q with the weights of x over the simplex; x is their
  // difference. If those weights are positive, points of the bodies.
  Eigen::Vector3d on_p, on_q;
  double on_error = 0.0;
};

// In doubles, with a running error bound: infinite where the simplex is too thin to tell.
Foot MeasureFoot(const MinkowskiDifference& m, const Simplex& simplex);
// By big numbers: good to a few units in the last place. Requires a simplex that is not flat.
Foot MeasureFootExactly(Signs* signs, const Simplex& simplex);

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_PROXIMITY_FOOT_H_
