// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_MINKOWSKI_MAP_SEARCH_INTERNAL_H_
#define TOUCHSTONE_CORE_MINKOWSKI_MAP_SEARCH_INTERNAL_H_

#include <Eigen/Core>
#include <span>
#include <vector>

#include "touchstone/core/minkowski/convex_map.h"

namespace touchstone::internal {

// Finds what points and arcs of the sphere meet in a convex map, and by how much the signs that
// this rests on may change without changing it. `margin` bounds the error of every sign's value.
// Storage is used again.
class MapSearch {
 public:
  explicit MapSearch(const ConvexMap& map)
      : map_(map), region_marks_(map.vertex_count(), 0), edge_marks_(map.edge_count(), 0) {}

  // Where x lies, walking from region `start`. Afterwards regions() holds the region, or, where the
  // margin cannot tell, all regions that x lies in or on the border of, and more. Returns how much
  // the signs may change; nothing positive: the margin cannot tell.
  double FindPoint(const Eigen::Vector3d& x, int start, double margin);

  // What the arc from p to q meets, counterclockwise round `pole`. p lies in region `start`, or, if
  // that is not decided, where a walk from there leads. Afterwards edges() holds all edges that the
  // arc meets and, where the margin cannot tell, more. Returns as above.
  double FindArc(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Eigen::Vector3d& pole,
                 int start, bool is_start_decided, double margin);

  std::span<const int> regions() const { return regions_; }
  std::span<const int> edges() const { return edges_; }

 private:
  void Begin();
  void Visit(int region);

  const ConvexMap& map_;
  std::vector<int> region_marks_, edge_marks_;
  int mark_ = 0;
  std::vector<int> regions_, edges_;
};

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_MINKOWSKI_MAP_SEARCH_INTERNAL_H_
