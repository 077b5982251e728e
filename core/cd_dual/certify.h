// SPDX-License-Identifier: MIT
//
// Proofs: a search proposes, these functions prove or decline. None of them searches.
#ifndef TOUCHSTONE_CORE_CD_DUAL_CERTIFY_H_
#define TOUCHSTONE_CORE_CD_DUAL_CERTIFY_H_

#include <optional>

#include "touchstone/core/cd_dual/result.h"
#include "touchstone/core/cd_dual/signs.h"

namespace touchstone {

// Proves that the whole of M lies strictly on the negative side of `direction` (P's frame, taken
// exactly), so that the bodies are separate. `support` is where climbs to the extreme vertex of M
// begin.
//
// First locally: where the climbs end is on the negative side, and on each body no
// neighbour of the corner lies further along. A convex body lies in the cone of a corner's edges,
// so a local maximum is a global one, and the test costs the corner's degree. (Not so at a vertex
// within an edge or a facet, whose neighbours may all be level while the body lies above.) Where a
// neighbour is too close to tell, the corner's margin bounds what it can matter. If that is not
// enough, every vertex is compared with the plain bound, if `scan` allows it. Returns the tier that
// proved it, or nothing; doubles only. Leaves in *support the corners that reach furthest.
std::optional<Tier> ProveSeparatingDirection(Signs* signs, const Eigen::Vector3d& direction,
                                             CornerPair* support, bool scan = true);

// Whether one bound for all points shows o = l0 c + sum li vi with l0, li > 0 over three points of
// M, as MinkowskiDifference::Point has them, counterclockwise from outside: what a proof of overlap
// costs nearly always.
bool IsClearlyEnclosing(const MinkowskiDifference& m, const std::array<Eigen::Vector3d, 3>& points);

// Proves o = l0 c + sum li vi with l0 > 0, li >= 0 over the points of `triangle`, counterclockwise
// from outside. Returns kBound or kExact for the arithmetic that was needed; nothing if it is not
// so or (kFloat) cannot be told.
std::optional<Tier> ProveEnclosingTetrahedron(Signs* signs,
                                              const std::array<VertexPair, 3>& triangle);

// Proves that the ray from c through o crosses the closed triangle, that the triangle is not flat,
// and that its plane supports M; and finds the facet's class and features by the exact dimensions
// of the two supporting features. Nothing if one of these is not so or (kFloat) cannot be told.
std::optional<ExitFace> ProveExitFace(Signs* signs, const std::array<VertexPair, 3>& triangle);

// The feature of one body that is extreme along the outward normal of `plane`, given a vertex of
// the body that one of the plane's points uses; nothing when the vertex is not extreme or not a
// corner, or (kFloat) when a tie cannot be told.
std::optional<Feature> SupportingFeature(Signs* signs, FacetPlane* plane, Body body, int vertex);

FaceClass ClassOf(FeatureKind in_p, FeatureKind in_q);

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_CD_DUAL_CERTIFY_H_
