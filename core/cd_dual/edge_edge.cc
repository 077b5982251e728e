// SPDX-License-Identifier: MIT
#include "touchstone/core/cd_dual/edge_edge.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>
#include <vector>

namespace touchstone {
namespace {

std::vector<int> EdgesOfFace(const ConvexPolyhedron& shape, int f) {
  const auto edges = shape.face_edges(f);
  return {edges.begin(), edges.end()};
}

std::vector<int> EdgesOfVertex(const ConvexPolyhedron& shape, int v) {
  const auto edges = shape.vertex_edges(v);
  std::vector<int> sorted(edges.begin(), edges.end());
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

std::vector<int> EdgesOf(const ConvexPolyhedron& shape, const Feature& feature) {
  switch (feature.kind) {
    case FeatureKind::kVertex:
      return EdgesOfVertex(shape, feature.index);
    case FeatureKind::kFace:
      return EdgesOfFace(shape, feature.index);
    case FeatureKind::kEdge:
      break;
  }
  return {feature.index};
}

class EdgePairStack {
 public:
  explicit EdgePairStack(const MinkowskiDifference& m) : m_(m) {}

  void PushAround(const FaceOfM& face) {
    const std::vector<int> of_q = EdgesOf(m_.q(), face.feature_q);
    for (const int e_p : EdgesOf(m_.p(), face.feature_p)) {
      for (const int e_q : of_q) pairs_.emplace_back(e_p, e_q);
    }
  }

  void PushNeighbors(int e_p, int e_q) {
    const Edge& in_p = m_.p().edge(e_p);
    const Edge& in_q = m_.q().edge(e_q);
    for (const int end : {in_q.tail, in_q.head}) {
      for (const int e : EdgesOfVertex(m_.q(), end)) {
        if (e != e_q) pairs_.emplace_back(e_p, e);
      }
    }
    for (const int end : {in_p.tail, in_p.head}) {
      for (const int e : EdgesOfVertex(m_.p(), end)) {
        if (e != e_p) pairs_.emplace_back(e, e_q);
      }
    }
  }

  bool empty() const { return pairs_.empty(); }
  std::pair<int, int> Pop() {
    const auto pair = pairs_.back();
    pairs_.pop_back();
    return pair;
  }

 private:
  const MinkowskiDifference& m_;
  std::vector<std::pair<int, int>> pairs_;
};

double Volume(const Eigen::Vector3d& x, const Eigen::Vector3d& y, const Eigen::Vector3d& z) {
  return x.dot(y.cross(z));
}

// The sign of a volume of three unit normals, zero where it may be rounding: each normal is off by
// a few units of 2^-52, so the volume of normals in one plane comes out below 32 of them. Without
// this, aligned edges would span faces that M does not have.
double Sign(double volume) {
  constexpr double kRounding = 32.0 * kRoundingUnit;
  return volume > kRounding ? 1.0 : volume < -kRounding ? -1.0 : 0.0;
}

}  // namespace

std::optional<FaceOfM> EdgeEdgeFace(const MinkowskiDifference& m, int e_p, int e_q,
                                    PhaseCounts* counts) {
  ++counts->arc_tests;
  const Edge& in_p = m.p().edge(e_p);
  const Edge& in_q = m.q().edge(e_q);
  const Eigen::Vector3d& a = m.p().face_normal(in_p.left);
  const Eigen::Vector3d& b = m.p().face_normal(in_p.right);
  const Eigen::Vector3d c = -m.NormalToP(m.q().face_normal(in_q.left));
  const Eigen::Vector3d d = -m.NormalToP(m.q().face_normal(in_q.right));
  const double cba = Sign(Volume(c, b, a)), dba = Sign(Volume(d, b, a));
  if (!(cba * dba < 0.0)) return std::nullopt;
  const double adc = Sign(Volume(a, d, c)), bdc = Sign(Volume(b, d, c));
  if (!(adc * bdc < 0.0) || !(cba * bdc > 0.0)) return std::nullopt;

  const Eigen::Vector3d along_p = m.p().vertex(in_p.head) - m.p().vertex(in_p.tail);
  const Eigen::Vector3d along_q = m.EdgeToP(m.q().vertex(in_q.head) - m.q().vertex(in_q.tail));
  Eigen::Vector3d normal = (m.scale() * along_p).cross(m.scale() * along_q);
  if (normal.dot(a + b) < 0.0) normal = -normal;
  const VertexPair corner{in_p.tail, in_q.tail};
  return FaceOfM{FaceClass::kEdgeEdge,
                 {FeatureKind::kEdge, e_p},
                 {FeatureKind::kEdge, e_q},
                 corner,
                 normal,
                 SignedDistance(m, normal, normal.dot(m.Point(corner)))};
}

FaceOfM SearchEdgeEdge(const MinkowskiDifference& m, const FaceOfM& start, bool early_exit,
                       SearchLog* log, std::optional<FaceOfM>* best_of_class) {
  PhaseCounts* counts = &log->of(Phase::kEdgeEdge);
  FaceOfM best = start;
  EdgePairStack stack(m);
  if (start.face_class == FaceClass::kEdgeEdge) {
    stack.PushNeighbors(start.feature_p.index, start.feature_q.index);
  } else {
    stack.PushAround(start);
  }
  while (!stack.empty() && !(early_exit && best.signed_distance > 0.0)) {
    const auto [e_p, e_q] = stack.Pop();
    const auto face = EdgeEdgeFace(m, e_p, e_q, counts);
    if (!face) continue;
    const bool better = face->signed_distance > best.signed_distance;
    log->Visit(Phase::kEdgeEdge, *face, better);
    if (!*best_of_class || face->signed_distance > (*best_of_class)->signed_distance) {
      *best_of_class = face;
    }
    if (better) {
      best = *face;
      stack.PushNeighbors(e_p, e_q);
    }
  }
  return best;
}

}  // namespace touchstone
