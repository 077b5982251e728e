// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_MINKOWSKI_MAP_SEARCH_INTERNAL_H_
#define TOUCHSTONE_CORE_MINKOWSKI_MAP_SEARCH_INTERNAL_H_

#include <Eigen/Core>
#include <algorithm>
#include <span>
#include <vector>

#include "touchstone/core/minkowski/convex_map.h"

namespace touchstone::internal {

// Whether two arcs shorter than half a circle meet. One passes the other to its left, or to its
// right, by the least of four signs' values; if that is negative, it does not, by as much. Zero
// counts as meeting.
struct ArcCrossing {
  double to_left, to_right;

  // The smallest change of a value that makes a difference.
  double slack() const { return std::min(std::abs(to_left), std::abs(to_right)); }
};

// Of the arc from p to q, counterclockwise round `pole`, and the one from r to s round
// `other_pole`: which way the second passes the first.
inline ArcCrossing CrossingOf(const Eigen::Vector3d& p, const Eigen::Vector3d& q,
                              const Eigen::Vector3d& pole, const Eigen::Vector3d& r,
                              const Eigen::Vector3d& s, const Eigen::Vector3d& other_pole) {
  const double at_r = pole.dot(r), at_s = pole.dot(s);
  const double at_p = other_pole.dot(p), at_q = other_pole.dot(q);
  return {std::min(std::min(-at_r, at_s), std::min(at_p, -at_q)),
          std::min(std::min(at_r, -at_s), std::min(-at_p, at_q))};
}

// Finds what lies near points and arcs of the sphere in a convex map. `margin` bounds the error of
// every sign's value; what is found is what may lie within `radius` of the point or arc, which is
// at least the margin, and some more. Storage is used again.
class MapSearch {
 public:
  explicit MapSearch(const ConvexMap& map);

  // Walks to x from region `start`. Afterwards regions() holds all regions with a point within
  // `radius` of x, beginning with where the walk ended.
  void FindPoint(const Eigen::Vector3d& x, int start, double margin, double radius);

  // Afterwards edges() holds all edges that the arc from p to q meets, counterclockwise round
  // `pole`, or can meet when each sign's value changes by less than `radius`. The walk to p begins
  // in region `start`; regions() begins with where it ended.
  void FindArc(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Eigen::Vector3d& pole,
               int start, double margin, double radius);

  std::span<const int> regions() const { return regions_; }
  std::span<const int> edges() const { return edges_; }

 private:
  // A side of a region: the edge's pole, pointing into the region.
  struct Border {
    Eigen::Vector3d inward;
    int edge, across;
  };

  std::span<const Border> BordersOf(int region) const {
    return {borders_.data() + begin_[region], borders_.data() + begin_[region + 1]};
  }
  // As ConvexMap::Walk.
  int Walk(const Eigen::Vector3d& x, int start, double margin) const;
  void Visit(int region);

  const ConvexMap& map_;
  std::vector<int> begin_;
  std::vector<Border> borders_;
  std::vector<int> region_marks_, edge_marks_;
  int mark_ = 0;
  std::vector<int> regions_, edges_;
};

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_MINKOWSKI_MAP_SEARCH_INTERNAL_H_
