// SPDX-License-Identifier: GPL-3.0-or-later
//
// Names name what they should, and points are where they are said to be.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "touchstone/exact/judge/sum_checks.h"

namespace touchstone::exact {
namespace {

std::string NameOf(const char* kind, std::size_t number) {
  return std::string(kind) + ' ' + std::to_string(number);
}

class NameCheck {
 public:
  explicit NameCheck(SumContext* context)
      : context_(*context), boundary_(context->boundary), points_(context->points) {}

  bool Run() {
    Expect(boundary_.names.size() == boundary_.vertices.size(),
           "vertices and names differ in number");
    Expect(boundary_.triangles.size() == boundary_.facet_of_triangle.size() &&
               boundary_.triangles.size() == boundary_.component_of_triangle.size(),
           "triangles, their facets and their components differ in number");
    Expect(boundary_.sheets.size() == boundary_.facet_of_sheet.size(),
           "sheets and their facets differ in number");
    if (!is_fine_) return false;
    for (std::size_t f = 0; f < boundary_.facets.size(); ++f) {
      Expect(context_.sum.IsValid(boundary_.facets[f]), NameOf("facet", f) + " is none");
    }
    CheckList("triangle", boundary_.triangles);
    CheckList("sheet", boundary_.sheets);
    CheckList("segment", boundary_.segments);
    for (const int v : boundary_.points) Expect(IsVertex(v), "a point is no vertex");
    CheckFacets("triangle", boundary_.facet_of_triangle);
    CheckFacets("sheet", boundary_.facet_of_sheet);
    for (const int c : boundary_.component_of_triangle) {
      Expect(c >= 0 && c < std::ssize(boundary_.components), "a triangle's component is none");
    }
    NamePoints();
    return is_fine_;
  }

 private:
  void Expect(bool condition, const std::string& detail) {
    if (condition) return;
    is_fine_ = false;
    context_.Add(SumFindingKind::kBadName, detail);
  }

  bool IsVertex(int v) const { return v >= 0 && v < std::ssize(boundary_.vertices); }

  template <std::size_t N>
  void CheckList(const char* kind, const std::vector<std::array<int, N>>& list) {
    for (std::size_t i = 0; i < list.size(); ++i) {
      for (std::size_t k = 0; k < N; ++k) {
        Expect(IsVertex(list[i][k]) && list[i][k] != list[i][(k + 1) % N],
               NameOf(kind, i) + " has a bad corner");
      }
    }
  }

  void CheckFacets(const char* kind, const std::vector<int>& facets) {
    for (std::size_t i = 0; i < facets.size(); ++i) {
      Expect(facets[i] >= 0 && facets[i] < std::ssize(boundary_.facets),
             NameOf(kind, i) + " has no facet");
    }
  }

  void NamePoints() {
    for (std::size_t v = 0; v < boundary_.names.size(); ++v) {
      auto point = context_.sum.Point(boundary_.names[v], boundary_.facets);
      Expect(point.has_value(), NameOf("vertex", v) + ": its name stands for no one point");
      points_.push_back(point.value_or(RationalPoint{}));
    }
  }

  const SumContext& context_;
  const SumBoundary& boundary_;
  std::vector<RationalPoint>& points_;
  bool is_fine_ = true;
};

}  // namespace

bool CheckNames(SumContext* context) { return NameCheck(context).Run(); }

void CheckPoints(const SumContext& context) {
  const SumBoundary& boundary = context.boundary;
  const mpq_class claimed(std::isfinite(boundary.rounding) ? boundary.rounding : 0.0);
  if (!(boundary.rounding >= 0.0 &&
        boundary.rounding <= kSumRoundingTolerance * 2.0 * context.pair.size())) {
    context.Add(SumFindingKind::kLooseBound,
                "claims a rounding of " + std::to_string(boundary.rounding / context.pair.size()) +
                    " of the size");
  }
  for (std::size_t v = 0; v < boundary.vertices.size(); ++v) {
    const RationalPoint exact = context.sum.ToTrue(context.points[v]);
    for (int i = 0; i < 3; ++i) {
      const double rounded = boundary.vertices[v][i];
      if (std::isfinite(rounded) && abs(exact[i] - mpq_class(rounded)) <= claimed) continue;
      context.Add(SumFindingKind::kWrongPoint,
                  NameOf("vertex", v) + " is further from its exact point than claimed");
      break;
    }
  }
  std::vector<int> order(context.points.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](int u, int v) { return context.points[u] < context.points[v]; });
  for (std::size_t k = 1; k < order.size(); ++k) {
    if (context.points[order[k - 1]] == context.points[order[k]]) {
      context.Add(SumFindingKind::kWrongPoint, "vertices " + std::to_string(order[k - 1]) +
                                                   " and " + std::to_string(order[k]) +
                                                   " are one point");
    }
  }
}

}  // namespace touchstone::exact
