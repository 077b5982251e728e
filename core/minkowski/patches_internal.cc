// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/patches_internal.h"

#include <array>
#include <numeric>

namespace touchstone::internal {

void Patches::Form(const CellComplex& complex, std::span<const char> is_known) {
  const int cells = static_cast<int>(complex.cells.size());
  const int pieces = static_cast<int>(complex.pieces.size());
  cells_of_piece_ = ListByOwner<int>(pieces, [&](const auto& visit) {
    for (int c = 0; c < cells; ++c) {
      for (const int piece : complex.cells[c].pieces) visit(piece, c);
    }
  });
  const auto known = [&](int piece) { return is_known.empty() || is_known[piece] != 0; };
  patch_.resize(complex.cells.size());
  std::iota(patch_.begin(), patch_.end(), 0);
  for (int i = 0; i < pieces; ++i) {
    const std::span<const int> at = CellsAt(i);
    if (at.size() == 2 && known(i)) patch_[Root(at[0])] = Root(at[1]);
  }
  is_buried_.assign(complex.cells.size(), 0);
  for (int c = 0; c < cells; ++c) is_buried_[Root(c)] |= complex.cells[c].is_buried;
  for (int i = 0; i < pieces; ++i) {
    if (CellsAt(i).size() > 2 && known(i)) JoinOverCrossing(complex, CellsAt(i));
  }
  for (int c = 0; c < cells; ++c) patch_[c] = Root(c);
}

void Patches::JoinOverCrossing(const CellComplex& complex, std::span<const int> cells) {
  std::array<int, 2> open{};
  int count = 0;
  for (const int c : cells) {
    if (is_buried_[Root(c)]) continue;
    if (count == 2 || FacingSides(complex.cells[c]) != 1) return;
    open[count++] = c;
  }
  if (count == 2) patch_[Root(open[0])] = Root(open[1]);
}

int Patches::Root(int cell) {
  while (patch_[cell] != cell) cell = patch_[cell] = patch_[patch_[cell]];
  return cell;
}

}  // namespace touchstone::internal
