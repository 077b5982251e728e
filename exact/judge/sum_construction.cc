// SPDX-License-Identifier: GPL-3.0-or-later
//
// The sum built by Nef polyhedra is the same.
#include <algorithm>

#include "touchstone/exact/judge/sum_checks.h"
#include "touchstone/exact/nef_mesh_sum.h"
#include "touchstone/exact/surface_graph.h"

namespace touchstone::exact {
namespace {

class ConstructionCheck {
 public:
  explicit ConstructionCheck(const SumContext& context)
      : context_(context), boundary_(context.boundary) {}

  void Run() {
    const NefMeshSum truth = MakeNefMeshSum(context_.pair);
    const SurfaceGraph expected = MakeSurfaceGraph(truth.points, truth.triangles);
    const SurfaceGraph built = MakeSurfaceGraph(context_.points, boundary_.triangles);
    Compare("facets", expected.facets, built.facets);
    Compare("pairs of neighbouring facets", expected.neighbors, built.neighbors);
    if (expected.euler_characteristics != built.euler_characteristics) {
      context_.Add(SumFindingKind::kNotAsByNef,
                   "other components, or other Euler characteristics of theirs");
    }
    for (const RationalPoint& x : truth.slot_samples) {
      if (!IsReported(x)) context_.Add(SumFindingKind::kNotAsByNef, "part of a slot is not told");
    }
    const bool tells_slots =
        !boundary_.sheets.empty() || !boundary_.segments.empty() || !boundary_.points.empty();
    if (tells_slots && truth.slot_samples.empty()) {
      context_.Add(SumFindingKind::kNotAsByNef, "tells of slots where there are none");
    }
  }

 private:
  template <class Element>
  void Compare(const char* what, const std::vector<Element>& expected,
               const std::vector<Element>& built) const {
    if (expected == built) return;
    std::vector<Element> less, more;
    std::set_difference(expected.begin(), expected.end(), built.begin(), built.end(),
                        std::back_inserter(less));
    std::set_difference(built.begin(), built.end(), expected.begin(), expected.end(),
                        std::back_inserter(more));
    context_.Add(SumFindingKind::kNotAsByNef,
                 std::string(what) + ": " + std::to_string(less.size()) + " of " +
                     std::to_string(expected.size()) + " are missing, " +
                     std::to_string(more.size()) + " are there that should not be");
  }

  bool IsReported(const RationalPoint& x) const {
    for (const int v : boundary_.points) {
      if (context_.points[v] == x) return true;
    }
    for (const auto& [u, v] : boundary_.segments) {
      if (IsOn(x, context_.points[u], context_.points[v])) return true;
    }
    return std::any_of(boundary_.sheets.begin(), boundary_.sheets.end(), [&](const auto& sheet) {
      const RationalTriangle t = context_.Triangle(sheet);
      return t.Side(x) == 0 && t.Holds(x);
    });
  }

  static bool IsOn(const RationalPoint& x, const RationalPoint& from, const RationalPoint& to) {
    const RationalPoint cross = Cross(x - from, to - from);
    return std::all_of(cross.begin(), cross.end(), [](const auto& c) { return sgn(c) == 0; }) &&
           sgn(Dot(x - from, x - to)) <= 0;
  }

  const SumContext& context_;
  const SumBoundary& boundary_;
};

}  // namespace

void CheckConstructedSum(const SumContext& context) { ConstructionCheck(context).Run(); }

}  // namespace touchstone::exact
