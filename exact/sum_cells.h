// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef TOUCHSTONE_EXACT_SUM_CELLS_H_
#define TOUCHSTONE_EXACT_SUM_CELLS_H_

#include <vector>

#include "touchstone/exact/exact_sum.h"

namespace touchstone::exact {

// A connected piece of a facet of M, cut by all others.
struct SumCell {
  SumFacet facet;
  RationalPoint sample;  // inside it
  // The piece against M°: kOuter has M° on its inner side only, kInner on its outer side only
  // (where facets lie in one plane and face both ways), kSheet on both, and is in ∂M all the same:
  // a slot.
  enum class Kind { kBuried, kOuter, kInner, kSheet } kind;
  // For kOuter and kInner: what it adds to the volume of closure(M°), in the integers' units; by
  // the divergence theorem, a third of N.x dA.
  mpq_class volume;
};

// ∂M by an arrangement that shares nothing with the core's: the facets of M, one after another,
// are cut by all others in fractions, and each piece is placed by exact membership at a sample and
// a step to either side of it. Where facets of one plane overlap, a piece counts for the first of
// them. With `contacts_only` facets that cannot touch (ExactSum::CanTouch) are left out; else the
// oracle trusts no theory of contacts at all, and costs as much more.
//
// This is the oracle for sizes that Nef polyhedra do not reach, and beside them at small ones: Nef
// sums cut bodies into convex parts first and never see a facet of M. Complexity: for n facets, m
// of which cross each, O(n^2) and O(n m^3) with numbers of hundreds of bits: for hundreds of
// facets.
std::vector<SumCell> FindSumCells(const ExactSum& sum, bool contacts_only);

// The volume of closure(M°), in true units.
mpq_class VolumeOf(const ExactSum& sum, const std::vector<SumCell>& cells);

}  // namespace touchstone::exact

#endif  // TOUCHSTONE_EXACT_SUM_CELLS_H_
