// SPDX-License-Identifier: GPL-3.0-or-later
#include "touchstone/exact/judge/sum_checks.h"
#include "touchstone/exact/judge_minkowski.h"
#include "touchstone/exact/mesh_membership.h"

namespace touchstone::exact {
namespace {

constexpr int kToldOfEach = 5;

}  // namespace

std::string_view ToString(SumFindingKind kind) {
  switch (kind) {
    case SumFindingKind::kBadName:
      return "bad_name";
    case SumFindingKind::kNotClosed:
      return "not_closed";
    case SumFindingKind::kWrongCounts:
      return "wrong_counts";
    case SumFindingKind::kWrongPoint:
      return "wrong_point";
    case SumFindingKind::kLooseBound:
      return "loose_bound";
    case SumFindingKind::kNotAContact:
      return "not_a_contact";
    case SumFindingKind::kWrongSide:
      return "wrong_side";
    case SumFindingKind::kMissing:
      return "missing";
    case SumFindingKind::kNotAsByNef:
      return "not_as_by_nef";
  }
  return "?";
}

void SumContext::Add(SumFindingKind kind, const std::string& detail) const {
  if (counts_[kind]++ < kToldOfEach) findings_->push_back({kind, detail});
}

void SumContext::AddCounts() const {
  for (const auto& [kind, count] : counts_) {
    if (count <= kToldOfEach) continue;
    findings_->push_back({kind, "and " + std::to_string(count - kToldOfEach) + " more"});
  }
}

Verdict SumContext::At(const RationalPoint& x) const {
  return MeshMembership(pair, sum.ToTranslation(x));
}

std::vector<SumFinding> JudgeMinkowski(const TriangleMesh& a, const TriangleMesh& b,
                                       const RelativePose& pose, const SumBoundary& boundary,
                                       const SumJudgeOptions& options) {
  std::vector<SumFinding> findings;
  SumContext context(a, b, pose, boundary, options, &findings);
  if (CheckNames(&context)) {
    CheckPoints(context);
    CheckSurface(context);
    if (CheckPieces(context)) {
      CheckSides(context);
      CheckLines(context);
      if (options.enumerate) CheckAllCells(context);
      if (options.construct) CheckConstructedSum(context);
    }
  }
  context.AddCounts();
  return findings;
}

}  // namespace touchstone::exact
