// SPDX-License-Identifier: MIT
#include "touchstone/core/cd_dual/cache.h"

#include <Eigen/Geometry>

#include "touchstone/core/cd_dual/certify.h"
#include "touchstone/core/cd_dual/signs.h"

namespace touchstone {
namespace {

// A cache may be of another pair, or made up.
bool Exists(const MinkowskiDifference& m, CornerPair pair) {
  const auto within = [](int corner, const ConvexPolyhedron& body) {
    return corner >= 0 && corner < body.support_table().corner_count();
  };
  return within(pair.p, m.p()) && within(pair.q, m.q());
}

void Fill(Verdict verdict, Tier tier, const Certificate& certificate, CollideResult* result) {
  result->verdict = verdict;
  result->tier = tier;
  result->phase = Phase::kCache;
  result->termination = Termination::kEarlyExit;
  result->certificate = certificate;
}

bool Separates(Signs* signs, const Eigen::Vector3d& direction, CornerPair* support,
               CollideResult* result) {
  const auto tier = ProveSeparatingDirection(signs, direction, support, /*scan=*/false);
  if (!tier) return false;
  Fill(Verdict::kSeparate, *tier, {CertificateKind::kSeparatingDirection, direction, {}}, result);
  return true;
}

}  // namespace

bool HoldsTriangle(const MinkowskiDifference& m, const CollideCache& cache) {
  return cache.has_triangle && Exists(m, cache.triangle[0]) && Exists(m, cache.triangle[1]) &&
         Exists(m, cache.triangle[2]);
}

bool AnswerFromCache(MinkowskiDifference* m, Signs* signs, CollideCache* cache,
                     CollideResult* result) {
  if (cache->has_direction && Exists(*m, cache->support) && cache->direction.allFinite()) {
    if (Separates(signs, cache->direction, &cache->support, result)) return true;
  }
  const auto& corners = cache->triangle;
  if (!HoldsTriangle(*m, *cache)) return false;
  const std::array<Eigen::Vector3d, 3> points = {m->Point(corners[0]), m->Point(corners[1]),
                                                 m->Point(corners[2])};
  const Eigen::Vector3d normal = (points[1] - points[0]).cross(points[2] - points[0]);
  if (normal.dot(points[0]) < 0.0) {
    CornerPair support = corners[0];
    return Separates(signs, normal, &support, result);
  }
  const int interior_p = cache->interior_p & 1, interior_q = cache->interior_q & 1;
  if (interior_p != m->interior_p() || interior_q != m->interior_q()) {
    m->ChooseInterior(interior_p, interior_q);
  }
  if (!IsClearlyEnclosing(*m, points)) return false;
  Fill(Verdict::kOverlap, Tier::kBound,
       {CertificateKind::kEnclosingTetrahedron,
        Eigen::Vector3d::Zero(),
        {m->Vertices(corners[0]), m->Vertices(corners[1]), m->Vertices(corners[2])}},
       result);
  return true;
}

}  // namespace touchstone
