// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_CD_DUAL_FACE_OF_M_H_
#define TOUCHSTONE_CORE_CD_DUAL_FACE_OF_M_H_

#include <optional>
#include <vector>

#include "touchstone/core/cd_dual/minkowski_difference.h"

namespace touchstone {

// A face of M as the three phases see it: of class FaceVertex, VertexFace or EdgeEdge, spanned by
// one feature of each body.
//
//   paper            here
//   F(f_p, v_q)      face_class kFaceVertex, feature_p a face, feature_q a vertex
//   F(v_p, f_q)      face_class kVertexFace
//   F(e_p, e_q)      face_class kEdgeEdge
//   N, k             normal (outward, any length), n.x = k at `corner`
//   d(f)             signed_distance, in 1 / scaled length
struct FaceOfM {
  FaceClass face_class;
  Feature feature_p, feature_q;
  VertexPair corner;  // a vertex of the face
  Eigen::Vector3d normal;
  double signed_distance;
};

// d(f) = -k / (|c| (k - N.c)) for the plane N.x = k (equation 1).
double SignedDistance(const MinkowskiDifference& m, const Eigen::Vector3d& normal, double k);

// The polygon of the face: vertices of M, counterclockwise from outside.
std::vector<VertexPair> Polygon(const MinkowskiDifference& m, const FaceOfM& face);

// The triangle of the polygon's fan that the ray from c through o crosses, in doubles. If the ray
// misses the polygon, nothing, and `*violated` (if given) is the polygon's edge that it passes
// furthest outside of.
std::optional<std::array<VertexPair, 3>> CrossedTriangle(const MinkowskiDifference& m,
                                                         const std::vector<VertexPair>& polygon,
                                                         std::array<VertexPair, 2>* violated);

// Where the searches account for what they do.
struct SearchLog {
  std::array<PhaseCounts, kPhaseCount>* counts;
  std::vector<TraceStep>* trace;  // null unless wanted

  PhaseCounts& of(Phase phase) { return (*counts)[static_cast<int>(phase)]; }
  void Visit(Phase phase, const FaceOfM& face, bool accepted);
};

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_CD_DUAL_FACE_OF_M_H_
