// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef TOUCHSTONE_EXACT_JUDGE_MINKOWSKI_H_
#define TOUCHSTONE_EXACT_JUDGE_MINKOWSKI_H_

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "touchstone/core/base/relative_pose.h"
#include "touchstone/core/mesh/triangle_mesh.h"
#include "touchstone/core/minkowski/sum_boundary.h"

namespace touchstone::exact {

enum class SumFindingKind {
  kBadName,      // a name or an index that names nothing, or a name of no single point
  kNotClosed,    // an edge that triangles do not run both ways equally often
  kWrongCounts,  // components, or what is counted of them
  kWrongPoint,   // further from the exact point than claimed, or one point under two numbers
  kLooseBound,   // the rounding claimed is larger than it may be
  kNotAContact,  // a facet whose features cannot touch, or a triangle that is no piece of it
  kWrongSide,    // M° does not lie where a kept piece says
  kMissing,      // M° begins or ends where there is no piece
  kNotAsByNef,   // facets, their neighbours, genus or slots are not those of Nef polyhedra
};
inline constexpr int kSumFindingKindCount = 9;

// snake_case: "bad_name", ...
std::string_view ToString(SumFindingKind kind);

struct SumFinding {
  SumFindingKind kind;
  std::string detail;  // one line
};

// How far to look.
struct SumJudgeOptions {
  // Triangles (and sheets) that are placed by exact membership at a sample and on both sides of it:
  // so many, spread evenly, with one of each component. Three memberships each.
  int samples = 100;
  // Random lines whose crossings of the surface are held against exact membership, and as many
  // points on each, spread evenly.
  int lines = 10;
  std::uint64_t seed = 1;
  // Also cut all facets of M by each other and place every piece (exact/sum_cells.h): for hundreds
  // of facets.
  bool enumerate = false;
  // Also build the sum of the interiors by Nef polyhedra and compare: for tens of faces.
  bool construct = false;
};

// Everything that is wrong with `boundary` as ∂M of A and B, B placed by `pose`; empty when it
// stands. Exact throughout. Of every vertex, facet and triangle: the name stands for one point, no
// two for the same; the rounding is as claimed, and at most 64e-12 of the size; the facet's
// features can touch; the triangle lies on it and faces as it does; edges are run both ways;
// components and their counts are right. Of samples: touch on the piece, overlap just inside,
// separate just outside (for sheets, segments and points: overlap all around), the step chosen
// below any other facet of M. Of lines: M° begins and ends where the surface says, alternately, and
// random points on them agree.
//
// Complexity: O(n log n) in the boundary, plus the memberships: some milliseconds each at thousands
// of faces.
std::vector<SumFinding> JudgeMinkowski(const TriangleMesh& a, const TriangleMesh& b,
                                       const RelativePose& pose, const SumBoundary& boundary,
                                       const SumJudgeOptions& options = {});

}  // namespace touchstone::exact

#endif  // TOUCHSTONE_EXACT_JUDGE_MINKOWSKI_H_
