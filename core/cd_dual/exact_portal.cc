// SPDX-License-Identifier: MIT
#include "touchstone/core/cd_dual/exact_portal.h"

#include <cassert>
#include <optional>

#include "touchstone/core/cd_dual/exact_support.h"

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

  ExactExit Run(Portal portal) {
    for (;;) {
      ++counts_->faces_visited;
      const DyadicVector n =
          Cross(portal[1].from_c - portal[0].from_c, portal[2].from_c - portal[0].from_c);
      const PortalPoint beyond = MakePoint(ExactSupport(big_, m_, n, counts_));
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
