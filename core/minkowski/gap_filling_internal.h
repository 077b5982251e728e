// SPDX-License-Identifier: MIT
//
//   paper                       here
//   errors of the convolution   candidates that supported at the last update and no longer do
//   successors                  candidates that had not and now do
//   Observation 2               not relied upon: see below
//
// What makes it complete. The paper mends what it has and then asks whether a kept patch ends
// inside the ball; a component of ∂M that appears in the ball ends nowhere and stays unseen. Here a
// gathering is padded and carries a certificate: every pair of features that could support each
// other and come near the ball at any pose and ball within the padding of the gathering's is in the
// list. While the motion since then, by a bound and not by a measure of it, stays within the
// padding, no facet can be missing, whatever patch it lies on; when it does not, the gathering is
// made anew.
#ifndef TOUCHSTONE_CORE_MINKOWSKI_GAP_FILLING_INTERNAL_H_
#define TOUCHSTONE_CORE_MINKOWSKI_GAP_FILLING_INTERNAL_H_

#include <Eigen/Core>
#include <vector>

#include "touchstone/core/mesh/mesh_pair.h"
#include "touchstone/core/minkowski/gap_pairs_internal.h"
#include "touchstone/core/minkowski/gather_internal.h"
#include "touchstone/core/minkowski/sphere_hierarchy_internal.h"

namespace touchstone::internal {

// How far a pose and ball may be from another one, in the scaled frame.
struct Motion {
  double angle = 0.0;     // of B
  double spread = 0.0;    // by which the distance between two points of M changes at most
  double approach = 0.0;  // by which a point of M nears the ball at most
};

// Of two features, at all poses within a padding.
enum class MaySupport { kNever, kSometimes, kAlways };

class GapFiller {
 public:
  explicit GapFiller(const TriangleMesh& b);

  // Candidates that hold every facet that meets the ball, and every one that meets such a facet.
  // Complexity: O(1) while the motion since the last gathering stays within the padding, else that
  // of a gathering; both per candidate.
  const std::vector<GapCandidate>& Candidates(const MeshPair& pair, const GaussMap& map_a,
                                              const GaussMap& map_b, const ScaledBall& ball,
                                              SphereHierarchy* hierarchy);
  // Which of them may cut each other; null where the list will not last long enough to repay them.
  GapPairs* pairs() { return keeps_pairs_ ? &pairs_ : nullptr; }
  long gatherings() const { return gatherings_; }

 private:
  struct Frame {
    Eigen::Matrix3d rotation;
    Eigen::Vector3d way;  // from the ball's centre to minus the middle of B, scaled
    double radius, scale;
  };
  Frame FrameOf(const MeshPair& pair, const ScaledBall& ball) const;
  Motion MotionBetween(const Frame& x, const Frame& y) const;
  bool IsWithinPadding(const Motion& motion) const;
  void ChoosePadding(const Motion& step, const ScaledBall& ball);
  void Gather(const MeshPair& pair, const GaussMap& map_a, const GaussMap& map_b,
              const ScaledBall& ball, SphereHierarchy* hierarchy);
  // Sets the facet's `is_along_cross`.
  MaySupport Triage(const MeshPair& pair, const GaussMap& map_a, const GaussMap& map_b,
                    SumFacet* candidate) const;
  MaySupport TriageFaceVertex(const PlacedMesh& of_face, int face, const PlacedMesh& of_vertex,
                              const GaussMap& map, int vertex) const;
  MaySupport TriageEdgeEdge(const PlacedMesh& a, int edge_a, const PlacedMesh& b, int edge_b,
                            bool* is_along_cross) const;

  Eigen::Vector3d middle_of_b_;  // in B's frame
  double radius_of_b_;           // round it
  bool has_gathered_ = false, has_last_ = false;
  Frame gathered_, last_;
  Motion padding_;
  std::vector<SumFacet> found_;
  std::vector<GapCandidate> candidates_;
  NearBoxes near_;
  GapPairs pairs_;
  bool keeps_pairs_ = false;
  long gatherings_ = 0;
};

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_MINKOWSKI_GAP_FILLING_INTERNAL_H_
