// SPDX-License-Identifier: MIT
//
// Eight triangles against eight: a plane that parts two of them mostly parts others.
#ifndef TOUCHSTONE_CORE_MESH_TRIANGLE_LANES_INTERNAL_H_
#define TOUCHSTONE_CORE_MESH_TRIANGLE_LANES_INTERNAL_H_

#include <cstdint>

#include "touchstone/core/mesh/triangle_contact_internal.h"

namespace touchstone::internal {

// Pairs of faces of two leaves: bit 8 j + i for faces i of A's and j of B's. Of those that are left
// out doubles prove that they share no point.
//
// Leaves out what either leaf's slab or the faces' boxes part. By vectors of eight or of four, with
// the same result.
std::uint64_t MeetingFacesInEights(const PlacedMesh& a, const BoxNode& leaf_a, const PlacedMesh& b,
                                   const BoxNode& leaf_b, const Offset& offset);
std::uint64_t MeetingFacesInFours(const PlacedMesh& a, const BoxNode& leaf_a, const PlacedMesh& b,
                                  const BoxNode& leaf_b, const Offset& offset);
// Whether the processor has vectors of eight, and the library code for them.
bool HasEights();
// Looks for a plane that parts the first of the pairs, and leaves out all that it parts. It lies
// across a side of each or along one of the faces; of these eleven planes the best of eight is
// taken in round 0, the best of the others in round 1. Requires a pair.
inline constexpr int kPartingRounds = 2;
std::uint64_t PartFirst(const FaceLanes& lanes_a, const FaceLanes& lanes_b, const Offset& offset,
                        std::uint64_t pairs, int round);

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_MESH_TRIANGLE_LANES_INTERNAL_H_
