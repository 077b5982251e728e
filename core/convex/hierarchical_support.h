// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_CONVEX_HIERARCHICAL_SUPPORT_H_
#define TOUCHSTONE_CORE_CONVEX_HIERARCHICAL_SUPPORT_H_

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "touchstone/core/convex/convex_polyhedron.h"

namespace touchstone {

// The hierarchical representation of Dobkin and Kirkpatrick ("A linear algorithm for determining
// the separation of convex polyhedra", 1985), which the paper climbs on: a sequence of hulls, each
// the one below without an independent set of vertices of low degree. The extreme vertex of a hull
// is that of the coarser hull above or one of its neighbours, so that a query looks at one
// neighbourhood a level: O(log n).
//
// Built to be compared: the searches use the direction table (support_table.h), which measures
// faster; README.md has the numbers.
class HierarchicalSupport {
 public:
  // Complexity: O(n). Orientations are taken in doubles: where rounding misleads them a level is a
  // little off its hull, and the climb at the finest level, which is the body itself, makes good
  // for it.
  explicit HierarchicalSupport(const ConvexPolyhedron& body);

  // A vertex that is extreme along `direction` (body frame): from the coarsest hull down to the one
  // above the body, then a climb on the body, as SupportVertex proposes it.
  int Find(const Eigen::Vector3d& direction) const;

  // The vertex the hierarchy itself ends at: extreme on the hull above the body, up to rounding.
  int FindAboveBody(const Eigen::Vector3d& direction) const;

  int level_count() const { return static_cast<int>(levels_.size()); }
  std::size_t bytes() const;

 private:
  // The graph of one hull: the neighbours of vertex v are [begin[v], begin[v + 1]) of `neighbors`,
  // vertices numbered from the coarsest hull to the finest so that each hull holds a prefix.
  struct Level {
    std::vector<std::int32_t> begin, neighbors;
  };

  double Height(std::int32_t v, const Eigen::Vector3d& n) const { return n.dot(points_[v]); }

  ConvexPolyhedron body_;
  std::vector<Eigen::Vector3d> points_;  // by the new numbers, relative to an interior point
  std::vector<std::int32_t> vertices_;   // of the body, by the new numbers
  std::vector<Level> levels_;            // coarsest first
};

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_CONVEX_HIERARCHICAL_SUPPORT_H_
