// SPDX-License-Identifier: MIT
//
// Which facets of the convolution matter in a ball: those that meet it, and those that meet such.
#ifndef TOUCHSTONE_CORE_MINKOWSKI_GATHER_INTERNAL_H_
#define TOUCHSTONE_CORE_MINKOWSKI_GATHER_INTERNAL_H_

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "touchstone/core/mesh/box_tree.h"
#include "touchstone/core/mesh/mesh_pair.h"
#include "touchstone/core/minkowski/box_lanes_internal.h"
#include "touchstone/core/minkowski/convolution.h"
#include "touchstone/core/minkowski/local_assembly_internal.h"
#include "touchstone/core/minkowski/support_signs_internal.h"

namespace touchstone::internal {

// Doubles near the corners of a facet, scaled.
struct FacetCorners {
  std::array<Eigen::Vector3d, 4> points;
  int count;
};
FacetCorners RoundedCorners(const MeshPair& pair, const SumFacet& facet);
// A box that holds the facet: widened by the roundings.
Box3 BoxOf(const MeshPair& pair, const FacetCorners& corners);
bool MeetsBall(const FacetCorners& corners, const ScaledBall& ball);

// Boxes of the facets that meet the ball, to be asked which others come near any of them.
// Complexity of a question: O(n) for what is near all of them together, O(1) elsewhere.
class NearBoxes {
 public:
  void Clear() { boxes_.Clear(); }
  void Add(const Box3& box);
  bool empty() const { return boxes_.empty(); }
  bool MeetsAny(const Box3& box) const;
  // Appends the numbers of those that it meets, as they were added.
  void Meeting(const Box3& box, std::vector<int>* hits) const;
  // False: it meets none. O(1).
  bool MayMeetAny(const Box3& box) const;
  // A box that holds all.
  const Box3& all() const { return all_; }

 private:
  BoxLanes boxes_;
  Box3 all_;
};

// Facets as they are found, in any order, and which of them are near each other.
class FacetGathering {
 public:
  void Clear();
  // The number of the facet added.
  int Add(const SumFacet& facet, bool is_active);
  // Of two facets added, one of them active.
  void AddNear(int f, int g) { near_.emplace_back(f, g); }
  // Puts them in order.
  void MoveTo(GatheredFacets* gathered);

 private:
  struct Found {
    SumFacet facet;
    int number;
    bool is_active;
  };
  std::vector<Found> found_;
  std::vector<std::pair<int, int>> near_;
  std::vector<int> place_of_number_;
};

// Of a sorted list of facets those that matter. Requires all of the convolution, or enough of it.
void SelectFacets(const MeshPair& pair, std::span<const SumFacet> facets, const ScaledBall& ball,
                  NearBoxes* near, FacetGathering* gathering);

// The facet of two features, given as its kind and their numbers, if they support each other.
std::optional<SumFacet> SupportedFacet(SupportSigns* signs, const TriangleMesh& a,
                                       const TriangleMesh& b, const SumFacet& candidate);

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_MINKOWSKI_GATHER_INTERNAL_H_
