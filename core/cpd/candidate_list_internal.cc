// SPDX-License-Identifier: MIT
#include "touchstone/core/cpd/candidate_list_internal.h"

#include <bit>
#include <cmath>

#include "touchstone/core/cpd/contact_signs_internal.h"
#include "touchstone/core/cpd/placed_facet_internal.h"
#include "touchstone/core/minkowski/convolution.h"

namespace touchstone::internal {

using Eigen::Vector3d;

bool CandidateList::Covers(const MeshPair& pair, const Vector3d& center, double radius) const {
  if (!is_made_ || scale_ != pair.scale()) return false;
  const MotionBound motion = MotionOfB(pair, pose_);
  return motion.distance <= distance_ && motion.angle <= angle_ &&
         (center - center_).norm() + radius <= radius_;
}

void CandidateList::Make(const MeshPair& pair, const ContactBody& a, const ContactBody& b,
                         const Vector3d& center, double radius, double room, double distance,
                         double angle) {
  is_made_ = true;
  pose_ = pair.pose();
  scale_ = pair.scale();
  center_ = center;
  radius_ = radius + room;
  distance_ = distance;
  angle_ = angle;
  facets_.clear();
  const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity();
  const RelativePose& pose = pair.pose();
  const FeatureTree* of_a[] = {&a.faces(), &a.vertices(), &a.convex_edges()};
  const FeatureTree* of_b[] = {&b.vertices(), &b.faces(), &b.convex_edges()};
  for (int k = 0; k < 3; ++k) {
    trees_a_[k].Place(*of_a[k], identity, Vector3d::Zero(), scale_);
    trees_b_[k].Place(*of_b[k], pose.rotation(), pose.translation(), scale_, distance, angle);
    AddPairs(pair, a, b, static_cast<SumFacetKind>(k));
  }
}

void CandidateList::AddPairs(const MeshPair& pair, const ContactBody& body_a,
                             const ContactBody& body_b, SumFacetKind kind) {
  PlacedFeatureTree &tree_a = trees_a_[static_cast<int>(kind)],
                    &tree_b = trees_b_[static_cast<int>(kind)];
  if (tree_a.empty() || tree_b.empty()) return;
  const Vector3d reach = Vector3d::Constant(radius_ + distance_ + 4.0 * kPatchSlack);
  const Vector3d low = center_ - reach, high = center_ + reach;
  stack_.assign(1, {0, 0});
  while (!stack_.empty()) {
    const auto [code_a, code_b] = stack_.back();
    stack_.pop_back();
    const FeatureLanes lanes_a = tree_a.lanes(code_a), lanes_b = tree_b.lanes(code_b);
    const PlacedFeatureNode &a = *lanes_a.node, &b = *lanes_b.node;
    std::uint8_t masks[kFeatureTreeWidth];
    MeetingFeatures(lanes_a, lanes_b, {radius_, -radius_, center_}, masks);
    for (int j = 0; j < b.lane_count; ++j) {
      for (unsigned mask = masks[j]; mask != 0; mask &= mask - 1) {
        const int i = std::countr_zero(mask);
        const int child_a = a.children[i], child_b = b.children[j];
        if (child_a < 0 && child_b < 0) {
          const SumFacet facet = {kind, false, ~child_a, ~child_b};
          if (Meet(PlaceCorners(pair, facet), low, high) &&
              MaySupportEitherWay(pair, body_a, body_b, facet, angle_)) {
            facets_.push_back(facet);
          }
          continue;
        }
        stack_.emplace_back(FeatureLanes::Next(child_a, code_a, i),
                            FeatureLanes::Next(child_b, code_b, j));
      }
    }
  }
}

}  // namespace touchstone::internal
