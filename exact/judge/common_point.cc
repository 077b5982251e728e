// SPDX-License-Identifier: GPL-3.0-or-later
//
// The common point, where a result names one: due to touch and overlap only, and beyond no face of
// either body by more than its error.
#include <cmath>

#include "touchstone/exact/judge/checks.h"
#include "touchstone/exact/judge/values.h"

namespace touchstone::exact {
namespace {

Real Along(const IntegerVector& n, const std::array<Real, 3>& x) {
  return Real(n[0]) * x[0] + Real(n[1]) * x[1] + Real(n[2]) * x[2];
}

// How far x lies beyond the plane, in true lengths.
Real Beyond(const PlacedPair& pair, const IntegerVector& n, const Integer& value,
            const std::array<Real, 3>& x) {
  const Real length =
      Sqrt(Real(n[0]) * Real(n[0]) + Real(n[1]) * Real(n[1]) + Real(n[2]) * Real(n[2]));
  return pair.ToLength((Along(n, x) - Real(value)) / length);
}

}  // namespace

void CheckCommonPoint(const JudgeContext& context) {
  const CollideResult& result = context.result;
  if (!result.common_point.has_value()) return;
  if (result.verdict != Verdict::kTouch && result.verdict != Verdict::kOverlap) {
    return context.Add(FindingKind::kValueOutOfBounds, "a common point of bodies apart");
  }
  const auto& [point, error] = *result.common_point;
  if (!point.allFinite() || !std::isfinite(error) || error < 0) {
    return context.Add(FindingKind::kValueOutOfBounds, "the common point is none");
  }
  // As good as coordinates are: values.h.
  if (error > kErrorFactor * kConditionFactor * context.pair.size()) {
    context.Add(FindingKind::kLooseBound, "the common point's error is larger than it may be");
  }
  const PlacedPair& pair = context.pair;
  const std::array<Real, 3> x = {pair.FromLength(Real(point[0])), pair.FromLength(Real(point[1])),
                                 pair.FromLength(Real(point[2]))};
  const Real allowed = Real(error) + Scale(Real(pair.size()), -200);
  const auto check = [&](const IntegerVector& n, const Integer& value, const char* body, int f) {
    if (Beyond(pair, n, value, x) > allowed) {
      context.Add(FindingKind::kValueOutOfBounds,
                  "the common point lies beyond face " + std::to_string(f) + " of " + body);
    }
  };
  for (int f = 0; f < pair.p().face_count; ++f) {
    const IntegerVector& n = pair.p().normals().exact[f];
    check(n, pair.ValueP(n, pair.p().face(f)[0]), "P", f);
  }
  for (int f = 0; f < pair.q().face_count; ++f) {
    const IntegerVector n = pair.NormalFromQ(pair.q().normals().exact[f]);
    check(n, pair.ValueQ(pair.ToQ(n), n, pair.q().face(f)[0]), "Q", f);
  }
}

}  // namespace touchstone::exact
