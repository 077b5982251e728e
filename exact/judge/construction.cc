// SPDX-License-Identifier: GPL-3.0-or-later
//
// The construction tier: M built whole, and the result and the proof tier held against it.
#include <algorithm>

#include "touchstone/exact/convex_minkowski.h"
#include "touchstone/exact/judge/checks.h"
#include "touchstone/exact/phase_maxima.h"

namespace touchstone::exact {
namespace {

bool Same(const std::optional<Ratio>& a, const std::optional<Ratio>& b) {
  return a.has_value() == b.has_value() && (!a.has_value() || Compare(*a, *b) == 0);
}

}  // namespace

void CheckConstruction(const JudgeContext& context) {
  const MinkowskiDifference m = ConvexMinkowski(context.pair);
  const Ratio exit = m.ExitRatio();
  const int sign = cmp(exit.numerator, exit.denominator);  // of 1/s - 1
  const Verdict truth = sign > 0    ? Verdict::kSeparate
                        : sign == 0 ? Verdict::kTouch
                                    : Verdict::kOverlap;
  const Verdict verdict = context.result.verdict;
  const bool shares =
      context.published() && verdict == Verdict::kOverlap && truth == Verdict::kTouch;
  if (verdict != Verdict::kUndecided && verdict != truth && !shares) {
    context.Add(FindingKind::kWrongVerdict, "construction: is " + std::string(ToString(truth)));
  }
  if (context.face.has_value()) {
    const IntegerVector& n = context.face->normal;
    const IntegerVector a = context.pair.Difference(context.result.face->triangle[0]);
    const ExactPlane plane = MakePlane(n, Dot(n, a));
    const bool found = std::any_of(m.facets.begin(), m.facets.end(),
                                   [&](const MinkowskiFacet& f) { return f.plane == plane; });
    if (!found) context.Add(FindingKind::kNotAFace, "construction: M has no such facet");
    if (context.face->crossed && Compare(context.face->ratio, exit) != 0) {
      context.Add(FindingKind::kNotOptimal, "construction: another facet's distance is larger");
    }
  }
  if (!context.options.check_phase_maxima) return;
  if (!Same(m.FaceVertexMaximum(), FaceVertexMaximum(context.pair)) ||
      !Same(m.VertexFaceMaximum(), VertexFaceMaximum(context.pair)) ||
      !Same(m.EdgeEdgeMaximum(), EdgeEdgeMaximum(context.pair))) {
    context.Add(FindingKind::kPhaseNotMaximal, "construction: the judge's own class maxima differ");
  }
}

}  // namespace touchstone::exact
