// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_SCENE_MESH_PAIR_INTERNAL_H_
#define TOUCHSTONE_CORE_SCENE_MESH_PAIR_INTERNAL_H_

#include <optional>
#include <utility>
#include <vector>

#include "touchstone/core/mesh/membership.h"
#include "touchstone/core/mesh/mesh_pair.h"
#include "touchstone/core/mesh/surface_distance.h"
#include "touchstone/core/mesh/surface_travel.h"
#include "touchstone/core/scene/convex_pair_internal.h"

namespace touchstone::internal {

// What a pair with a mesh in it keeps: guesses and memory.
struct MeshPairState {
  std::optional<MeshPair> pair;  // made when first needed: the size of both meshes
  MembershipCache cache;
  SurfaceDistanceCache distance_cache;
  SurfaceTravelCache travel_cache;
  std::vector<std::pair<int, int>> stack;
  std::pair<int, int> crossing{-1, -1};  // faces that crossed last

  std::size_t bytes() const;
};

// As DecideConvex, for parts of which one is a mesh at least. Membership's words: overlap where the
// interiors meet, touch where only the boundaries do. `enough` is a margin beyond which no more is
// worth finding.
Margin DecideMesh(const PlacedPart& p, const PlacedPart& q, const SceneRules& rules, double enough,
                  MeshPairState* state, SceneCounters* counters);

// The pair with both meshes placed where the parts are.
const MeshPair& PlaceMeshes(const PlacedPart& p, const PlacedPart& q, MeshPairState* state);

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_SCENE_MESH_PAIR_INTERNAL_H_
