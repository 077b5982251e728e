// SPDX-License-Identifier: MIT
#include "touchstone/core/scene/options.h"

#include "touchstone/core/scene/scene.h"

namespace touchstone {

std::string_view ToString(BroadPhase value) {
  switch (value) {
    case BroadPhase::kTree:
      return "tree";
    case BroadPhase::kSweep:
      return "sweep";
    case BroadPhase::kAllPairs:
      return "all_pairs";
  }
  return "?";
}

std::string_view ToString(EventKind value) {
  switch (value) {
    case EventKind::kBegin:
      return "begin";
    case EventKind::kPersist:
      return "persist";
    case EventKind::kEnd:
      return "end";
  }
  return "?";
}

void SceneCounters::Add(const SceneCounters& other) {
  bodies += other.bodies;
  parts += other.parts;
  bodies_moved += other.bodies_moved;
  boxes_made += other.boxes_made;
  pairs_possible += other.pairs_possible;
  pairs += other.pairs;
  pairs_new += other.pairs_new;
  by_rest += other.by_rest;
  by_margin += other.by_margin;
  looked_at += other.looked_at;
  by_box += other.by_box;
  by_balls += other.by_balls;
  by_guess += other.by_guess;
  improved += other.improved;
  queries += other.queries;
  exact_queries += other.exact_queries;
  meshes_apart += other.meshes_apart;
  meshes_placed += other.meshes_placed;
  mesh_nodes += other.mesh_nodes;
  distances += other.distances;
  depths += other.depths;
  continuous_depths += other.continuous_depths;
  travels += other.travels;
  numbers_kept += other.numbers_kept;
}

}  // namespace touchstone
