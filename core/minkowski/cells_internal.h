// SPDX-License-Identifier: MIT
//
// Stage two of the boundary: the pieces into which walls cut a group of facets.
#ifndef TOUCHSTONE_CORE_MINKOWSKI_CELLS_INTERNAL_H_
#define TOUCHSTONE_CORE_MINKOWSKI_CELLS_INTERNAL_H_

#include <span>
#include <vector>

#include "touchstone/core/minkowski/arrangement_internal.h"
#include "touchstone/core/minkowski/sum_geometry_internal.h"

namespace touchstone::internal {

// A piece of a segment between two neighbouring points on it; segments that overlap share pieces.
struct Piece {
  int from, to;  // representatives, from < to
};

// An open connected piece of a group's plane that some of its facets cover.
struct Cell {
  int group;
  // Its borders as cyclic lists of points with the cell on the left, seen against the group's
  // normal: first the outer one, then one round each hole. A border may pass a point, or both sides
  // of a piece, more than once.
  std::span<const std::span<const int>> loops;
  // The facets that cover it, in two lists: those that face as the group's normal does, and the
  // others.
  std::span<const int> along, against;
  // Whether a facet that passes through was seen to bury it: then it lies in M°.
  bool is_buried = false;
  std::span<const int> pieces;  // that border it, one entry for each side that does
};

// The lists of cells lie in one piece of memory each, at the end.
struct CellComplex {
  CellComplex() = default;
  CellComplex(CellComplex&&) = default;
  CellComplex& operator=(CellComplex&&) = default;

  std::vector<Piece> pieces;
  std::vector<Cell> cells;

  std::vector<std::span<const int>> loops_of_cells;
  std::vector<int> points_of_loops, pieces_of_cells, facets_of_cells;
};

// Cuts every group that has walls into cells. A cell is buried if it borders, on the inner side of
// a facet, on a segment within that facet's inside: points just inside a facet lie in M°.
// Complexity: O(w log w) a group, and O(w c) where its walls hang together in c > 1 parts.
CellComplex FindCells(SumGeometry* geometry, const Arrangement& arrangement);

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_MINKOWSKI_CELLS_INTERNAL_H_
