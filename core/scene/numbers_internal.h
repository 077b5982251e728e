// SPDX-License-Identifier: MIT
//
// Distance, depths and travel of two parts, for pairs that are subscribed to them.
#ifndef TOUCHSTONE_CORE_SCENE_NUMBERS_INTERNAL_H_
#define TOUCHSTONE_CORE_SCENE_NUMBERS_INTERNAL_H_

#include <array>
#include <cstddef>
#include <optional>

#include "touchstone/core/cpd/continuous_penetration_depth.h"
#include "touchstone/core/cpd/mesh_penetration_depth.h"
#include "touchstone/core/mesh/surface_distance.h"
#include "touchstone/core/mesh/surface_travel.h"
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
  bool depth = false, cpd = false;
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
  // While they overlap. No guess: it follows the motion, so no rule does without it, and it begins
  // afresh, so that no other pair's past is in it.
  std::optional<ContinuousPenetrationDepth> continuous_depth;
  // The distance stays above the margin while the parts' travels add up to less than this.
  double distance_limit;
  bool is_fresh = true;  // nothing was computed yet

  struct Found {
    std::optional<DistanceResult> distance;  // at most the margin
    std::optional<SurfaceDistanceResult> mesh_distance;
    std::optional<PenetrationResult> depth;
    std::optional<MeshDepthResult> mesh_depth;
    std::optional<ContinuousDepthResult> continuous_depth;
    std::array<std::optional<DirectionalResult>, 3> travels;
    std::array<std::optional<SurfaceTravelResult>, 3> mesh_travels;
  } found;

  bool any() const { return margin || depth || cpd || travels[0] || travels[1] || travels[2]; }
};

// Each fills what was found, or empties it. Those of meshes are for two parts of which one is a
// mesh at least, placed in `meshes`, and whose verdict is known; the others for convex parts.
//
// Whether the distance is at most the margin is decided in the same way whatever the cache holds:
// claimed errors are below 1e-12 of the pair's size, so that where a warm answer is within 1e-11 of
// the size of the margin the question is asked anew without the cache, and elsewhere any answer
// decides alike. Distances of meshes have no cache.
// Return a proven amount by which the distance exceeds the margin, or zero.
double FindDistance(const PlacedPart& p, const PlacedPart& q, const SceneRules& rules,
                    PairNumbers* numbers, SceneCounters* counters);
double FindMeshDistance(const MeshPair& meshes, Verdict verdict, MeshPairState* state,
                        PairNumbers* numbers, SceneCounters* counters);

void FindDepth(const PlacedPart& p, const PlacedPart& q, const SceneRules& rules,
               PairNumbers* numbers, SceneCounters* counters);
void FindMeshDepth(const PlacedPart& p, const PlacedPart& q, const SceneRules& rules,
                   const MeshPair& meshes, PairNumbers* numbers, SceneCounters* counters);
// Of any parts. Requires to be called whenever they move, and not when they do not.
void FindContinuousDepth(const PlacedPart& p, const PlacedPart& q, Verdict verdict,
                         PairNumbers* numbers, SceneCounters* counters);

void FindTravels(const PlacedPart& p, const PlacedPart& q, PairNumbers* numbers,
                 SceneCounters* counters);
void FindMeshTravels(const PlacedPart& p, const MeshPair& meshes, Verdict verdict,
                     MeshPairState* state, PairNumbers* numbers, SceneCounters* counters);

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_SCENE_NUMBERS_INTERNAL_H_
