// SPDX-License-Identifier: GPL-3.0-or-later
#include "touchstone/exact/sum_cells.h"

#include <algorithm>

#include "touchstone/exact/mesh_membership.h"

namespace touchstone::exact {
namespace {

using Box = std::array<RationalPoint, 2>;

class Arrangement {
 public:
  Arrangement(const ExactSum& sum, bool contacts_only)
      : sum_(sum), facets_(sum.AllFacets(contacts_only)) {
    for (const SumFacet& facet : facets_) {
      planes_.push_back(sum_.Plane(facet));
      triangles_.push_back(sum_.Triangles(facet));
      Box box{triangles_.back()[0].corners()[0], triangles_.back()[0].corners()[0]};
      for (const RationalTriangle& t : triangles_.back()) {
        for (const RationalPoint& x : t.corners()) {
          for (int i = 0; i < 3; ++i) {
            box[0][i] = std::min(box[0][i], x[i]);
            box[1][i] = std::max(box[1][i], x[i]);
          }
        }
      }
      boxes_.push_back(box);
    }
  }

  std::vector<SumCell> Run() {
    for (std::size_t f = 0; f < facets_.size(); ++f) CutFacet(f);
    return std::move(cells_);
  }

 private:
  void CutFacet(std::size_t f) {
    std::vector<std::size_t> coplanar_before;
    std::vector<std::size_t> crossing;
    for (std::size_t g = 0; g < facets_.size(); ++g) {
      if (g == f || !BoxesMeet(boxes_[f], boxes_[g])) continue;
      const int side = SideOf(planes_[f], g);
      if (side == 0 && g < f) coplanar_before.push_back(g);
      if (side == 0 || side == kBoth) crossing.push_back(g);
    }
    for (const RationalTriangle& t : triangles_[f]) {
      std::vector<RationalSegment> cuts;
      for (const std::size_t g : crossing) AddCuts(t, g, &cuts);
      for (const RationalTriangle::Piece& piece : t.Pieces(cuts)) {
        const bool is_counted =
            std::any_of(coplanar_before.begin(), coplanar_before.end(), [&](std::size_t g) {
              return std::any_of(triangles_[g].begin(), triangles_[g].end(),
                                 [&](const RationalTriangle& u) { return u.Holds(piece.sample); });
            });
        if (!is_counted) AddCell(f, t, piece);
      }
    }
  }

  static constexpr int kBoth = 2;

  // The side of a plane that a facet's corners lie on: 0 if they all lie in it, kBoth if on both,
  // or if on one side but for an edge or a corner in the plane.
  int SideOf(const SumPlane& plane, std::size_t g) const {
    int least = 1, greatest = -1;
    for (const RationalTriangle& t : triangles_[g]) {
      for (const RationalPoint& x : t.corners()) {
        const int side = Side(plane, x);
        least = std::min(least, side);
        greatest = std::max(greatest, side);
      }
    }
    return least == greatest ? least : kBoth;
  }

  static bool BoxesMeet(const Box& a, const Box& b) {
    for (int i = 0; i < 3; ++i) {
      if (a[0][i] > b[1][i] || b[0][i] > a[1][i]) return false;
    }
    return true;
  }

  void AddCuts(const RationalTriangle& t, std::size_t g, std::vector<RationalSegment>* cuts) const {
    for (const RationalTriangle& u : triangles_[g]) {
      const auto& [a, b, c] = u.corners();
      if (t.Side(a) == 0 && t.Side(b) == 0 && t.Side(c) == 0) {
        for (const RationalSegment& side : {RationalSegment{a, b}, {b, c}, {c, a}}) {
          if (t.Meets(side)) cuts->push_back(side);
        }
        continue;
      }
      const std::optional<RationalSegment> cut = t.CutFrom(u);
      if (cut && cut->first != cut->second && t.Meets(*cut)) cuts->push_back(*cut);
    }
  }

  Verdict At(const RationalPoint& x) const {
    return MeshMembership(sum_.pair(), sum_.ToTranslation(x));
  }

  void AddCell(std::size_t f, const RationalTriangle& t, const RationalTriangle::Piece& piece) {
    SumCell cell{facets_[f], piece.sample, SumCell::Kind::kBuried, 0};
    if (At(piece.sample) != Verdict::kOverlap) {
      const mpq_class step = sum_.StepBelowAnyOther(piece.sample);
      const IntegerVector& normal = planes_[f].normal;
      const bool in_inside = At(Along(piece.sample, -step, normal)) == Verdict::kOverlap;
      const bool in_outside = At(Along(piece.sample, step, normal)) == Verdict::kOverlap;
      cell.kind = in_inside && in_outside ? SumCell::Kind::kSheet
                  : in_outside            ? SumCell::Kind::kInner
                                          : SumCell::Kind::kOuter;
      if (cell.kind != SumCell::Kind::kSheet) {
        const int sense = cell.kind == SumCell::Kind::kOuter ? 1 : -1;
        cell.volume = sense * piece.area * planes_[f].offset / (3 * Integer(abs(normal[t.axis()])));
      }
    }
    cells_.push_back(std::move(cell));
  }

  const ExactSum& sum_;
  const std::vector<SumFacet> facets_;
  std::vector<SumPlane> planes_;
  std::vector<std::vector<RationalTriangle>> triangles_;
  std::vector<Box> boxes_;
  std::vector<SumCell> cells_;
};

}  // namespace

std::vector<SumCell> FindSumCells(const ExactSum& sum, bool contacts_only) {
  return Arrangement(sum, contacts_only).Run();
}

mpq_class VolumeOf(const ExactSum& sum, const std::vector<SumCell>& cells) {
  mpq_class volume = 0;
  for (const SumCell& cell : cells) volume += cell.volume;
  const mpq_class unit = sum.ToTrue({1, 0, 0})[0];
  return volume * unit * unit * unit;
}

}  // namespace touchstone::exact
