// SPDX-License-Identifier: MIT
#include "touchstone/core/cd_dual/face_vertex.h"

#include "touchstone/core/cd_dual/steepest_ascent_internal.h"
#include "touchstone/core/convex/support.h"

namespace touchstone {

FaceOfM FaceVertexFace(const MinkowskiDifference& m, int f, int hint, PhaseCounts* counts) {
  const Eigen::Vector3d normal = m.p().face_normal(f);
  ++counts->support_calls;
  const int v = SupportVertex(m.q(), -m.DirectionToQ(normal), hint, &counts->climb_steps);
  const VertexPair corner{m.p().face(f)[0], v};
  return {FaceClass::kFaceVertex,
          {FeatureKind::kFace, f},
          {FeatureKind::kVertex, v},
          corner,
          normal,
          SignedDistance(m, normal, normal.dot(m.Point(corner)))};
}

FaceOfM SearchFaceVertex(const MinkowskiDifference& m, int start, int hint, bool early_exit,
                         SearchLog* log) {
  PhaseCounts* counts = &log->of(Phase::kFaceVertex);
  return SteepestAscent(
      m.p(), FaceVertexFace(m, start, hint, counts), Phase::kFaceVertex, early_exit, log,
      [](const FaceOfM& face) { return face.feature_p.index; },
      [&](int f, const FaceOfM& from) { return FaceVertexFace(m, f, from.corner.q, counts); });
}

int HeuristicFirstFace(const MinkowskiDifference& m) {
  const Eigen::Vector3d to_origin = -m.c();
  int best = 0;
  double best_dot = m.p().face_normal(0).dot(to_origin);
  for (int f = 1; f < m.p().face_count(); ++f) {
    const double dot = m.p().face_normal(f).dot(to_origin);
    if (dot > best_dot) {
      best_dot = dot;
      best = f;
    }
  }
  return best;
}

}  // namespace touchstone
