// SPDX-License-Identifier: MIT
//
// A first look at two facets: which pairs certainly do not cut each other, as far as doubles and
// names tell.
#ifndef TOUCHSTONE_CORE_MINKOWSKI_FACET_TRIAGE_INTERNAL_H_
#define TOUCHSTONE_CORE_MINKOWSKI_FACET_TRIAGE_INTERNAL_H_

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "touchstone/core/minkowski/sum_geometry_internal.h"

namespace touchstone::internal {

struct ArrangedFacet {
  SumFacet name;
  std::array<int, 4> corners;  // points, counterclockwise from outside; the last again if three
  int count;
  int plane;
};

// The sides of another plane that a facet's corners lie on.
using CornerSides = std::array<signed char, 4>;

// Facets' planes and corners side by side, for a first look at many pairs.
class FacetTriage {
 public:
  FacetTriage(const SumGeometry& geometry, std::span<const ArrangedFacet> facets);

  // Whether all corners of facet g lie strictly on one side of f's plane; false if doubles cannot
  // tell.
  bool IsClear(int f, int g) const;
  // The sides of f's plane that g's corners lie on; 0 where doubles cannot tell.
  CornerSides SidesOf(int f, int g) const;
  // As IsClear, of all corners but one, which lies in f's plane by its name.
  bool IsClearBut(int f, int g, int corner, std::span<const int> corners_of_g) const;

 private:
  struct Entry {
    Eigen::Vector3d normal;
    double offset, bound;
    double corners[3][4];
  };
  std::vector<Entry> entries_;
};

// How many corners two facets have in common, by their names; and where the last one is in each.
struct SharedCorners {
  int count = 0, place_x = -1, place_y = -1;
};
SharedCorners FindSharedCorners(const ArrangedFacet& x, const ArrangedFacet& y);

// Of facets that share one corner: whether the plane through an edge of one of them at that corner
// and parallel to a coordinate axis parts what else there is of it from all of the other but the
// corner.
bool PartAtCorner(const SumGeometry& geometry, const ArrangedFacet& x, const ArrangedFacet& y,
                  const SharedCorners& shared);

// Whether the facets share an edge that they pass in opposite senses, and certainly face more or
// less the same way: if their planes are one they lie on either side of the edge, else they share
// no more than it. Neither cuts the other, and a plane may have two names.
bool LieAcrossAnEdge(const SumGeometry& geometry, const ArrangedFacet& x, const ArrangedFacet& y);

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_MINKOWSKI_FACET_TRIAGE_INTERNAL_H_
