// SPDX-License-Identifier: MIT
//
// Which candidates of gap filling may cut each other, and how far B may turn before others can.
//
// What parts two facets at one pose, an axis between their boxes or the plane of one of them, parts
// them by a gap that shrinks no faster than B turns. Whether they support has no say in it.
#ifndef TOUCHSTONE_CORE_MINKOWSKI_GAP_PAIRS_INTERNAL_H_
#define TOUCHSTONE_CORE_MINKOWSKI_GAP_PAIRS_INTERNAL_H_

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "touchstone/core/mesh/mesh_pair.h"
#include "touchstone/core/minkowski/box_lanes_internal.h"
#include "touchstone/core/minkowski/convolution.h"
#include "touchstone/core/minkowski/gather_internal.h"

namespace touchstone::internal {

// Named as a facet; `is_along_cross` is set where they always support.
struct GapCandidate {
  SumFacet facet;
  bool always_supports;  // at all poses within the padding
  bool may_meet_ball;    // at one of them
};

// Two candidates, the first of which met the ball when they were listed.
struct GapPair {
  int i, j;
  double expiry;  // parted until B has travelled so far
};

class GapPairs {
 public:
  // Of candidates at the pair's pose, which are kept elsewhere. Boxes of two that meet while the
  // list of them lasts come within `spread` of each other along every axis now, and B's rotation
  // changes by `life` at most (2-norm of matrices). Complexity: O(n).
  void Begin(const MeshPair& pair, std::span<const GapCandidate> candidates, double spread,
             double life);
  // Says that B was placed anew. The pair of meshes is kept until the next call.
  void Place(const MeshPair& pair);
  // Lists the pairs of a candidate, unless they are. Complexity: O(n / 64 + k) for k that come
  // near.
  void List(int i, const SumFacet& facet);

  // Those listed that may cut each other now or later; `expiry` is brought up to date by IsParted.
  std::span<GapPair> pairs() { return pairs_; }
  bool HasExpired(const GapPair& pair) const { return !(pair.expiry > travel_); }

  // A facet of the candidate's features, which may be named the other way round than the candidate.
  const FacetCorners& CornersOf(int i, const SumFacet& facet) { return At(i, facet).corners; }

  // Whether the facets certainly share nothing at this pose, or what they share by their names.
  bool IsParted(const SumFacet& x, const SumFacet& y, GapPair* pair);

 private:
  // A candidate's features: their places in A, in B as placed when listed, each within a ball; and
  // the product of the lengths of its edges, or the length of its face's normal.
  struct Item {
    Eigen::Vector3d center_a, center_b;
    double radius_a, radius_b;
    double length;
    Box3 box;  // of its facet, when listed
  };
  // Its facet as B is placed now.
  struct Placed {
    std::uint32_t stamp = 0;
    FacetCorners corners;
    std::array<SumVertex, 4> vertices;
    Box3 box;
    Eigen::Vector3d normal;
    double normal_error, offset, bound;
  };
  struct Reach {
    double a, b;  // how far features of two candidates are apart at most, in A and in B
  };

  Placed& At(int i, const SumFacet& facet);
  Item ItemOf(const SumFacet& facet) const;
  Reach ReachOf(const GapPair& pair) const;
  void Renew(double gap, double size, double rate, const Reach& reach, GapPair* pair) const;
  double ClearanceOver(const Placed& plane, const Placed& other, int skipped) const;
  bool IsPartedByPlane(const SumFacet& x, const SumFacet& y, int skipped_x, int skipped_y,
                       GapPair* pair) const;
  bool LieAcross(GapPair* pair) const;

  const MeshPair* pair_ = nullptr;
  std::span<const GapCandidate> candidates_;
  double spread_ = 0.0, life_ = 0.0;
  Eigen::Matrix3d rotation_;
  double travel_ = 0.0;
  std::uint32_t stamp_ = 0;
  std::vector<Item> items_;
  std::vector<char> is_listed_;
  std::vector<Placed> placed_;
  std::vector<GapPair> pairs_;
  BoxLanes boxes_;
  std::vector<int> hits_;
};

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_MINKOWSKI_GAP_PAIRS_INTERNAL_H_
