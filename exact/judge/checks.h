// SPDX-License-Identifier: GPL-3.0-or-later
//
// The judge's checks, one file each, over one context. Each appends what it finds.
#ifndef TOUCHSTONE_EXACT_JUDGE_CHECKS_H_
#define TOUCHSTONE_EXACT_JUDGE_CHECKS_H_

#include <optional>
#include <string>
#include <vector>

#include "touchstone/exact/convert.h"
#include "touchstone/exact/decide.h"
#include "touchstone/exact/judge.h"
#include "touchstone/exact/support.h"

namespace touchstone::exact {

// The plane named by the result's exit face, once it is known to support M at the named triangle.
struct NamedFace {
  IntegerVector normal;  // outward
  Ratio ratio;           // 1 + d |c| = 1/s of its plane
  bool crossed = false;  // the ray crosses the closed triangle: hence it is the exit face
};

// Three points of M and what follows from them exactly: what a certificate and the exit face, which
// often name the same three, are both held to.
struct NamedTriangle {
  std::array<VertexPair, 3> pairs;
  std::array<IntegerVector, 3> points;  // less c
  IntegerVector normal;                 // zero for collinear points
  // normal.v over normal.point = det [points]: 1/s of the plane, and Cramer's determinants of v in
  // the points sum to the numerator.
  Ratio ratio;
  // sign(det [v points[i] points[i + 1]]): on which side of the plane through c and the two.
  std::array<int, 3> sides;
};

class JudgeContext {
 public:
  JudgeContext(const ExactBody& p, const ExactBody& q, const RelativePose& pose,
               const CollideResult& judged, const JudgeOptions& how, std::vector<Finding>* findings)
      : result(judged),
        options(how),
        pair(p.data(), q.data(), pose, judged.interior_p, judged.interior_q),
        p_(p),
        q_(q),
        pose_(pose),
        findings_(findings) {}

  void Add(FindingKind kind, std::string detail) const {
    findings_->push_back({kind, std::move(detail)});
  }

  bool published() const { return options.search == Search::kPublished; }
  // Both interior points are strictly interior, proven.
  bool InteriorPointsAreInterior() const {
    return p_.InteriorPointIsInterior(result.interior_p) &&
           q_.InteriorPointIsInterior(result.interior_q);
  }
  // Remembers the last; valid until the next call.
  const NamedTriangle& Triangle(const std::array<VertexPair, 3>& pairs) const;
  // What supports M along the last triangle's normal, which must not be zero.
  const SupportingFeatures& SupportingTriangle() const;
  // The truth, from scratch; computed when first asked for.
  const ExactDecision& Decision() const;
  // The same from another choice of interior points.
  ExactDecision DecisionFrom(int interior_p, int interior_q) const {
    return Decide(p_, q_, pose_, interior_p, interior_q);
  }
  PlacedPair PairFrom(int interior_p, int interior_q) const {
    return {p_.data(), q_.data(), pose_, interior_p, interior_q};
  }
  // 1/s of the true exit: from a face proven to be crossed, or from Decision(). Requires c != o.
  Ratio ExitRatio() const;

  const CollideResult& result;
  const JudgeOptions& options;
  const PlacedPair pair;
  std::optional<NamedFace> face;

 private:
  const ExactBody& p_;
  const ExactBody& q_;
  const RelativePose& pose_;
  std::vector<Finding>* findings_;
  mutable std::optional<ExactDecision> decision_;
  mutable std::optional<NamedTriangle> triangle_;
  mutable std::optional<SupportingFeatures> supporting_;
};

// 0, 1, 2; the vertices of a feature, a face's in loop order; whether all of `some` are in
// `sorted`.
int DimensionOf(FeatureKind kind);
std::vector<int> VerticesOf(const ExactBodyData& body, const Feature& feature);
bool Includes(const std::vector<int>& sorted, const std::vector<int>& some);

// Everything that other checks index with is in range.
bool CheckIndices(const JudgeContext& context, const ExactBody& p, const ExactBody& q);
// Check 2. Returns whether the certificate proves the verdict.
bool CheckCertificate(const JudgeContext& context);
// Check 1.
void CheckVerdict(const JudgeContext& context, bool proven);
// Check 3, and sets context->face; also that the face is the one the ray leaves by (check 5).
void CheckFace(JudgeContext* context);
// Check 4.
void CheckValues(const JudgeContext& context);
// Check 4 for the common point, which any touch or overlap may name.
void CheckCommonPoint(const JudgeContext& context);
// Check 5: the phases.
void CheckPhases(const JudgeContext& context);
// Check 6.
void CheckCounters(const JudgeContext& context, bool proven);
// The construction tier.
void CheckConstruction(const JudgeContext& context);

}  // namespace touchstone::exact

#endif  // TOUCHSTONE_EXACT_JUDGE_CHECKS_H_
