// SPDX-License-Identifier: MIT
//
//   paper        here              meaning, in A's frame
//   M°                             int A ⊕ -int B: x lies in it iff the interiors of A and B + x
//                                  meet
//   ∂M           SumBoundary       closure(M°) minus M°
#ifndef TOUCHSTONE_CORE_MINKOWSKI_SUM_BOUNDARY_H_
#define TOUCHSTONE_CORE_MINKOWSKI_SUM_BOUNDARY_H_

#include <Eigen/Core>
#include <array>
#include <vector>

#include "touchstone/core/minkowski/sum_facet.h"
#include "touchstone/core/minkowski/sum_point_name.h"

namespace touchstone {

// A connected piece of the closed surface.
struct SumComponent {
  int vertex_count = 0, edge_count = 0, triangle_count = 0;
  int euler_characteristic() const { return vertex_count - edge_count + triangle_count; }
};

struct SumBoundary {
  // Points by name, facets by their numbers in `facets`, and their roundings: coordinates here are
  // rounded, each within `rounding` of the exact one; what is built on them is exact.
  std::vector<SumPointName> names;
  std::vector<Eigen::Vector3d> vertices;
  double rounding = 0.0;

  // The convolution; each triangle is a piece of the facet that it names.
  std::vector<SumFacet> facets;

  // The boundary of the closure of M°: a closed surface, counterclockwise seen from outside.
  std::vector<std::array<int, 3>> triangles;
  std::vector<int> facet_of_triangle;
  std::vector<int> component_of_triangle;
  std::vector<SumComponent> components;

  // What of ∂M has M° all around it, which a slot that is filled exactly leaves: triangles with M°
  // on either side, segments, and points.
  std::vector<std::array<int, 3>> sheets;
  std::vector<int> facet_of_sheet;
  std::vector<std::array<int, 2>> segments;
  std::vector<int> points;

  // Counts of the work done, and of what should not be: 0 each, or the geometry was no pair of
  // embedded surfaces.
  long facet_pairs = 0, crossings = 0, cells = 0, patches = 0, memberships = 0, exact_signs = 0;
  int border_edges = 0;  // edges of the surface that triangles do not run both ways equally often
  int detached_patches = 0;  // patches that membership calls separate
};

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_MINKOWSKI_SUM_BOUNDARY_H_
