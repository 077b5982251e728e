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

}  // namespace

double FindDistance(const PlacedPart& p, const PlacedPart& q, const SceneRules& rules,
                    PairNumbers* numbers, SceneCounters* counters) {
  numbers->distance_found.reset();
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
    numbers->distance_found = result;
    return 0.0;
  }
  // The margin is one of P's frame, too; and beyond it by more than any answer is off.
  return std::max(0.0, kToWorld * result.lower - (margin / kToWorld + 1e-10 * size));
}

void FindDepth(const PlacedPart& p, const PlacedPart& q, const SceneRules& rules,
               PairNumbers* numbers, SceneCounters* counters) {
  ++counters->depths;
  if (!rules.guesses) numbers->penetration_cache.Clear();
  numbers->depth_found = PenetrationDepth(p.part->convex(), q.part->convex(), PoseOf(p, q), {},
                                          &numbers->penetration_cache);
}

void FindMeshDepth(const PlacedPart& p, const PlacedPart& q, const SceneRules& rules,
                   MeshPairState* meshes, PairNumbers* numbers, SceneCounters* counters) {
  ++counters->depths;
  if (!numbers->mesh_depth_cache) numbers->mesh_depth_cache.emplace();
  if (!rules.guesses) numbers->mesh_depth_cache->Clear();
  numbers->mesh_depth_found =
      MeshPenetrationDepth(PlaceMeshes(p, q, meshes), p.part->contact_body(),
                           q.part->contact_body(), {}, &*numbers->mesh_depth_cache);
}

void FindTravels(const PlacedPart& p, const PlacedPart& q, PairNumbers* numbers,
                 SceneCounters* counters) {
  const RelativePose pose = PoseOf(p, q);
  for (std::size_t k = 0; k < numbers->travels.size(); ++k) {
    numbers->travels_found[k].reset();
    if (!numbers->travels[k]) continue;
    ++counters->travels;
    const Eigen::Vector3d s = p.pose->rotation.transpose() * numbers->travels[k]->direction;
    const auto result = DirectionalDistance(p.part->convex(), q.part->convex(), pose, s);
    if (!result.ok() || result->kind != TravelKind::kInterval) continue;
    // It begins within [0, reach]; bodies that meet already are at travel zero.
    if (result->leave.travel.value < 0.0) continue;
    if (result->enter.travel.value > numbers->travels[k]->reach) continue;
    numbers->travels_found[k] = *result;
  }
}

}  // namespace touchstone::internal
