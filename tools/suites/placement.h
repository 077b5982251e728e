// SPDX-License-Identifier: MIT
//
//   paper   here       meaning
//   M       -          {a - b : a in P, b in R Q}: Q moved by t meets P iff t is in M
//   l       travel     signed distance along `direction` from where Q just touches P; positive:
//   apart
#ifndef TOUCHSTONE_TOOLS_SUITES_PLACEMENT_H_
#define TOUCHSTONE_TOOLS_SUITES_PLACEMENT_H_

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "touchstone/core/base/relative_pose.h"
#include "touchstone/core/convex/convex_polyhedron.h"

namespace touchstone {

// Where Q, rotated by `rotation` and moving along a line, loses contact with P: Q moved by
// `start + exit * direction` just touches P, up to the rounding of `exit`. At `start` the means of
// their vertices coincide. `size` is the larger of the bodies' largest coordinates.
struct ContactLine {
  Eigen::Matrix3d rotation;
  Eigen::Vector3d direction;  // of unit length up to rounding
  Eigen::Vector3d start;
  double exit = 0.0;
  double size = 0.0;
};

// Finds the contact by a portal search in doubles, then takes the exit from the facet found in
// exact arithmetic, rounded within two units in the last place. Should doubles name a neighbouring
// facet, the placement is off by their rounding: a placement is an input, its verdict is the
// judge's. Complexity: O(m + n) a round, about twenty rounds.
ContactLine FindContactLine(const ConvexPolyhedron& p, const ConvexPolyhedron& q,
                            const Eigen::Matrix3d& rotation, const Eigen::Vector3d& direction);

// Q's pose at signed travel `travel` from contact.
RelativePose PoseAtTravel(const ContactLine& line, double travel);
// At contact (`ulps` 0), or one unit in the last place apart (+1) or in (-1) along the axis where
// the line moves most.
RelativePose PoseAtUlps(const ContactLine& line, int ulps);

// The travels that suites of general bodies go through, in hundredths of the size: from deep to
// far, and every step from a visible gap down to one ulp, on either side.
inline constexpr int kPlacementCount = 20;
RelativePose PoseOfPlacement(const ContactLine& line, int placement);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_SUITES_PLACEMENT_H_
