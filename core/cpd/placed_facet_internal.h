// SPDX-License-Identifier: MIT
//
// Facets and what touches them, in doubles, up to a slack.
#ifndef TOUCHSTONE_CORE_CPD_PLACED_FACET_INTERNAL_H_
#define TOUCHSTONE_CORE_CPD_PLACED_FACET_INTERNAL_H_

#include <Eigen/Core>
#include <array>

#include "touchstone/core/mesh/mesh_pair.h"
#include "touchstone/core/minkowski/sum_facet.h"

namespace touchstone::internal {

// Scaled bodies are of size one. Points are placed to about 2^-44, where planes meet at no less
// than a sine of 2^-10; what passes this far into a triangle cuts it.
inline constexpr double kPatchSlack = 0x1p-32;

// A convex facet in doubles, in the pair's scaled frame.
struct PlacedFacet {
  std::array<Eigen::Vector3d, 4> corners;
  int count = 0;
  Eigen::Vector3d normal, low, high;
  double offset = 0.0;
};

// Corners and box; the plane where it is asked for.
PlacedFacet PlaceCorners(const MeshPair& pair, const SumFacet& name);
void PlacePlane(const MeshPair& pair, const SumFacet& name, PlacedFacet* facet);

// Whether its box meets another.
inline bool Meet(const PlacedFacet& facet, const Eigen::Vector3d& low,
                 const Eigen::Vector3d& high) {
  return (facet.low.array() <= high.array() + kPatchSlack).all() &&
         (facet.high.array() >= low.array() - kPatchSlack).all();
}
inline double Height(const PlacedFacet& facet, const Eigen::Vector3d& x) {
  return facet.normal.dot(x) - facet.offset;
}
// Whether a point of the plane lies in the facet; whether any point does.
bool HoldsInPlane(const PlacedFacet& facet, const Eigen::Vector3d& x);
bool Holds(const PlacedFacet& facet, const Eigen::Vector3d& x);
// Whether two points lie on one of its edges.
bool IsOnEdge(const PlacedFacet& facet, const Eigen::Vector3d& u, const Eigen::Vector3d& v);
// Whether it passes through a triangle that lies on another facet, deeper than the slack; for one
// in that plane, whether doubles leave that open.
bool PassesThrough(const PlacedFacet& facet, const PlacedFacet& own,
                   const std::array<Eigen::Vector3d, 3>& triangle);

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_CPD_PLACED_FACET_INTERNAL_H_
