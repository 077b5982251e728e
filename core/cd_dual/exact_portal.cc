// SPDX-License-Identifier: MIT
#include "touchstone/core/cd_dual/exact_portal.h"

#include <cassert>
#include <cmath>
#include <optional>

#include "touchstone/core/convex/support.h"

namespace touchstone {
namespace {

struct PortalPoint {
  VertexPair pair;
  DyadicVector from_c;  // a = v - c
};
using Portal = std::array<PortalPoint, 3>;

class ExactPortalSearch {
 public:
  ExactPortalSearch(Signs* signs, PhaseCounts* counts)
      : m_(signs->difference()),
        big_(signs->exact()),
        c_(big_.Point(kInteriorDifference)),
        counts_(counts) {
    for (int i = 0; i < 3; ++i) to_origin_[i] = -c_[i];
  }

  PortalPoint MakePoint(VertexPair pair) const { return {pair, big_.Point(pair) - c_}; }

  // The sign of det[a b r] for the perturbed r: zero only for parallel a and b.
  int Side(const DyadicVector& a, const DyadicVector& b) const {
    const DyadicVector cross = Cross(a, b);
    if (const int sign = Dot(cross, to_origin_).sign()) return sign;
    for (int i = 0; i < 3; ++i) {
      if (const int sign = cross[i].sign()) return sign;
    }
    return 0;
  }

  // Does the perturbed ray cross the triangle's interior, with the triangle counterclockwise from
  // outside?
  bool IsPortal(const Portal& x) const {
    return Side(x[0].from_c, x[1].from_c) > 0 && Side(x[1].from_c, x[2].from_c) > 0 &&
           Side(x[2].from_c, x[0].from_c) > 0 &&
           Determinant(x[0].from_c, x[1].from_c, x[2].from_c).sign() > 0;
  }

  std::optional<Portal> PortalFrom(const std::array<VertexPair, 3>& start) const {
    for (const VertexPair& pair : start) {
      if (pair.p < 0 || pair.q < 0) return std::nullopt;
    }
    const Portal portal = {MakePoint(start[0]), MakePoint(start[1]), MakePoint(start[2])};
    if (IsPortal(portal)) return portal;
    return std::nullopt;
  }

  // p_i - q0 for the vertices of P are points of M around c = p0 - q0: the ray leaves P - q0
  // through exactly one triangle of the fans of P's faces.
  Portal PortalThroughP() const {
    const ConvexPolyhedron& p = m_.p();
    for (int f = 0; f < p.face_count(); ++f) {
      const auto loop = p.face(f);
      PortalPoint first = MakePoint({loop[0], kInteriorPoint});
      PortalPoint previous = MakePoint({loop[1], kInteriorPoint});
      for (std::size_t k = 2; k < loop.size(); ++k) {
        PortalPoint next = MakePoint({loop[k], kInteriorPoint});
        const Portal portal = {first, previous, next};
        if (IsPortal(portal)) return portal;
        previous = std::move(next);
      }
    }
    assert(false);  // c is strictly inside: some face is crossed
    return {};
  }

  // The corner at the other end of the body's edge that leaves `corner` towards its neighbour k,
  // past the vertices within that edge.
  static int FollowEdge(const ConvexPolyhedron& shape, int corner, int k) {
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

  // A corner of the body that is extreme along n: a climb in doubles, finished by exact signs. From
  // corner to corner, for only there does a local maximum mean a global one.
  int Support(Body body, const DyadicVector& n) const {
    const ConvexPolyhedron& shape = body == Body::kP ? m_.p() : m_.q();
    const Eigen::Vector3d approximate = ToDirection(n);
    const Eigen::Vector3d local =
        body == Body::kP ? approximate : Eigen::Vector3d(-m_.DirectionToQ(approximate));
    ++counts_->support_calls;
    int vertex = SupportVertex(shape, local, -1, &counts_->climb_steps);
    for (bool moved = true; moved;) {
      moved = false;
      const auto neighbors = shape.vertex_neighbors(vertex);
      for (std::size_t k = 0; k < neighbors.size() && !moved; ++k) {
        if (!shape.is_bend(shape.vertex_edges(vertex)[k]) ||
            !IsFurther(body, n, approximate, neighbors[k], vertex)) {
          continue;
        }
        vertex = FollowEdge(shape, vertex, static_cast<int>(k));
        ++counts_->climb_steps;
        moved = true;
      }
    }
    return vertex;
  }

  ExactExit Run(Portal portal) {
    for (;;) {
      ++counts_->faces_visited;
      const DyadicVector n =
          Cross(portal[1].from_c - portal[0].from_c, portal[2].from_c - portal[0].from_c);
      const PortalPoint beyond = MakePoint({Support(Body::kP, n), Support(Body::kQ, n)});
      if (Dot(n, beyond.from_c - portal[0].from_c).sign() == 0) {
        return {{portal[0].pair, portal[1].pair, portal[2].pair},
                Dot(n, portal[0].from_c + c_).sign()};
      }
      const int s0 = Side(beyond.from_c, portal[0].from_c);
      const int s1 = Side(beyond.from_c, portal[1].from_c);
      const int s2 = Side(beyond.from_c, portal[2].from_c);
      if (s0 > 0 && s1 < 0) {
        portal[2] = beyond;
      } else if (s1 > 0 && s2 < 0) {
        portal[0] = beyond;
      } else {
        assert(s2 > 0 && s0 < 0);
        portal[1] = beyond;
      }
    }
  }

 private:
  // n up to a power of two and one rounding in each coordinate.
  static Eigen::Vector3d ToDirection(const DyadicVector& n) {
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

  bool IsFurther(Body body, const DyadicVector& n, const Eigen::Vector3d& approximate, int to,
                 int from) const {
    double error = 0.0;
    const Eigen::Vector3d edge = body == Body::kP ? m_.Difference({to, 0}, {from, 0}, &error)
                                                  : m_.Difference({0, to}, {0, from}, &error);
    // Coordinates of n are at most 1 and off by 2 u: |dn.e| <= 6 u |e|, the dot product adds
    // 9 u |e|, the edge's own error 3 `error`.
    const double value = approximate.dot(edge);
    const double bound =
        1.01 * (16.0 * kRoundingUnit * edge.cwiseAbs().maxCoeff() + 3.0 * error) + 0x1p-1000;
    if (std::abs(value) > bound) return value > 0.0;
    return Dot(n, big_.Edge(body, to, from)).sign() > 0;
  }

  const MinkowskiDifference& m_;
  const ExactDifference& big_;
  DyadicVector c_;
  DyadicVector to_origin_;
  PhaseCounts* counts_;
};

}  // namespace

ExactExit FindExactExit(Signs* signs, const std::array<VertexPair, 3>& start, PhaseCounts* counts) {
  ExactPortalSearch search(signs, counts);
  auto portal = search.PortalFrom(start);
  if (!portal) portal = search.PortalThroughP();
  return search.Run(*std::move(portal));
}

}  // namespace touchstone
