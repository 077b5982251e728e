// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef TOUCHSTONE_EXACT_MESH_MEMBERSHIP_H_
#define TOUCHSTONE_EXACT_MESH_MEMBERSHIP_H_

#include "touchstone/core/base/verdict.h"
#include "touchstone/exact/mesh_pair.h"

namespace touchstone::exact {

// Do A and B + x overlap, touch, or stay separate? Exactly; never kUndecided.
//
// The interiors meet iff some face of one has a piece of positive area inside the other, or on a
// face of the other that faces the same way. Faces that meet nothing are inside or outside as their
// neighbours are; every other face is cut by those it meets, and each cell of that arrangement gets
// a sample point, which is placed by a ray. Fractions throughout; doubles with a bound decide most
// signs first. Independent of the core, which compares links of features instead.
//
// Complexity: O(k log n) for k pairs of faces that come near each other while they do not meet; a
// face that meets others costs O(m^2 n) for m of them.
Verdict MeshMembership(const PlacedMeshPair& pair, const ExactTranslation& x);

}  // namespace touchstone::exact

#endif  // TOUCHSTONE_EXACT_MESH_MEMBERSHIP_H_
