// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_SCENE_OPTIONS_H_
#define TOUCHSTONE_CORE_SCENE_OPTIONS_H_

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string_view>

#include "touchstone/core/base/parallel.h"

namespace touchstone {

// How pairs are found that may meet.
enum class BroadPhase {
  kTree,      // a bounding volume tree of fat boxes
  kSweep,     // the same boxes sorted along an axis
  kAllPairs,  // none: every pair is a candidate
};
std::string_view ToString(BroadPhase);

// What a scene may skip. No rule changes an answer; README.md proves each.
struct SceneRules {
  BroadPhase broad_phase = BroadPhase::kTree;
  // A pair proven to be apart, or deep in each other, by more than its bodies have moved since.
  bool margins = true;
  // Pairs of which neither body has moved, and steps in which none has.
  bool rest = true;
  // Balls around and inside the bodies before anything else.
  bool balls = true;
  // The direction or the simplex that proved the last verdict.
  bool guesses = true;
  // Meshes: only nodes of their trees that come near each other are opened, in their own frames,
  // before a pair is placed whole.
  bool lazy_meshes = true;
  // Depth of pairs that only verdicts were asked for is not computed. (Off: it is, and dropped.)
  bool verdict_alone = true;
  // Doubles with bounds first, big numbers for what these leave open. (Off: verdicts of convex
  // parts are decided by exact signs from the start.)
  bool doubles_first = true;

  static SceneRules None() {
    return {BroadPhase::kAllPairs, false, false, false, false, false, false, false};
  }
};

struct SceneOptions {
  SceneRules rules;
  Threads threads = Threads::kOne;
};

// What a caller wants to know. Of a pair: what either of its bodies or the pair itself is
// subscribed to, with the larger margin.
struct Subscriptions {
  // A travel along a direction of the world.
  struct Travel {
    Eigen::Vector3d direction = Eigen::Vector3d::UnitX();
    double reach = 1.0;  // reported where it begins within [0, reach], a multiple of `direction`
  };

  bool verdict = true;             // begin, persist and end of contact
  std::optional<double> distance;  // where it is at most this margin
  bool depth = false;              // where the bodies overlap
  bool cpd = false;                // where they overlap: continuous penetration depth
  std::optional<Travel> travel;  // of the subscribed body (of a pair: of the second) until contact

  bool any() const { return verdict || distance || depth || cpd || travel; }
};

// Which bodies take part: two bodies meet only if each one's group has a bit in the other's mask.
struct Filter {
  std::uint32_t group = 1;
  std::uint32_t mask = ~std::uint32_t{0};
};

// The work of one step, and what the rules saved of it. Pairs are pairs of parts.
struct SceneCounters {
  long bodies = 0, parts = 0;
  long bodies_moved = 0;
  long boxes_made = 0;      // fat boxes that a part had left
  long pairs_possible = 0;  // all pairs of parts of different bodies
  long pairs = 0;           // kept: their fat boxes met when last looked at
  long pairs_new = 0;
  long by_rest = 0;    // not looked at: neither body moved
  long by_margin = 0;  // not looked at: proven to keep their verdict
  long looked_at = 0;
  long by_box = 0;         // decided: fat boxes are apart
  long by_balls = 0;       // decided: balls are apart, or in each other
  long by_guess = 0;       // decided: the last direction or simplex still proves it
  long improved = 0;       // asked of Distance for the sake of a longer margin
  long queries = 0;        // asked of Collide or Membership
  long exact_queries = 0;  // of them those that big numbers had to finish
  long meshes_apart = 0;   // decided: by the trees, no mesh placed
  long meshes_placed = 0;
  long mesh_nodes = 0;  // pairs of boxes of the trees that were compared
  long distances = 0, depths = 0, continuous_depths = 0, travels = 0;  // numbers computed
  long numbers_kept = 0;  // not computed: neither body moved, or further apart than the margin

  void Add(const SceneCounters& other);
};

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_SCENE_OPTIONS_H_
