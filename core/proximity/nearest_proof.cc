// SPDX-License-Identifier: MIT
#include "touchstone/core/proximity/nearest_proof.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <span>
#include <tuple>
#include <utility>

#include "touchstone/core/cd_dual/certify.h"
#include "touchstone/core/cd_dual/exact_support.h"
#include "touchstone/core/proximity/estimate_internal.h"
#include "touchstone/core/proximity/signs_of_points.h"

namespace touchstone {
namespace {

using internal::DifferenceOf;
using internal::Dot;
using internal::EstimateVector;
using internal::PointOf;

DyadicVector Scaled(const Dyadic& s, const DyadicVector& v) {
  return {s * v[0], s * v[1], s * v[2]};
}

DyadicVector Negated(const DyadicVector& v) { return {-v[0], -v[1], -v[2]}; }

std::optional<NearestProof> ProveTriangle(Signs* signs, const Simplex& simplex) {
  NearestProof proof{simplex, {}, {}};
  auto& w = proof.simplex.points;
  const auto side = signs->Determinant(w[0], w[1], w[2]);
  if (!side || *side == 0) return std::nullopt;
  if (*side > 0) std::swap(w[1], w[2]);
  FacetPlane plane = signs->Plane(w);
  for (int i = 0; i < 3; ++i) {
    const auto sign = FootSide(signs, plane, w[i], w[(i + 1) % 3]);
    if (!sign || *sign < 0) return std::nullopt;
  }
  const auto in_p = SupportingFeature(signs, &plane, Body::kP, w[0].p);
  if (!in_p) return std::nullopt;
  const auto in_q = SupportingFeature(signs, &plane, Body::kQ, w[0].q);
  if (!in_q) return std::nullopt;
  proof.feature_p = *in_p;
  proof.feature_q = *in_q;
  return proof;
}

// x of one or two points in doubles, negated: the outward normal there. Not proven to have positive
// weights.
EstimateVector OutwardNormal(const MinkowskiDifference& m, const Simplex& simplex) {
  EstimateVector x = PointOf(m, simplex.points[0]);
  if (simplex.size == 2) {
    const EstimateVector along = DifferenceOf(m, simplex.points[1], simplex.points[0]);
    x = x + (-Dot(along, x) / Dot(along, along)) * along;
  }
  return {-x[0], -x[1], -x[2]};
}

std::optional<NearestProof> ProveFlat(Signs* signs, const Simplex& simplex) {
  const auto& w = simplex.points;
  if (simplex.size == 2) {
    const auto at_first = AlongEdge(signs, w[1], w[0], w[0]);
    const auto at_second = AlongEdge(signs, w[1], w[0], w[1]);
    if (!at_first || !at_second || *at_first > 0 || *at_second < 0) return std::nullopt;
  }
  // A plane that no three points span: its normal is given. Signs without big numbers first, for
  // the exact normal takes longer than they do.
  const EstimateVector normal = OutwardNormal(signs->difference(), simplex);
  FacetPlane plane;
  plane.points = {w[0], w[simplex.size - 1], w[simplex.size - 1]};
  plane.normal = internal::Values(normal);
  plane.normal_error = std::max({normal[0].error, normal[1].error, normal[2].error});
  const auto prove = [&](Signs* by) -> std::optional<NearestProof> {
    const auto in_p = SupportingFeature(by, &plane, Body::kP, w[0].p);
    if (!in_p) return std::nullopt;
    const auto in_q = SupportingFeature(by, &plane, Body::kQ, w[0].q);
    if (!in_q) return std::nullopt;
    return NearestProof{simplex, *in_p, *in_q};
  };
  // That o is not x itself: a normal that is certainly not zero.
  const bool apart = plane.normal.cwiseAbs().maxCoeff() > plane.normal_error;
  if (apart) {
    Signs in_doubles(signs->difference(), Certainty::kFloat);
    if (auto proof = prove(&in_doubles)) return proof;
  }
  if (!signs->exact_allowed()) return std::nullopt;
  signs->CountExact();
  const auto x = ExactNearest(signs->exact(), simplex);
  if (!x) return std::nullopt;
  plane.exact_normal = Negated(*x);
  return prove(signs);
}

bool IsZero(const DyadicVector& v) {
  return v[0].sign() == 0 && v[1].sign() == 0 && v[2].sign() == 0;
}

}  // namespace

std::optional<NearestProof> ProveNearest(Signs* signs, const Simplex& simplex) {
  return simplex.size == 3 ? ProveTriangle(signs, simplex) : ProveFlat(signs, simplex);
}

std::optional<DyadicVector> ExactNearest(const ExactDifference& big, const Simplex& simplex) {
  const DyadicVector a = big.Point(simplex.points[0]);
  if (simplex.size == 1) return IsZero(a) ? std::nullopt : std::optional(a);
  const DyadicVector b = big.Point(simplex.points[1]), u = b - a;
  if (simplex.size == 2) {
    const Dyadic rise = Dot(u, a);
    if (rise.sign() >= 0 || Dot(u, b).sign() <= 0) return std::nullopt;
    DyadicVector x = Scaled(Dot(u, u), a) - Scaled(rise, u);
    if (IsZero(x)) return std::nullopt;
    return x;
  }
  const DyadicVector c = big.Point(simplex.points[2]);
  DyadicVector n = Cross(u, c - a);
  const int side = Dot(n, a).sign();
  if (side == 0 || Dot(n, Cross(a, b)).sign() <= 0 || Dot(n, Cross(b, c)).sign() <= 0 ||
      Dot(n, Cross(c, a)).sign() <= 0) {
    return std::nullopt;
  }
  return side > 0 ? n : Negated(n);
}

Simplex FindExactNearest(Signs* signs, const Simplex& start, PhaseCounts* counts) {
  const ExactDifference& big = signs->exact();
  // Of the hull of up to four vertices, the part that holds the point nearest to o: the one whose
  // own nearest point has positive weights and beyond which towards o no other vertex lies. Parts
  // with `newest` only, if one is named: it is known to be nearer than all the others' hull.
  const auto part_of = [&](std::span<const VertexPair> vertices, int newest) {
    const int count = static_cast<int>(vertices.size());
    for (int size = 1; size <= 3; ++size) {
      for (unsigned members = 1; members < 1u << count; ++members) {
        if (std::popcount(members) != size) continue;
        if (newest >= 0 && (members >> newest & 1u) == 0) continue;
        Simplex part;
        for (int i = 0; i < count; ++i) {
          if (members >> i & 1u) part.points[part.size++] = vertices[i];
        }
        const auto x = ExactNearest(big, part);
        if (!x) continue;
        const DyadicVector on_plane = big.Point(part.points[0]);
        bool nearest = true;
        for (int i = 0; i < count && nearest; ++i) {
          if ((members >> i & 1u) == 0)
            nearest = Dot(*x, big.Point(vertices[i]) - on_plane).sign() >= 0;
        }
        if (nearest) return std::pair{part, *x};
      }
    }
    assert(false);  // o is outside of the hull
    return std::pair{Simplex{{vertices[0]}, 1}, big.Point(vertices[0])};
  };

  auto [simplex, x] = part_of({start.points.data(), static_cast<std::size_t>(start.size)}, -1);
  for (;;) {
    ++counts->faces_visited;
    signs->CountExact();
    const VertexPair next = ExactSupport(big, signs->difference(), Negated(x), counts);
    if (Dot(x, big.Point(next) - big.Point(simplex.points[0])).sign() >= 0) return simplex;
    std::array<VertexPair, 4> vertices;
    std::copy_n(simplex.points.begin(), simplex.size, vertices.begin());
    vertices[simplex.size] = next;
    std::tie(simplex, x) =
        part_of({vertices.data(), static_cast<std::size_t>(simplex.size + 1)}, simplex.size);
  }
}

}  // namespace touchstone
