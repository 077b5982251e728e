// SPDX-License-Identifier: MIT
#include "touchstone/core/cd_dual/phased.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "touchstone/core/cd_dual/edge_edge.h"
#include "touchstone/core/cd_dual/face_vertex.h"
#include "touchstone/core/cd_dual/vertex_face.h"
#include "touchstone/core/convex/support.h"

namespace touchstone {
namespace {

constexpr int kMaxTurns = 64;  // about one edge; each brings the plane closer, a handful suffice

int FaceHolding(const ConvexPolyhedron& shape, int v0, int v1, int v2) {
  for (const int f : shape.vertex_faces(v0)) {
    const auto loop = shape.face(f);
    const auto holds = [&](int v) { return std::find(loop.begin(), loop.end(), v) != loop.end(); };
    if (holds(v1) && holds(v2)) return f;
  }
  return -1;
}

int EdgeJoining(const ConvexPolyhedron& shape, int v0, int v1) {
  const auto neighbors = shape.vertex_neighbors(v0);
  const auto at = std::find(neighbors.begin(), neighbors.end(), v1);
  return at == neighbors.end() ? -1 : shape.vertex_edges(v0)[at - neighbors.begin()];
}

class PhasedSearch {
 public:
  PhasedSearch(const MinkowskiDifference& m, bool early_exit, SearchLog* log)
      : m_(m), early_exit_(early_exit), log_(log) {}

  PhasedOutcome Run() {
    FaceOfM best = FirstPass();
    for (;;) {
      if (early_exit_ && best.signed_distance > 0.0) {
        out_.proposal.kind = Proposal::Kind::kSeparatingDirection;
        out_.proposal.direction = best.normal;
        out_.proposal.support = m_.Corners(best.corner);
        return std::move(out_);
      }
      std::array<VertexPair, 2> edge;
      if (const auto triangle = CrossedTriangle(m_, Polygon(m_, best), &edge)) {
        return Propose(*triangle);
      }
      const auto next = TurnAbout(edge);
      const auto face = FaceThrough(next);
      // A face that is no plain pair of features (parallel features), or no gain that doubles can
      // see: name the triangle and leave the rest to the proof.
      if (!face || !(face->signed_distance > best.signed_distance)) return Propose(next);
      out_.phase = Phase::kOverlay;
      log_->Visit(Phase::kOverlay, *face, true);
      best = Reenter(*face);
    }
  }

 private:
  PhasedOutcome Propose(const std::array<VertexPair, 3>& triangle) {
    out_.proposal.kind = Proposal::Kind::kExitFacet;
    out_.proposal.triangle = triangle;
    return std::move(out_);
  }

  bool Stop(const FaceOfM& face) const { return early_exit_ && face.signed_distance > 0.0; }

  // The face around P's support along the ray whose normal is nearest to it.
  int FirstFace() {
    const Eigen::Vector3d to_origin = -m_.c();
    PhaseCounts& counts = log_->of(Phase::kFaceVertex);
    ++counts.support_calls;
    const int v = SupportVertex(m_.p(), to_origin, -1, &counts.climb_steps);
    const auto faces = m_.p().vertex_faces(v);
    return *std::max_element(faces.begin(), faces.end(), [&](int f, int g) {
      return m_.p().face_normal(f).dot(to_origin) < m_.p().face_normal(g).dot(to_origin);
    });
  }

  FaceOfM FirstPass() {
    const FaceOfM first = RunFaceVertex(FirstFace(), -1);
    if (Stop(first)) return first;
    const FaceOfM second = RunVertexFace(m_.q().vertex_faces(first.corner.q)[0], first.corner.p);
    const bool second_wins = second.signed_distance > first.signed_distance;
    out_.phase = second_wins ? Phase::kVertexFace : Phase::kFaceVertex;
    const FaceOfM& better = second_wins ? second : first;
    return Stop(better) ? better : RunEdgeEdge(better);
  }

  // The phase of the face's own class goes on from it, then SEARCH-EE from the result.
  FaceOfM Reenter(const FaceOfM& face) {
    FaceOfM best = face;
    if (face.face_class == FaceClass::kFaceVertex) {
      const FaceOfM found = RunFaceVertex(face.feature_p.index, face.corner.q);
      if (found.signed_distance > best.signed_distance) {
        best = found;
        out_.phase = Phase::kFaceVertex;
      }
    } else if (face.face_class == FaceClass::kVertexFace) {
      const FaceOfM found = RunVertexFace(face.feature_q.index, face.corner.p);
      if (found.signed_distance > best.signed_distance) {
        best = found;
        out_.phase = Phase::kVertexFace;
      }
    } else {
      Keep(2, face);
    }
    return Stop(best) ? best : RunEdgeEdge(best);
  }

