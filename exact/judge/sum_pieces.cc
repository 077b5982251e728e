// SPDX-License-Identifier: GPL-3.0-or-later
//
// Each triangle is a piece of a facet that can be in contact; samples of them, and what lies on
// either side.
#include <algorithm>
#include <set>

#include "touchstone/exact/judge/sum_checks.h"

namespace touchstone::exact {
namespace {

// The mean of points.
RationalPoint Middle(const std::vector<RationalPoint>& points) {
  RationalPoint middle;
  for (int i = 0; i < 3; ++i) {
    for (const RationalPoint& x : points) middle[i] += x[i];
    middle[i] /= points.size();
  }
  return middle;
}

class PieceCheck {
 public:
  explicit PieceCheck(const SumContext& context) : context_(context), boundary_(context.boundary) {}

  bool Run() {
    for (std::size_t t = 0; t < boundary_.triangles.size(); ++t) {
      CheckPiece("triangle " + std::to_string(t), boundary_.triangles[t],
                 boundary_.facet_of_triangle[t], true);
    }
    for (std::size_t s = 0; s < boundary_.sheets.size(); ++s) {
      CheckPiece("sheet " + std::to_string(s), boundary_.sheets[s], boundary_.facet_of_sheet[s],
                 false);
    }
    return is_fine_;
  }

 private:
  void Fail(const std::string& detail) {
    is_fine_ = false;
    context_.Add(SumFindingKind::kNotAContact, detail);
  }

  struct Facet {
    bool can_touch;
    SumPlane plane;
    std::vector<SumPlane> sides;  // upright on it, outward
  };

  const Facet& FacetOf(int f) {
    const auto [place, added] = facets_.try_emplace(f);
    if (!added) return place->second;
    const SumFacet& name = boundary_.facets[f];
    Facet& facet = place->second;
    facet.plane = context_.sum.Plane(name);
    facet.can_touch = context_.sum.CanTouch(name);
    const std::vector<SumVertex> corners = context_.sum.Corners(name);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const IntegerVector from = context_.sum.Point(corners[k]);
      const IntegerVector to = context_.sum.Point(corners[(k + 1) % corners.size()]);
      SumPlane side{Cross(to - from, facet.plane.normal), 0};
      side.offset = Dot(side.normal, from);
      facet.sides.push_back(std::move(side));
    }
    return facet;
  }

  void CheckPiece(const std::string& name, const std::array<int, 3>& corners, int f,
                  bool faces_as_facet) {
    const Facet& facet = FacetOf(f);
    if (!facet.can_touch) return Fail(name + ": the features of its facet cannot touch");
    for (const int v : corners) {
      const RationalPoint& x = context_.points[v];
      if (Side(facet.plane, x) != 0) return Fail(name + " does not lie in its facet's plane");
      if (std::any_of(facet.sides.begin(), facet.sides.end(),
                      [&](const SumPlane& side) { return Side(side, x) > 0; })) {
        return Fail(name + " is not a part of its facet");
      }
    }
    const RationalPoint &a = context_.points[corners[0]], &b = context_.points[corners[1]],
                        &c = context_.points[corners[2]];
    const RationalPoint normal = Cross(b - a, c - a);
    mpq_class agrees = 0;
    for (int i = 0; i < 3; ++i) agrees += normal[i] * facet.plane.normal[i];
    if (sgn(agrees) == 0) return Fail(name + " has no area");
    if (faces_as_facet && sgn(agrees) < 0) Fail(name + " faces against its facet");
  }

  const SumContext& context_;
  const SumBoundary& boundary_;
  std::map<int, Facet> facets_;
  bool is_fine_ = true;
};

class SideCheck {
 public:
  explicit SideCheck(const SumContext& context) : context_(context), boundary_(context.boundary) {}

  void Run() {
    std::set<int> components;
    const std::size_t count = boundary_.triangles.size();
    const std::size_t samples = std::min<std::size_t>(context_.options.samples, count);
    std::set<std::size_t> chosen;
    for (std::size_t k = 0; k < samples; ++k) chosen.insert(k * count / samples);
    for (std::size_t t = 0; t < count; ++t) {
      if (components.insert(boundary_.component_of_triangle[t]).second) chosen.insert(t);
    }
    for (const std::size_t t : chosen) {
      CheckPiece("triangle " + std::to_string(t), boundary_.triangles[t],
                 boundary_.facet_of_triangle[t], Verdict::kSeparate);
    }
    const std::size_t sheets =
        std::min<std::size_t>(context_.options.samples, boundary_.sheets.size());
    for (std::size_t k = 0; k < sheets; ++k) {
      const std::size_t s = k * boundary_.sheets.size() / sheets;
      CheckPiece("sheet " + std::to_string(s), boundary_.sheets[s], boundary_.facet_of_sheet[s],
                 Verdict::kOverlap);
    }
    for (std::size_t s = 0; s < boundary_.segments.size(); ++s) {
      const auto& [u, v] = boundary_.segments[s];
      CheckLone("segment " + std::to_string(s), Middle({context_.points[u], context_.points[v]}));
    }
    for (const int v : boundary_.points) {
      CheckLone("point " + std::to_string(v), context_.points[v]);
    }
  }

 private:
  void Expect(const std::string& what, const RationalPoint& x, Verdict expected) const {
    const Verdict verdict = context_.At(x);
    if (verdict == expected) return;
    context_.Add(SumFindingKind::kWrongSide, what + ": should be " +
                                                 std::string(ToString(expected)) + ", is " +
                                                 std::string(ToString(verdict)));
  }

  void CheckPiece(const std::string& name, const std::array<int, 3>& corners, int facet,
                  Verdict outside) const {
    const RationalPoint x = Middle(
        {context_.points[corners[0]], context_.points[corners[1]], context_.points[corners[2]]});
    const IntegerVector normal = context_.sum.Plane(boundary_.facets[facet]).normal;
    const mpq_class step = context_.sum.StepBelowAnyOther(x);
    Expect(name, x, Verdict::kTouch);
    Expect(name + ", just inside", Along(x, -step, normal), Verdict::kOverlap);
    Expect(name + ", just outside", Along(x, step, normal), outside);
  }

  // M° all around, in directions that no plane in sight is parallel to.
  void CheckLone(const std::string& name, const RationalPoint& x) const {
    Expect(name, x, Verdict::kTouch);
    // Shorter than a step along any facet's normal: coordinates of 13 at most, and a normal's
    // largest coordinate is not below one.
    const mpq_class step = context_.sum.StepBelowAnyOther(x) / 16;
    for (int k = 0; k < 8; ++k) {
      const IntegerVector direction = {k & 1 ? 13 : -11, k & 2 ? 7 : -9, k & 4 ? 5 : -3};
      Expect(name + ", near it", Along(x, step, direction), Verdict::kOverlap);
    }
  }

  const SumContext& context_;
  const SumBoundary& boundary_;
};

}  // namespace

bool CheckPieces(const SumContext& context) { return PieceCheck(context).Run(); }
void CheckSides(const SumContext& context) { SideCheck(context).Run(); }

}  // namespace touchstone::exact
