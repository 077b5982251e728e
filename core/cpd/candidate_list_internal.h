// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_CPD_CANDIDATE_LIST_INTERNAL_H_
#define TOUCHSTONE_CORE_CPD_CANDIDATE_LIST_INTERNAL_H_

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "touchstone/core/cpd/contact_body.h"
#include "touchstone/core/mesh/mesh_pair.h"
#include "touchstone/core/minkowski/feature_tree.h"
#include "touchstone/core/minkowski/sum_facet.h"

namespace touchstone::internal {

// Pairs of features that can have a facet in a ball at any pose near the one it was made for.
class CandidateList {
 public:
  // Whether it holds what a ball, scaled, can meet at the pair's pose.
  bool Covers(const MeshPair& pair, const Eigen::Vector3d& center, double radius) const;
  // Lists for a ball, with room for the ball to grow by `room`, for B's points to move by
  // `distance`, and B to turn by `angle`.
  void Make(const MeshPair& pair, const ContactBody& a, const ContactBody& b,
            const Eigen::Vector3d& center, double radius, double room, double distance,
            double angle);
  const std::vector<SumFacet>& facets() const { return facets_; }  // edges in both senses

 private:
  void AddPairs(const MeshPair& pair, const ContactBody& body_a, const ContactBody& body_b,
                SumFacetKind kind);

  bool is_made_ = false;
  RelativePose pose_;
  double scale_ = 0.0, radius_ = 0.0, distance_ = 0.0, angle_ = 0.0;
  Eigen::Vector3d center_ = Eigen::Vector3d::Zero();
  std::vector<SumFacet> facets_;
  PlacedFeatureTree trees_a_[3], trees_b_[3];  // by kind of facet
  std::vector<std::pair<int, int>> stack_;
};

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_CPD_CANDIDATE_LIST_INTERNAL_H_
