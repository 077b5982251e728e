// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_MINKOWSKI_CELL_LISTS_INTERNAL_H_
#define TOUCHSTONE_CORE_MINKOWSKI_CELL_LISTS_INTERNAL_H_

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "touchstone/core/minkowski/cells_internal.h"

namespace touchstone::internal {

// Cells as they come, their lists one after the other.
class CellLists {
 public:
  void BeginCell(int group) {
    drafts_.push_back({group, false, End(loop_ends_), End(pieces_), End(facets_), End(facets_)});
  }
  void AddFacet(int facet) { facets_.push_back(facet); }
  void BeginAgainst() { drafts_.back().first_against = End(facets_); }
  void AddToLoop(int point, int piece) {
    points_.push_back(point);
    pieces_.push_back(piece);
  }
  void EndLoop(bool is_buried) {
    loop_ends_.push_back(End(points_));
    drafts_.back().is_buried |= is_buried;
  }
  // Of the last cell, from a place on: sorts.
  void SortFacets() {
    const Draft& own = drafts_.back();
    std::sort(facets_.begin() + own.first_facet, facets_.begin() + own.first_against);
    std::sort(facets_.begin() + own.first_against, facets_.end());
  }

  void MoveTo(CellComplex* complex) {
    complex->points_of_loops = std::move(points_);
    complex->pieces_of_cells = std::move(pieces_);
    complex->facets_of_cells = std::move(facets_);
    const std::span<const int> points(complex->points_of_loops);
    complex->loops_of_cells.reserve(loop_ends_.size());
    int begin = 0;
    for (const int end : loop_ends_) {
      complex->loops_of_cells.push_back(Part(points, begin, end));
      begin = end;
    }
    const std::span<const std::span<const int>> loops(complex->loops_of_cells);
    const std::span<const int> pieces(complex->pieces_of_cells), facets(complex->facets_of_cells);
    const Draft last{-1,
                     false,
                     End(loop_ends_),
                     static_cast<int>(pieces.size()),
                     static_cast<int>(facets.size()),
                     static_cast<int>(facets.size())};
    complex->cells.reserve(drafts_.size());
    for (std::size_t c = 0; c < drafts_.size(); ++c) {
      const Draft &own = drafts_[c], &next = c + 1 < drafts_.size() ? drafts_[c + 1] : last;
      complex->cells.push_back({own.group, Part(loops, own.first_loop, next.first_loop),
                                Part(facets, own.first_facet, own.first_against),
                                Part(facets, own.first_against, next.first_facet), own.is_buried,
                                Part(pieces, own.first_piece, next.first_piece)});
    }
  }

 private:
  struct Draft {
    int group;
    bool is_buried;
    int first_loop, first_piece, first_facet, first_against;
  };

  static int End(const std::vector<int>& list) { return static_cast<int>(list.size()); }
  template <class Item>
  static std::span<const Item> Part(std::span<const Item> list, int begin, int end) {
    return list.subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(end - begin));
  }

  std::vector<Draft> drafts_;
  std::vector<int> loop_ends_, points_, pieces_, facets_;
};

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_MINKOWSKI_CELL_LISTS_INTERNAL_H_
