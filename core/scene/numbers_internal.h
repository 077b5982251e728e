// SPDX-License-Identifier: MIT
//
// Distance, depth and travel of two convex parts, for pairs that are subscribed to them.
#ifndef TOUCHSTONE_CORE_SCENE_NUMBERS_INTERNAL_H_
#define TOUCHSTONE_CORE_SCENE_NUMBERS_INTERNAL_H_

#include <array>
#include <cstddef>
#include <optional>

#include "touchstone/core/cpd/mesh_penetration_depth.h"
#include "touchstone/core/proximity/directional_distance.h"
#include "touchstone/core/proximity/distance.h"
#include "touchstone/core/proximity/penetration_depth.h"
#include "touchstone/core/scene/convex_pair_internal.h"
#include "touchstone/core/scene/mesh_pair_internal.h"

namespace touchstone::internal {

// What is wanted of one pair, its caches, and what the last step found.
struct PairNumbers {
  int p = -1, q = -1;  // parts; -1: not in use

  std::optional<double> margin;  // of the distance
  bool depth = false;
  // Directions in which Q travels, in the world's frame: of body a (negated), of body b, of the
  // pair.
  struct Travel {
    Eigen::Vector3d direction;
    double reach;
  };
  std::array<std::optional<Travel>, 3> travels;

  DistanceCache distance_cache;
  PenetrationCache penetration_cache;
  std::optional<MeshDepthCache> mesh_depth_cache;  // made when first needed
  // The distance stays above the margin while the parts' travels add up to less than this.
  double distance_limit;
  bool is_fresh = true;  // nothing was computed yet

  std::optional<DistanceResult> distance_found;  // at most the margin
  std::optional<PenetrationResult> depth_found;
  std::optional<MeshDepthResult> mesh_depth_found;
  std::array<std::optional<DirectionalResult>, 3> travels_found;

  bool any() const { return margin || depth || travels[0] || travels[1] || travels[2]; }
};

// Each fills what was found, or empties it. Requires convex parts but where it says otherwise.
//
// Whether the distance is at most the margin is decided in the same way whatever the cache holds:
// claimed errors are below 1e-12 of the pair's size, so that where a warm answer is within 1e-11 of
// the size of the margin the question is asked anew without the cache, and elsewhere any answer
// decides alike.
// Returns a proven amount by which the distance exceeds the margin, or zero.
double FindDistance(const PlacedPart& p, const PlacedPart& q, const SceneRules& rules,
                    PairNumbers* numbers, SceneCounters* counters);
void FindDepth(const PlacedPart& p, const PlacedPart& q, const SceneRules& rules,
               PairNumbers* numbers, SceneCounters* counters);
// Of two parts of which one is a mesh at least.
void FindMeshDepth(const PlacedPart& p, const PlacedPart& q, const SceneRules& rules,
                   MeshPairState* meshes, PairNumbers* numbers, SceneCounters* counters);
void FindTravels(const PlacedPart& p, const PlacedPart& q, PairNumbers* numbers,
                 SceneCounters* counters);

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_SCENE_NUMBERS_INTERNAL_H_
