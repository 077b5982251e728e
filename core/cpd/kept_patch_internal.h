// SPDX-License-Identifier: MIT
//
// A few triangles of ∂M, kept while the pose changes and nothing comes in their way: what a
// solution of the frame before was found on.
#ifndef TOUCHSTONE_CORE_CPD_KEPT_PATCH_INTERNAL_H_
#define TOUCHSTONE_CORE_CPD_KEPT_PATCH_INTERNAL_H_

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "touchstone/core/cpd/candidate_list_internal.h"
#include "touchstone/core/cpd/contact_body.h"
#include "touchstone/core/cpd/contact_signs_internal.h"
#include "touchstone/core/cpd/phong_projection.h"
#include "touchstone/core/cpd/placed_facet_internal.h"
#include "touchstone/core/cpd/vertex_normals.h"
#include "touchstone/core/mesh/membership.h"
#include "touchstone/core/minkowski/local_sum.h"

namespace touchstone::internal {

// What bounds a side of a patch's triangle: the number of a facet that passes there, or one of
// these.
inline constexpr int kDiagonalSide = -1;  // the cell goes on
inline constexpr int kEdgeSide = -2;      // an edge of the triangle's own facet

// The triangles of ∂M round one of them, number 0, by names: all that share a corner with it.
// Whether they are part of ∂M depends on the pose.
struct PatchShape {
  std::vector<SumFacet> facets;
  std::vector<SumPointName> names;  // of vertices; facet numbers are those of `facets`
  std::vector<std::array<int, 3>> triangles;
  std::vector<int> facet_of_triangle;
  std::vector<std::array<int, 3>> sides;      // from corner k to k + 1
  std::vector<std::array<bool, 3>> is_above;  // of a facet that bounds it, along that side
  std::vector<char> is_flat;                  // thinner than the slack
};

// Follows a patch from pose to pose.
//
// At a new pose its points are placed by their names, in doubles. It is still the same part of ∂M
// if all facets named support, all points lie on the facets that name them, every side has its
// wall, no triangle has turned over, no other facet passes through a triangle, and a step off one
// of them there is no overlap. All of it is decided up to kPatchSlack of the size: what is smaller
// than that is not seen. Otherwise nothing is known, and the sum must be made anew.
class KeptPatch {
 public:
  // The patch round triangle `t` of a local sum that has no border at t's corners. Nothing if it
  // cannot be followed: points in which coplanar edges cross, slivers.
  std::shared_ptr<const PatchShape> Make(const MeshPair& pair, const ContactBody& a,
                                         const ContactBody& b, const LocalSum& sum, int t);
  // Places it at the pair's pose; whether it is part of ∂M there, but for membership.
  bool Follow(const MeshPair& pair, const ContactBody& a, const ContactBody& b,
              const PatchShape& shape);

  // Places it by its names alone; whether all its facets support there and its points exist.
  bool Place(const MeshPair& pair, const ContactBody& a, const ContactBody& b,
             const PatchShape& shape) {
    return PlaceFacets(pair, a, b, shape) && PlacePoints(pair, shape);
  }

  // As placed, in true lengths. Triangle 0 has the normals of ∂M at its corners, whatever the
  // weights.
  PhongSurface Surface(const MeshPair& pair, const PatchShape& shape, NormalWeights weights);
  // The outward normal of a facet of the shape.
  const Eigen::Vector3d& NormalOf(int facet) const { return facets_[facet].normal; }

 private:
  bool PlaceFacets(const MeshPair& pair, const ContactBody& a, const ContactBody& b,
                   const PatchShape& shape);
  bool PlacePoint(const MeshPair& pair, const SumPointName& name, Eigen::Vector3d* at) const;
  bool PlacePoints(const MeshPair& pair, const PatchShape& shape);
  bool IsOnNamed(const SumPointName& name, const Eigen::Vector3d& x) const;
  bool NameByOwnFacets(const MeshPair& pair, const ContactBody& a, const ContactBody& b,
                       PatchShape* shape);
  template <class Condition>
  int FindFacet(const MeshPair& pair, const ContactBody& a, const ContactBody& b, PatchShape* shape,
                const Condition& holds);
  void MarkFlat(PatchShape* shape) const;
  bool HasWalls(const PatchShape& shape) const;
  void Bound();
  bool IsClear(const MeshPair& pair, const ContactBody& a, const ContactBody& b,
               const PatchShape& shape);
  void CoverPatch(const MeshPair& pair, const ContactBody& a, const ContactBody& b);
  bool FindWall(const MeshPair& pair, const ContactBody& a, const ContactBody& b, int triangle,
                int side, PatchShape* shape);

  std::vector<PlacedFacet> facets_;
  std::vector<Eigen::Vector3d> points_;  // scaled
  std::vector<Eigen::Vector3d> vertices_, triangle_normals_, normals_;
  Eigen::Vector3d low_, high_, center_;
  double radius_ = 0.0;
  CandidateList list_;
  std::optional<RelativePose> last_pose_;
  std::optional<MotionBound> step_;
};

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_CPD_KEPT_PATCH_INTERNAL_H_