  FaceOfM RunFaceVertex(int start, int hint) {
    const FaceOfM found = SearchFaceVertex(m_, start, hint, early_exit_, log_);
    out_.ran[0] = true;
    Keep(0, found);
    return found;
  }

  FaceOfM RunVertexFace(int start, int hint) {
    const FaceOfM found = SearchVertexFace(m_, start, hint, early_exit_, log_);
    out_.ran[1] = true;
    Keep(1, found);
    return found;
  }

  FaceOfM RunEdgeEdge(const FaceOfM& start) {
    const FaceOfM found = SearchEdgeEdge(m_, start, early_exit_, log_, &out_.best[2]);
    out_.ran[2] = true;
    if (found.signed_distance > start.signed_distance) out_.phase = Phase::kEdgeEdge;
    return found;
  }

  void Keep(int phase, const FaceOfM& face) {
    auto& best = out_.best[phase];
    if (!best || face.signed_distance > best->signed_distance) best = face;
  }

  // The face of M across `edge`: the plane through the edge is turned from far outside towards the
  // old face until nothing of M lies beyond it. Each round passes the plane through the support
  // along the last normal.
  std::array<VertexPair, 3> TurnAbout(const std::array<VertexPair, 2>& edge) {
    const Eigen::Vector3d v = m_.Point(edge[0]), along = m_.Point(edge[1]) - v;
    PhaseCounts& counts = log_->of(Phase::kOverlay);
    // c is on the inner side of every plane through the edge that supports M; the plane through c
    // itself, facing the ray, is where the turn starts.
    Eigen::Vector3d normal = along.cross(v - m_.c());
    VertexPair third = edge[0];
    for (int turn = 0; turn < kMaxTurns; ++turn) {
      const VertexPair beyond = m_.Support(normal, third, &counts);
      const Eigen::Vector3d w = m_.Point(beyond);
      if (beyond == third || beyond == edge[0] || beyond == edge[1] ||
          (turn > 0 && !(normal.dot(w - v) > 0.0))) {
        break;
      }
      third = beyond;
      // The ray passes outside of the edge (v, w0) of a counterclockwise polygon: across it, the
      // neighbouring face runs the edge the other way.
      normal = (w - v).cross(along);
    }
    return {edge[1], edge[0], third};
  }

  // The face of M spanned by one feature of each body that the triangle lies in, if its points
  // tell.
  std::optional<FaceOfM> FaceThrough(const std::array<VertexPair, 3>& x) {
    PhaseCounts& counts = log_->of(Phase::kOverlay);
    const auto distinct = [](int a, int b, int c) { return a != b && b != c && a != c; };
    if (x[0].q == x[1].q && x[1].q == x[2].q && distinct(x[0].p, x[1].p, x[2].p)) {
      const int f = FaceHolding(m_.p(), x[0].p, x[1].p, x[2].p);
      if (f < 0) return std::nullopt;
      return FaceVertexFace(m_, f, x[0].q, &counts);
    }
    if (x[0].p == x[1].p && x[1].p == x[2].p && distinct(x[0].q, x[1].q, x[2].q)) {
      const int f = FaceHolding(m_.q(), x[0].q, x[1].q, x[2].q);
      if (f < 0) return std::nullopt;
      return VertexFaceFace(m_, f, x[0].p, &counts);
    }
    const auto other = [](int a, int b, int c) { return a != b ? b : c; };
    const int p0 = x[0].p, p1 = other(x[0].p, x[1].p, x[2].p);
    const int q0 = x[0].q, q1 = other(x[0].q, x[1].q, x[2].q);
    if (p0 == p1 || q0 == q1) return std::nullopt;
    for (const VertexPair& pair : x) {
      if ((pair.p != p0 && pair.p != p1) || (pair.q != q0 && pair.q != q1)) return std::nullopt;
    }
    const int e_p = EdgeJoining(m_.p(), p0, p1), e_q = EdgeJoining(m_.q(), q0, q1);
    if (e_p < 0 || e_q < 0) return std::nullopt;
    return EdgeEdgeFace(m_, e_p, e_q, &counts);
  }

  const MinkowskiDifference& m_;
  const bool early_exit_;
  SearchLog* log_;
  PhasedOutcome out_;
};

}  // namespace

PhasedOutcome SearchPhased(const MinkowskiDifference& m, bool early_exit, SearchLog* log) {
  return PhasedSearch(m, early_exit, log).Run();
}

}  // namespace touchstone
