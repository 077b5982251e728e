// SPDX-License-Identifier: MIT
#include "touchstone/core/cd_dual/vertex_face.h"

#include "touchstone/core/cd_dual/steepest_ascent_internal.h"
#include "touchstone/core/convex/support.h"

namespace touchstone {

FaceOfM VertexFaceFace(const MinkowskiDifference& m, int f, int hint, PhaseCounts* counts) {
  const Eigen::Vector3d normal = -m.NormalToP(m.q().face_normal(f));
  ++counts->support_calls;
  const int v = SupportVertex(m.p(), normal, hint, &counts->climb_steps);
  const VertexPair corner{v, m.q().face(f)[0]};
  return {FaceClass::kVertexFace,
          {FeatureKind::kVertex, v},
          {FeatureKind::kFace, f},
          corner,
          normal,
          SignedDistance(m, normal, normal.dot(m.Point(corner)))};
}

FaceOfM SearchVertexFace(const MinkowskiDifference& m, int start, int hint, bool early_exit,
                         SearchLog* log) {
  PhaseCounts* counts = &log->of(Phase::kVertexFace);
  return SteepestAscent(
      m.q(), VertexFaceFace(m, start, hint, counts), Phase::kVertexFace, early_exit, log,
      [](const FaceOfM& face) { return face.feature_q.index; },
      [&](int f, const FaceOfM& from) { return VertexFaceFace(m, f, from.corner.p, counts); });
}

}  // namespace touchstone
