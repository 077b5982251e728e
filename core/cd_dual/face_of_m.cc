// SPDX-License-Identifier: MIT
#include "touchstone/core/cd_dual/face_of_m.h"

#include <Eigen/Geometry>
namespace touchstone {

double SignedDistance(const MinkowskiDifference& m, const Eigen::Vector3d& normal, double k) {
  return -k / (m.c_norm() * (k - normal.dot(m.c())));
}

std::vector<VertexPair> Polygon(const MinkowskiDifference& m, const FaceOfM& face) {
  std::vector<VertexPair> polygon;
  switch (face.face_class) {
    case FaceClass::kFaceVertex:
      for (const int v : m.p().face(face.feature_p.index)) polygon.push_back({v, face.corner.q});
      break;
    case FaceClass::kVertexFace: {  // Q enters M negated: its loop turns the other way
      const auto loop = m.q().face(face.feature_q.index);
      for (auto v = loop.rbegin(); v != loop.rend(); ++v) polygon.push_back({face.corner.p, *v});
      break;
    }
    default: {
      const Edge& p = m.p().edge(face.feature_p.index);
      const Edge& q = m.q().edge(face.feature_q.index);
      polygon = {{p.tail, q.tail}, {p.head, q.tail}, {p.head, q.head}, {p.tail, q.head}};
      const Eigen::Vector3d origin = m.Point(polygon[0]);
      const Eigen::Vector3d turn =
          (m.Point(polygon[1]) - origin).cross(m.Point(polygon[3]) - origin);
      if (turn.dot(face.normal) < 0.0) std::swap(polygon[1], polygon[3]);
    }
  }
  return polygon;
}

std::optional<std::array<VertexPair, 3>> CrossedTriangle(const MinkowskiDifference& m,
                                                         const std::vector<VertexPair>& polygon,
                                                         std::array<VertexPair, 2>* violated) {
  // det[a b r] with a = v - c is det[b a c] of the points themselves: negative where the ray passes
  // outside of the edge (v, w).
  const auto side = [&](VertexPair v, VertexPair w) {
    return m.Point(w).dot(m.Point(v).cross(m.c()));
  };
  double worst = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const VertexPair v = polygon[i], w = polygon[(i + 1) % polygon.size()];
    const double length = (m.Point(w) - m.Point(v)).norm();
    const double distance = side(v, w) / length;
    if (distance < worst) {
      worst = distance;
      if (violated) *violated = {v, w};
    }
  }
  if (worst < 0.0) return std::nullopt;
  for (std::size_t i = 2; i + 1 < polygon.size(); ++i) {
    if (side(polygon[0], polygon[i]) <= 0.0) return {{polygon[0], polygon[i - 1], polygon[i]}};
  }
  return {{polygon[0], polygon[polygon.size() - 2], polygon.back()}};
}

void SearchLog::Visit(Phase phase, const FaceOfM& face, bool accepted) {
  ++of(phase).faces_visited;
  if (trace) {
    trace->push_back(
        {phase, face.face_class, face.feature_p, face.feature_q, face.signed_distance, accepted});
  }
}

}  // namespace touchstone
