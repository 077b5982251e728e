// SPDX-License-Identifier: MIT
#include "touchstone/core/cd_dual/published.h"

#include <algorithm>

#include "touchstone/core/cd_dual/edge_edge.h"
#include "touchstone/core/cd_dual/face_vertex.h"
#include "touchstone/core/cd_dual/vertex_face.h"

namespace touchstone {

PublishedOutcome SearchPublished(const MinkowskiDifference& m, bool early_exit, SearchLog* log) {
  const auto stop = [&](const FaceOfM& face) { return early_exit && face.signed_distance > 0.0; };

  PublishedOutcome out;
  out.face = SearchFaceVertex(m, HeuristicFirstFace(m), -1, early_exit, log);
  out.phase = Phase::kFaceVertex;
  out.ran[0] = true;
  out.best[0] = out.face;
  out.stopped_early = stop(out.face);
  if (out.stopped_early) return out;

  const auto incident = m.q().vertex_faces(out.face.corner.q);
  const int first = *std::min_element(incident.begin(), incident.end());
  const FaceOfM vertex_face = SearchVertexFace(m, first, out.face.corner.p, early_exit, log);
  out.ran[1] = true;
  out.best[1] = vertex_face;
  if (vertex_face.signed_distance > out.face.signed_distance) {
    out.face = vertex_face;
    out.phase = Phase::kVertexFace;
  }
  out.stopped_early = stop(out.face);
  if (out.stopped_early) return out;

  const FaceOfM start = out.face;
  out.face = SearchEdgeEdge(m, start, early_exit, log, &out.best[2]);
  out.ran[2] = true;
  if (out.face.face_class == FaceClass::kEdgeEdge) out.phase = Phase::kEdgeEdge;
  out.stopped_early = stop(out.face);
  return out;
}

}  // namespace touchstone
