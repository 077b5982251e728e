// SPDX-License-Identifier: MIT
//
// Which features may support each other, as far as doubles can tell, at a pose or after B has
// turned by no more than an angle from there; and how far a motion goes.
#ifndef TOUCHSTONE_CORE_CPD_CONTACT_SIGNS_INTERNAL_H_
#define TOUCHSTONE_CORE_CPD_CONTACT_SIGNS_INTERNAL_H_

#include "touchstone/core/base/relative_pose.h"
#include "touchstone/core/cpd/contact_body.h"
#include "touchstone/core/mesh/mesh_pair.h"
#include "touchstone/core/minkowski/sum_facet.h"

namespace touchstone::internal {

// Whether doubles leave it open that the vertex's solid lies on the outer side of the face.
bool MayRest(const PlacedMesh& own, int face, const PlacedMesh& other, const GaussMap& map,
             int vertex, double angle = 0.0);

// The senses (SumFacet::is_along_cross) in which doubles leave it open that two edges support each
// other.
struct EdgeSenses {
  bool along = false, against = false;
};
EdgeSenses MayCross(const MeshPair& pair, const ContactBody& a, int edge_a, const ContactBody& b,
                    int edge_b, double angle = 0.0);

// Whether doubles leave it open that a facet is one of the convolution.
bool MaySupport(const MeshPair& pair, const ContactBody& a, const ContactBody& b,
                const SumFacet& facet, double angle = 0.0);

// The same for edges in either sense.
bool MaySupportEitherWay(const MeshPair& pair, const ContactBody& a, const ContactBody& b,
                         const SumFacet& facet, double angle = 0.0);

// How far B's points move from one pose to another, scaled, and how far it turns, at most; by
// default to the pair's. Both are distances of poses: the triangle inequality holds.
struct MotionBound {
  double distance, angle;
};
MotionBound MotionOfB(const MeshPair& pair, const RelativePose& from, const RelativePose& to);
inline MotionBound MotionOfB(const MeshPair& pair, const RelativePose& from) {
  return MotionOfB(pair, from, pair.pose());
}

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_CPD_CONTACT_SIGNS_INTERNAL_H_
