// SPDX-License-Identifier: MIT
//
// All facets of the convolution cut against each other: stage one of the boundary. Facets in one
// plane are taken together as a group; what cuts a group are the edges of its own facets and the
// segments in which facets of other planes cross them.
#ifndef TOUCHSTONE_CORE_MINKOWSKI_ARRANGEMENT_INTERNAL_H_
#define TOUCHSTONE_CORE_MINKOWSKI_ARRANGEMENT_INTERNAL_H_

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "touchstone/core/minkowski/facet_triage_internal.h"
#include "touchstone/core/minkowski/sum_geometry_internal.h"

namespace touchstone::internal {

// A piece of a line: an edge of facets, or where two facets of different planes cross.
struct Segment {
  int facet_f = -1, facet_g = -1;  // -1: an edge of facets, which its ends name
  // Whether a crossing passes through the inside of the facet, rather than along an edge of it.
  bool is_inside_f = false, is_inside_g = false;
  int axis;                     // a coordinate that rises or falls strictly along it
  std::array<int, 2> ends;      // points, as they were made
  std::span<const int> points;  // from one end to the other, with all that lies between

  bool is_edge() const { return facet_f < 0; }
};

// A segment as a group sees it.
struct Wall {
  int segment;
  int line_plane;  // meets the group's plane in the segment's line; -1 in a group that is not cut
  int facet;       // of the group: the facet that it is an edge of, or that is crossed
  int other;       // the facet that crosses; -1 for an edge
  // For an edge: whether the facet lies on the left of the direction from points.front() on, seen
  // against the group's normal.
  bool facet_is_left;
};

struct Group {
  int plane;  // whose normal orients the group
  std::span<const int> facets;
  std::span<const Wall> walls;
  bool is_cut = true;  // false: a facet alone in its plane that nothing crosses
};

// Lists of points, facets and walls lie in one piece of memory each, at the end.
struct Arrangement {
  Arrangement() = default;
  Arrangement(Arrangement&&) = default;
  Arrangement& operator=(Arrangement&&) = default;

  std::vector<ArrangedFacet> facets;
  std::vector<Segment> segments;
  std::vector<Group> groups;
  // Equal points, by exact comparison, are one: the number of each point's representative.
  std::vector<int> representative;
  long box_pairs = 0, crossings = 0;

  std::vector<int> points_of_segments, facets_of_groups;
  std::vector<Wall> walls_of_groups;
};

// Cuts the facets. Points on segments are complete, sorted, and representatives.
//
// Complexity: O(n log n + k + sum over groups of w^2) for k pairs of facets whose boxes meet and
// w walls of a group.
Arrangement Arrange(SumGeometry* geometry, std::span<const SumFacet> facets);

// The same of some facets, called active. Others only cut them: a group with no active facet gets
// no walls. Of an active facet everything is as above, given all facets that meet it, and all pairs
// f < g of an active one and another that may meet, but where both name what they share.
Arrangement Arrange(SumGeometry* geometry, std::span<const SumFacet> facets,
                    std::span<const char> is_active, std::span<const std::pair<int, int>> near);

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_MINKOWSKI_ARRANGEMENT_INTERNAL_H_
