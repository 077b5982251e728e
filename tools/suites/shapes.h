// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_SUITES_SHAPES_H_
#define TOUCHSTONE_TOOLS_SUITES_SHAPES_H_

#include <Eigen/Core>
#include <span>
#include <vector>

#include "touchstone/core/convex/convex_polyhedron.h"
#include "touchstone/tools/suites/random.h"

namespace touchstone {

// How coplanar facets of a hull are given to the body.
enum class FacetStyle {
  kMerged,        // one polygon a plane
  kTriangulated,  // each polygon as a fan: coplanar neighbours
};

// The exact hull of `points`, numbered by the points and their order alone (exact/convex_hull.h).
// The body, or the status that says why there is none.
StatusOr<ConvexPolyhedron> HullBody(std::span<const Eigen::Vector3d> points, FacetStyle style);

// The hull of `count` random points on an ellipsoid; all of them are corners, up to rounding.
// Requires count >= 4; draws again should a hull be flat.
ConvexPolyhedron EllipsoidBody(Random& random, int count, const Eigen::Vector3d& semi_axes);

// Integer coordinates, all below 2^12 and so fit for contact.h.

// An axis-parallel box around the origin.
ConvexPolyhedron BoxBody(const Eigen::Vector3d& half_extents,
                         FacetStyle style = FacetStyle::kMerged);
// `corners` lattice points of one circle (3 <= corners <= 108), around the origin: convex and
// cocircular, exactly. Counterclockwise.
std::vector<Eigen::Vector2d> LatticePolygon(Random& random, int corners);
// The polygon at z = -height and z = height; the upper one turned by a quarter when `anti`.
ConvexPolyhedron PrismBody(std::span<const Eigen::Vector2d> polygon, double height, bool anti,
                           FacetStyle style);
// The polygon at z = 0 between apexes at z = -height and z = height.
ConvexPolyhedron BipyramidBody(std::span<const Eigen::Vector2d> polygon, double height,
                               FacetStyle style);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_SUITES_SHAPES_H_
