// SPDX-License-Identifier: GPL-3.0-or-later
//
// The checks of a Minkowski boundary, one file each, over one context. Each appends what it finds.
#ifndef TOUCHSTONE_EXACT_JUDGE_SUM_CHECKS_H_
#define TOUCHSTONE_EXACT_JUDGE_SUM_CHECKS_H_

#include <array>
#include <map>
#include <string>
#include <vector>

#include "touchstone/core/base/verdict.h"
#include "touchstone/exact/exact_sum.h"
#include "touchstone/exact/judge_minkowski.h"

namespace touchstone::exact {

class SumContext {
 public:
  SumContext(const TriangleMesh& a, const TriangleMesh& b, const RelativePose& pose,
             const SumBoundary& judged, const SumJudgeOptions& how,
             std::vector<SumFinding>* findings)
      : boundary(judged), options(how), pair(a, b, pose), sum(pair), findings_(findings) {}

  // Of each kind the first few are told, and the rest counted: see AddCounts.
  void Add(SumFindingKind kind, const std::string& detail) const;
  void AddCounts() const;

  // The exact membership of a point of the integers' space.
  Verdict At(const RationalPoint& x) const;

  // A triangle or a sheet by its exact corners.
  RationalTriangle Triangle(const std::array<int, 3>& corners) const {
    return RationalTriangle({points[corners[0]], points[corners[1]], points[corners[2]]});
  }

  const SumBoundary& boundary;
  const SumJudgeOptions& options;
  const PlacedMeshPair pair;
  const ExactSum sum;
  std::vector<RationalPoint> points;  // the vertices, once the names are known to name them

 private:
  std::vector<SumFinding>* findings_;
  mutable std::map<SumFindingKind, int> counts_;
};

inline constexpr double kSumRoundingTolerance = 64e-12;  // of the size

// Every index is in range and every name names a point; sets context->points. All else needs it.
bool CheckNames(SumContext* context);
// Points are where they are said to be, and none has two numbers.
void CheckPoints(const SumContext& context);
// Edges are run both ways equally often; components are counted rightly.
void CheckSurface(const SumContext& context);
// Facets can touch; triangles and sheets are pieces of theirs. Returns whether all are, so that
// what follows may take their planes at their word.
bool CheckPieces(const SumContext& context);
// M° lies where samples of the pieces say.
void CheckSides(const SumContext& context);
// M° lies along random lines where the surface says.
void CheckLines(const SumContext& context);
// Every piece of every facet of M is kept that should be, and no other.
void CheckAllCells(const SumContext& context);
// Nef polyhedra say the same.
void CheckConstructedSum(const SumContext& context);

}  // namespace touchstone::exact

#endif  // TOUCHSTONE_EXACT_JUDGE_SUM_CHECKS_H_
