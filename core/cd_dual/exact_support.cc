// SPDX-License-Identifier: MIT
#include "touchstone/core/cd_dual/exact_support.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "touchstone/core/convex/support.h"

namespace touchstone {
namespace {

// The corner at the other end of the body's edge that leaves `corner` towards its neighbour k, past
// the vertices within that edge.
int FollowEdge(const ConvexPolyhedron& shape, int corner, int k) {
  int edge = shape.vertex_edges(corner)[k];
  int v = shape.vertex_neighbors(corner)[k];
  while (!shape.is_corner(v)) {
    const auto edges = shape.vertex_edges(v);
    std::size_t next = 0;
    while (!shape.is_bend(edges[next]) || edges[next] == edge) ++next;
    edge = edges[next];
    v = shape.vertex_neighbors(v)[next];
  }
  return v;
}

class Climb {
 public:
  Climb(const ExactDifference& big, const MinkowskiDifference& m, const DyadicVector& n,
        PhaseCounts* counts)
      : big_(big), m_(m), n_(n), approximate_(ToDirection(n)), counts_(counts) {}

  // From corner to corner, for only there does a local maximum mean a global one.
  int Run(Body body) const {
    const ConvexPolyhedron& shape = body == Body::kP ? m_.p() : m_.q();
    const Eigen::Vector3d local =
        body == Body::kP ? approximate_ : Eigen::Vector3d(-m_.DirectionToQ(approximate_));
    int vertex = SupportVertex(shape, local, -1, &counts_->climb_steps);
    for (bool moved = true; moved;) {
      moved = false;
      const auto neighbors = shape.vertex_neighbors(vertex);
      for (std::size_t k = 0; k < neighbors.size() && !moved; ++k) {
        if (!shape.is_bend(shape.vertex_edges(vertex)[k]) ||
            !IsFurther(body, neighbors[k], vertex)) {
          continue;
        }
        vertex = FollowEdge(shape, vertex, static_cast<int>(k));
        ++counts_->climb_steps;
        moved = true;
      }
    }
    return vertex;
  }

 private:
  bool IsFurther(Body body, int to, int from) const {
    double error = 0.0;
    const Eigen::Vector3d edge = body == Body::kP ? m_.Difference({to, 0}, {from, 0}, &error)
                                                  : m_.Difference({0, to}, {0, from}, &error);
    // Coordinates of n are at most 1 and off by 2 u: |dn.e| <= 6 u |e|, the dot product adds
    // 9 u |e|, the edge's own error 3 `error`.
    const double value = approximate_.dot(edge);
    const double bound =
        1.01 * (16.0 * kRoundingUnit * edge.cwiseAbs().maxCoeff() + 3.0 * error) + 0x1p-1000;
    if (std::abs(value) > bound) return value > 0.0;
    return Dot(n_, big_.Edge(body, to, from)).sign() > 0;
  }

  const ExactDifference& big_;
  const MinkowskiDifference& m_;
  const DyadicVector& n_;
  const Eigen::Vector3d approximate_;
  PhaseCounts* counts_;
};

}  // namespace

Eigen::Vector3d ToDirection(const DyadicVector& n) {
  int exponents[3];
  double mantissas[3];
  int largest = std::numeric_limits<int>::min();
  for (int i = 0; i < 3; ++i) {
    mantissas[i] = n[i].ToScaledDouble(&exponents[i]);
    if (mantissas[i] != 0.0) largest = std::max(largest, exponents[i]);
  }
  Eigen::Vector3d direction;
  for (int i = 0; i < 3; ++i) {
    direction[i] = mantissas[i] == 0.0 ? 0.0 : std::ldexp(mantissas[i], exponents[i] - largest);
  }
  return direction;
}

VertexPair ExactSupport(const ExactDifference& big, const MinkowskiDifference& m,
                        const DyadicVector& n, PhaseCounts* counts) {
  ++counts->support_calls;
  const Climb climb(big, m, n, counts);
  return {climb.Run(Body::kP), climb.Run(Body::kQ)};
}

}  // namespace touchstone
