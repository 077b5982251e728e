// SPDX-License-Identifier: MIT
//
// kPortal: minimise h_M(N) over the plane of directions {N : N.(o - c) = 1} by cutting planes.
#ifndef TOUCHSTONE_CORE_CD_DUAL_PORTAL_H_
#define TOUCHSTONE_CORE_CD_DUAL_PORTAL_H_

#include <array>
#include <optional>

#include "touchstone/core/cd_dual/minkowski_difference.h"

namespace touchstone {

// What a search in doubles proposes. Nothing here is proven, but for kApartByBounds.
struct Proposal {
  enum class Kind {
    kApartByBounds,        // `direction` separates: the bodies' balls or ellipsoids prove it
    kSeparatingDirection,  // `direction` with support `support` has o on its outer side
    kEnclosed,             // the ray crosses `triangle` beyond o
    kExitFacet,  // nothing of M lies beyond the plane of `triangle`, which the ray crosses
    kStuck,      // rounding left no triangle worth naming
  };
  Kind kind = Kind::kStuck;
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  CornerPair support;
  bool has_triangle = false;  // whether `corners` is one that the ray crosses
  std::array<CornerPair, 3> corners;
  std::array<VertexPair, 3> triangle;
  // kEnclosed: the triangle's points, as MinkowskiDifference::Point has them.
  std::array<Eigen::Vector3d, 3> points;
};

// Keeps a triangle of M's vertices that the ray from c through o crosses, asks for the support
// along its outward normal, and replaces a vertex, until nothing lies beyond. With `early_exit`,
// stops at the first direction with o on its outer side and at the first triangle with o on its
// inner side. Stops after a fixed number of rounds at the latest (rounding may go in circles on
// ties), proposing the triangle it has. `start`, if given, are corners that M has: the search
// begins there if the ray crosses their triangle. Complexity: about a dozen support pairs.
Proposal SearchPortal(const MinkowskiDifference& m, bool early_exit, PhaseCounts* counts,
                      const std::array<CornerPair, 3>* start = nullptr);

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_CD_DUAL_PORTAL_H_
