// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/map_search_internal.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace touchstone::internal {

using Eigen::Vector3d;

void MapSearch::Begin() {
  ++mark_;
  regions_.clear();
  edges_.clear();
}

void MapSearch::Visit(int region) {
  if (region_marks_[region] == mark_) return;
  region_marks_[region] = mark_;
  regions_.push_back(region);
}

double MapSearch::FindPoint(const Vector3d& x, int start, double margin) {
  Begin();
  Visit(map_.Walk(x, start, margin));
  double slack = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < regions_.size(); ++i) {
    const int region = regions_[i];
    for (const int e : map_.vertex_edges(region)) {
      const MapEdge& edge = map_.edge(e);
      const double height = map_.pole(e).dot(x);
      const double side = (edge.left == region ? height : -height) - margin;
      slack = std::min(slack, side);
      // On the straight way from the first region to where x is, it lies beyond every edge on the
      // way, or on it. Within the margin of all borders of a needle can be far from the needle.
      if (side <= 0.0) Visit(edge.left == region ? edge.right : edge.left);
    }
  }
  return slack;
}

// With sides r, s of the ends of an edge seen from the arc, and p, q of the arc's ends seen from
// the edge, the two meet iff r <= 0 <= s and q <= 0 <= p, or r >= 0 >= s and q >= 0 >= p. Each of
// the two ways is open by the least, or shut by the greatest, of four numbers.
double MapSearch::FindArc(const Vector3d& p, const Vector3d& q, const Vector3d& pole, int start,
                          bool is_start_decided, double margin) {
  double slack = std::numeric_limits<double>::infinity();
  if (is_start_decided) {
    Begin();
    Visit(start);
  } else {
    slack = FindPoint(p, start, margin);
  }
  for (std::size_t i = 0; i < regions_.size(); ++i) {
    const int region = regions_[i];
    for (const int e : map_.vertex_edges(region)) {
      if (edge_marks_[e] == mark_) continue;
      edge_marks_[e] = mark_;
      const MapEdge& edge = map_.edge(e);
      const double r = pole.dot(map_.direction(edge.tail)), s = pole.dot(map_.direction(edge.head));
      const double at_p = map_.pole(e).dot(p), at_q = map_.pole(e).dot(q);
      const double to_left = std::min(std::min(-r, s), std::min(at_p, -at_q));
      const double to_right = std::min(std::min(r, -s), std::min(-at_p, at_q));
      slack = std::min(slack, std::min(std::abs(to_left), std::abs(to_right)) - margin);
      if (to_left < -margin && to_right < -margin) continue;
      edges_.push_back(e);
      Visit(edge.left == region ? edge.right : edge.left);
    }
  }
  return slack;
}

}  // namespace touchstone::internal
