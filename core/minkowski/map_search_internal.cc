// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/map_search_internal.h"

#include <Eigen/Geometry>

namespace touchstone::internal {

using Eigen::Vector3d;

MapSearch::MapSearch(const ConvexMap& map)
    : map_(map), region_marks_(map.vertex_count(), 0), edge_marks_(map.edge_count(), 0) {
  for (int v = 0; v < map.vertex_count(); ++v) {
    begin_.push_back(static_cast<int>(borders_.size()));
    for (const int e : map.vertex_edges(v)) {
      const bool is_left = map.edge(e).left == v;
      borders_.push_back({is_left ? map.pole(e) : Vector3d(-map.pole(e)), e,
                          is_left ? map.edge(e).right : map.edge(e).left});
    }
  }
  begin_.push_back(static_cast<int>(borders_.size()));
}

// A step leads to a vertex of the map that is further along x, so none comes twice.
int MapSearch::Walk(const Vector3d& x, int start, double margin) const {
  int region = start;
  while (true) {
    double least = -margin;
    int next = region;
    for (const Border& border : BordersOf(region)) {
      const double side = border.inward.dot(x);
      if (side < least) {
        least = side;
        next = border.across;
      }
    }
    if (next == region) return region;
    region = next;
  }
}

void MapSearch::Visit(int region) {
  if (region_marks_[region] == mark_) return;
  region_marks_[region] = mark_;
  regions_.push_back(region);
}

// The regions within the radius hang together across edges within it. x lies in one of them; on
// the straight way there from where the walk ended, x lies beyond every edge on the way, or on it.
// (Within the margin of all borders of a needle can be far from the needle.)
void MapSearch::FindPoint(const Vector3d& x, int start, double margin, double radius) {
  ++mark_;
  regions_.clear();
  Visit(Walk(x, start, margin));
  for (std::size_t i = 0; i < regions_.size(); ++i) {
    for (const Border& border : BordersOf(regions_[i])) {
      const double side = border.inward.dot(x);
      if (side > radius) continue;
      if (side > margin) {
        // Near the great circle: near the arc, too, unless x lies beyond one of its ends.
        const MapEdge& edge = map_.edge(border.edge);
        const Vector3d& pole = map_.pole(border.edge);
        if (pole.cross(map_.direction(edge.tail)).dot(x) < -radius ||
            map_.direction(edge.head).cross(pole).dot(x) < -radius) {
          continue;
        }
      }
      Visit(border.across);
    }
  }
}

// The arc begins where p lies, and leaves each region across an edge that it meets. So it does at
// any pose on the way to one where it is asked about: an edge that it, or p, comes to meet on that
// way is one that cannot be told from such here.
void MapSearch::FindArc(const Vector3d& p, const Vector3d& q, const Vector3d& pole, int start,
                        double margin, double radius) {
  FindPoint(p, start, margin, margin);
  edges_.clear();
  for (std::size_t i = 0; i < regions_.size(); ++i) {
    for (const Border& border : BordersOf(regions_[i])) {
      // Both ends of the arc on one side, by enough: most edges.
      const double at_p = border.inward.dot(p), at_q = border.inward.dot(q);
      if ((at_p > radius && at_q > radius) || (at_p < -radius && at_q < -radius)) continue;
      if (edge_marks_[border.edge] == mark_) continue;
      edge_marks_[border.edge] = mark_;
      const MapEdge& edge = map_.edge(border.edge);
      const ArcCrossing crossing = CrossingOf(p, q, pole, map_.direction(edge.tail),
                                              map_.direction(edge.head), map_.pole(border.edge));
      if (crossing.to_left < -radius && crossing.to_right < -radius) continue;
      edges_.push_back(border.edge);
      Visit(border.across);
    }
  }
}

}  // namespace touchstone::internal
