// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_MINKOWSKI_PATCHES_INTERNAL_H_
#define TOUCHSTONE_CORE_MINKOWSKI_PATCHES_INTERNAL_H_

#include <span>
#include <vector>

#include "touchstone/core/minkowski/cells_internal.h"
#include "touchstone/core/minkowski/flat_table_internal.h"

namespace touchstone::internal {

// From how many sides facets cover a cell: 1, or 2.
inline int FacingSides(const Cell& cell) { return !cell.along.empty() + !cell.against.empty(); }

// Cells that lie in M° together or not at all, so that one answer of membership does for all.
//
// Cells that meet along a piece with no third beside them are such: nothing else of ∂M comes there.
// Nor do two part company where all others at their piece are buried: the wedges beside a buried
// cell are in M°, and only one between the two can be out of it; it is, and both are on ∂M, or it
// is not, and both are in M°. (That holds of cells faced from one side: they have no other contact
// than their facet's, so just outside ∂M's M° ends. One faced from both may be an exact slot.)
// Complexity: linear in the sides of cells.
class Patches {
 public:
  // `is_known` tells of which pieces all cells are there; empty: of all. The cells must live on.
  void Form(const CellComplex& complex, std::span<const char> is_known);

  // The cells at a piece, one entry for each side that borders it.
  std::span<const int> CellsAt(int piece) const { return cells_of_piece_.Of(piece); }
  // The patch of a cell: the number of one of its cells.
  int of(int cell) const { return patch_[cell]; }
  // Whether a cell of it is known to be buried, and so all are.
  bool is_buried(int patch) const { return is_buried_[patch] != 0; }

 private:
  void JoinOverCrossing(const CellComplex& complex, std::span<const int> cells);
  int Root(int cell);

  ItemLists<int> cells_of_piece_;
  std::vector<int> patch_;
  std::vector<char> is_buried_;
};

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_MINKOWSKI_PATCHES_INTERNAL_H_
