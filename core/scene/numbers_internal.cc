// SPDX-License-Identifier: MIT
#include "touchstone/core/scene/numbers_internal.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace touchstone::internal {
namespace {

// In P's frame lengths are those of the world up to this factor.
constexpr double kToWorld = 1.0 - 1e-5;

RelativePose PoseOf(const PlacedPart& p, const PlacedPart& q) {
  const auto pose = RelativePose::FromWorld(*p.pose, *q.pose);
  assert(pose.ok());  // kMaxWorldTranslation
  return *pose;
}

// By how much a distance exceeds a margin for sure. The margin is one of P's frame, too; and it is
// exceeded by more than any answer is off.
double Beyond(double margin, double proven_distance, double size) {
  return std::max(0.0, kToWorld * proven_distance - (margin / kToWorld + 1e-10 * size));
}

// In P's frame; its exact image is never asked for.
Eigen::Vector3d DirectionOf(const PlacedPart& p, const PairNumbers::Travel& travel) {
  return p.pose->rotation.transpose() * travel.direction;
}

}  // namespace

double FindDistance(const PlacedPart& p, const PlacedPart& q, const SceneRules& rules,
                    PairNumbers* numbers, SceneCounters* counters) {
  numbers->found.distance.reset();
  const RelativePose pose = PoseOf(p, q);
  const double margin = *numbers->margin;
  const double size = p.part->max_coordinate() + 2.0 * q.part->max_coordinate() +
                      pose.translation().cwiseAbs().maxCoeff();
  const ConvexPolyhedron &body_p = p.part->convex(), &body_q = q.part->convex();
  ++counters->distances;
  DistanceResult result =
      Distance(body_p, body_q, pose, {}, rules.guesses ? &numbers->distance_cache : nullptr);
  if (rules.guesses && std::abs(result.distance.value - margin) <= 1e-11 * size) {
    ++counters->distances;
    result = Distance(body_p, body_q, pose);
  }
  if (result.distance.value <= margin) {
    numbers->found.distance = result;
    return 0.0;
  }
  return Beyond(margin, result.lower, size);
}

double FindMeshDistance(const MeshPair& meshes, Verdict verdict, MeshPairState* state,
                        PairNumbers* numbers, SceneCounters* counters) {
  numbers->found.mesh_distance.reset();
  if (verdict != Verdict::kSeparate) {
    numbers->found.mesh_distance.emplace();
    return 0.0;
  }
  ++counters->distances;
  const SurfaceDistanceResult result = SurfaceDistance(meshes, &state->distance_cache);
  if (result.distance <= *numbers->margin) {
    numbers->found.mesh_distance = result;
    return 0.0;
  }
  return Beyond(*numbers->margin, result.lower_bound, 1.0 / meshes.scale());
}

void FindDepth(const PlacedPart& p, const PlacedPart& q, const SceneRules& rules,
               PairNumbers* numbers, SceneCounters* counters) {
  ++counters->depths;
  if (!rules.guesses) numbers->penetration_cache.Clear();
  numbers->found.depth = PenetrationDepth(p.part->convex(), q.part->convex(), PoseOf(p, q), {},
                                          &numbers->penetration_cache);
}

void FindMeshDepth(const PlacedPart& p, const PlacedPart& q, const SceneRules& rules,
                   const MeshPair& meshes, PairNumbers* numbers, SceneCounters* counters) {
  ++counters->depths;
  if (!numbers->mesh_depth_cache) numbers->mesh_depth_cache.emplace();
  if (!rules.guesses) numbers->mesh_depth_cache->Clear();
  numbers->found.mesh_depth = MeshPenetrationDepth(
      meshes, p.part->contact_body(), q.part->contact_body(), {}, &*numbers->mesh_depth_cache);
}

void FindContinuousDepth(const PlacedPart& p, const PlacedPart& q, Verdict verdict,
                         PairNumbers* numbers, SceneCounters* counters) {
  const bool goes_on = numbers->found.continuous_depth.has_value();
  numbers->found.continuous_depth.reset();
  if (verdict != Verdict::kOverlap) {
    numbers->continuous_depth.reset();
    return;
  }
  if (!goes_on) numbers->continuous_depth.emplace(p.part->mesh(), q.part->mesh());
  ++counters->continuous_depths;
  numbers->found.continuous_depth = numbers->continuous_depth->Update(PoseOf(p, q));
}

void FindTravels(const PlacedPart& p, const PlacedPart& q, PairNumbers* numbers,
                 SceneCounters* counters) {
  const RelativePose pose = PoseOf(p, q);
  for (std::size_t k = 0; k < numbers->travels.size(); ++k) {
    numbers->found.travels[k].reset();
    if (!numbers->travels[k]) continue;
    ++counters->travels;
    const auto result = DirectionalDistance(p.part->convex(), q.part->convex(), pose,
                                            DirectionOf(p, *numbers->travels[k]));
    if (!result.ok() || result->kind != TravelKind::kInterval) continue;
    // It begins within [0, reach]; bodies that meet already are at travel zero.
    if (result->leave.travel.value < 0.0) continue;
    if (result->enter.travel.value > numbers->travels[k]->reach) continue;
    numbers->found.travels[k] = *result;
  }
}

void FindMeshTravels(const PlacedPart& p, const MeshPair& meshes, Verdict verdict,
                     MeshPairState* state, PairNumbers* numbers, SceneCounters* counters) {
  for (std::size_t k = 0; k < numbers->travels.size(); ++k) {
    std::optional<SurfaceTravelResult>& found = numbers->found.mesh_travels[k];
    found.reset();
    if (!numbers->travels[k]) continue;
    if (verdict != Verdict::kSeparate) {
      found.emplace().is_hit = true;
      continue;
    }
    ++counters->travels;
    const SurfaceTravelResult result =
        SurfaceTravel(meshes, DirectionOf(p, *numbers->travels[k]), numbers->travels[k]->reach,
                      &state->travel_cache);
    if (result.is_hit) found = result;
  }
}

}  // namespace touchstone::internal
