// SPDX-License-Identifier: MIT
#include "touchstone/core/scene/mesh_pair_internal.h"

#include <algorithm>
#include <cassert>

#include "touchstone/core/scene/mesh_margin_internal.h"

namespace touchstone::internal {
namespace {

// A margin in the frame of one body, where points move by up to 1 + 3e-6 times as much as in the
// world, as one of the world.
constexpr double kToWorld = 1.0 - 1e-5;

void PlaceAt(const PlacedPart& p, const PlacedPart& q, const RelativePose& pose,
             MeshPairState* state) {
  if (state->pair) {
    state->pair->Place(pose);
  } else {
    state->pair.emplace(p.part->mesh(), q.part->mesh(), pose);
  }
}

MembershipResult AskMembership(const PlacedPart& p, const PlacedPart& q, const RelativePose& pose,
                               bool warm, MeshPairState* state, SceneCounters* counters) {
  ++counters->queries;
  ++counters->meshes_placed;
  PlaceAt(p, q, pose, state);
  if (!warm) state->cache.crossing = {};
  const MembershipResult result =
      Membership(*state->pair, Eigen::Vector3d(Eigen::Vector3d::Zero()), {}, &state->cache);
  if (result.tier == Tier::kExact) ++counters->exact_queries;
  return result;
}

}  // namespace

const MeshPair& PlaceMeshes(const PlacedPart& p, const PlacedPart& q, MeshPairState* state) {
  const auto pose = RelativePose::FromWorld(*p.pose, *q.pose);
  assert(pose.ok());  // kMaxWorldTranslation
  PlaceAt(p, q, *pose, state);
  return *state->pair;
}

std::size_t MeshPairState::bytes() const {
  std::size_t total = sizeof *this + stack.capacity() * sizeof stack[0] +
                      distance_cache.queue.capacity() * sizeof distance_cache.queue[0] +
                      travel_cache.queue.capacity() * sizeof travel_cache.queue[0] +
                      travel_cache.candidates.capacity() * sizeof travel_cache.candidates[0];
  if (!pair) return total;
  for (const PlacedMesh* mesh : {&pair->a(), &pair->b()}) {
    total += mesh->points.capacity() * sizeof mesh->points[0] +
             mesh->planes.capacity() * sizeof mesh->planes[0] + mesh->tree.nodes().size_bytes();
  }
  return total;
}

Margin DecideMesh(const PlacedPart& p, const PlacedPart& q, const SceneRules& rules, double enough,
                  MeshPairState* state, SceneCounters* counters) {
  if (rules.balls) {
    const Margin margin = MarginByBalls(p, q);
    if (margin.verdict != Verdict::kUndecided) {
      ++counters->by_balls;
      return margin;
    }
  }
  const auto pose = RelativePose::FromWorld(*p.pose, *q.pose);
  assert(pose.ok());  // kMaxWorldTranslation
  const MeshMargin surfaces(*p.part, *q.part, *pose);
  if (rules.guesses) {
    const double margin =
        kToWorld * surfaces.Crossing(state->crossing.first, state->crossing.second);
    if (margin > 0.0) {
      ++counters->by_guess;
      return {Verdict::kOverlap, margin};
    }
  }
  double apart = 0.0;
  if (rules.lazy_meshes) {
    apart = kToWorld * surfaces.SurfacesApart(enough, &state->stack, &counters->mesh_nodes);
    if (apart > 0.0 && surfaces.NoneInside()) {
      ++counters->meshes_apart;
      return {Verdict::kSeparate, apart};
    }
  }
  const MembershipResult result = AskMembership(p, q, *pose, rules.guesses, state, counters);
  Margin margin{result.verdict, 0.0};
  // Surfaces apart stay apart, and what lies inside stays inside.
  if (apart > 0.0) margin.value = apart;
  state->crossing = {-1, -1};
  if (result.verdict == Verdict::kOverlap && result.face_a >= 0) {
    state->crossing = {result.face_a, result.face_b};
    margin.value = std::max(0.0, kToWorld * surfaces.Crossing(result.face_a, result.face_b));
  }
  return margin;
}

}  // namespace touchstone::internal
