// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every piece of every facet of M is kept that should be, and no other.
#include "touchstone/exact/sum_cells.h"

#include <algorithm>

#include "touchstone/exact/judge/sum_checks.h"

namespace touchstone::exact {
namespace {

using Eigen::Vector3d;

struct Held {
  int inside = 0, on_border = 0;  // triangles that hold a sample
  // Pieces of the surface may be cut into triangles anywhere: the sample may lie between them.
  bool is_once() const { return inside == 1 ? on_border == 0 : inside == 0 && on_border >= 2; }
  bool is_never() const { return inside == 0 && on_border == 0; }
};

class CellCheck {
 public:
  explicit CellCheck(const SumContext& context)
      : context_(context), boundary_(context.boundary), unit_(1.0 / context.pair.size()) {
    Prepare(boundary_.triangles, &triangles_);
    Prepare(boundary_.sheets, &sheets_);
  }

  void Run() {
    for (const SumCell& cell : FindSumCells(context_.sum, true)) Check(cell);
  }

 private:
  struct Piece {
    Vector3d low, high;  // in units of the size
    RationalTriangle triangle;
  };

  void Prepare(const std::vector<std::array<int, 3>>& list, std::vector<Piece>* pieces) const {
    for (const auto& corners : list) {
      const Vector3d a = unit_ * boundary_.vertices[corners[0]],
                     b = unit_ * boundary_.vertices[corners[1]],
                     c = unit_ * boundary_.vertices[corners[2]];
      // Far above any rounding, and boxes only choose what is tested exactly.
      const Vector3d margin = Vector3d::Constant(1e-9);
      pieces->push_back({a.cwiseMin(b).cwiseMin(c) - margin, a.cwiseMax(b).cwiseMax(c) + margin,
                         context_.Triangle(corners)});
    }
  }

  // Of the pieces that face along the plane's normal (sense 1), against it (-1), or either (0).
  Held Count(const std::vector<Piece>& pieces, const SumPlane& plane, const RationalPoint& x,
             int sense) const {
    const RationalPoint place = context_.sum.ToTrue(x);
    const Vector3d at = unit_ * Vector3d(place[0].get_d(), place[1].get_d(), place[2].get_d());
    Held held;
    for (const Piece& piece : pieces) {
      if ((at.array() < piece.low.array()).any() || (at.array() > piece.high.array()).any())
        continue;
      const auto& corners = piece.triangle.corners();
      if (std::any_of(corners.begin(), corners.end(),
                      [&](const RationalPoint& corner) { return Side(plane, corner) != 0; }) ||
          !piece.triangle.Holds(x)) {
        continue;
      }
      const int axis = piece.triangle.axis();
      const int agrees = sgn(piece.triangle.normal()[axis]) * sgn(plane.normal[axis]);
      if (sense != 0 && agrees != sense) continue;
      ++(piece.triangle.HoldsInside(x) ? held.inside : held.on_border);
    }
    return held;
  }

  void Check(const SumCell& cell) {
    const SumPlane plane = context_.sum.Plane(cell.facet);
    const Held along = Count(triangles_, plane, cell.sample, 1);
    const Held against = Count(triangles_, plane, cell.sample, -1);
    const Held sheets = Count(sheets_, plane, cell.sample, 0);
    const auto expect = [&](bool condition, const char* detail) {
      if (!condition) context_.Add(SumFindingKind::kMissing, detail);
    };
    expect(cell.kind == SumCell::Kind::kOuter ? along.is_once() : along.is_never(),
           "a piece of a facet that faces as it does is not kept rightly");
    expect(cell.kind == SumCell::Kind::kInner ? against.is_once() : against.is_never(),
           "a piece of a facet that faces against it is not kept rightly");
    expect(cell.kind == SumCell::Kind::kSheet ? sheets.is_once() : sheets.is_never(),
           "a sheet is not kept rightly");
  }

  const SumContext& context_;
  const SumBoundary& boundary_;
  const double unit_;
  std::vector<Piece> triangles_, sheets_;
};

}  // namespace

void CheckAllCells(const SumContext& context) { CellCheck(context).Run(); }

}  // namespace touchstone::exact
