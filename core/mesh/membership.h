// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_MESH_MEMBERSHIP_H_
#define TOUCHSTONE_CORE_MESH_MEMBERSHIP_H_

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "touchstone/core/base/verdict.h"
#include "touchstone/core/mesh/crossing_prism.h"
#include "touchstone/core/mesh/mesh_pair.h"
#include "touchstone/core/mesh/translation.h"

namespace touchstone {

struct MembershipOptions {
  Certainty certainty = Certainty::kExact;
  // Pairs of a face of A and one of B that the caller knows to share a single point at this
  // translation, near which the solids do not overlap. Spares doubles what they cannot tell.
  std::span<const std::pair<int, int>> contacts = {};
};

struct MembershipResult {
  // kOverlap: the interiors of A and B + x meet: x is in M°. kTouch: only the boundaries meet; x is
  // on the boundary of M° or in none of its closure's interior: a slot filled exactly. kSeparate:
  // no point is shared. kUndecided: doubles could not tell; under Certainty::kFloat only.
  Verdict verdict = Verdict::kUndecided;
  Tier tier = Tier::kNone;
  // Two faces that cross or touch, where that settled the verdict; -1 if containment did, or the
  // bodies are separate.
  int face_a = -1, face_b = -1;
  int box_tests = 0;  // pairs of nodes; where the cache's prism answers, this and all below are 0
  int triangle_tests = 0;  // pairs of triangles in doubles
  int exact_tests = 0;     // pairs of triangles with big numbers
};

// Owned by the caller; speeds up questions about nearby translations and makes a warm query free of
// allocations. Answers do not depend on it. One per thread; any pair.
struct MembershipCache {
  Crossing crossing;                               // an edge and a face that crossed last time
  CrossingPrism prism;                             // of these, once they were asked about again
  std::vector<std::pair<int, int>> stack;          // nodes to compare
  std::vector<std::pair<int, int>> unsure;         // faces that doubles left open
  std::vector<std::uint8_t> touched_a, touched_b;  // components that the other surface meets
};

// Do the interiors of A and B + x share a point?
//
// Requires a finite x. Boxes of the two trees are compared, then triangles in doubles with
// bounds; pairs that doubles leave open are decided with big numbers where the caller asks for
// certainty; when the surfaces do not cross, one vertex of every component that the other surface
// does not meet tells whether it lies inside.
//
// Complexity: O(k + log n) for k pairs of triangles that come near each other. No errors.
MembershipResult Membership(const MeshPair& pair, const Translation& x,
                            const MembershipOptions& options = {},
                            MembershipCache* cache = nullptr);

// The same for many translations; results[i] answers translations[i]. Near ones are best listed
// one after the other. Requires spans of equal length.
void Membership(const MeshPair& pair, std::span<const Eigen::Vector3d> translations,
                std::span<MembershipResult> results, const MembershipOptions& options = {},
                MembershipCache* cache = nullptr);

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_MESH_MEMBERSHIP_H_
