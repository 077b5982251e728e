// SPDX-License-Identifier: MIT
//
// Which pairs must be looked at, and what they do.
#include <algorithm>
#include <atomic>
#include <cassert>
#include <functional>
#include <limits>
#include <mutex>

#include "touchstone/core/base/parallel.h"
#include "touchstone/core/proximity/penetration_depth.h"
#include "touchstone/core/scene/scene_data_internal.h"

namespace touchstone {

using internal::Margin;
using internal::PairState;
using internal::PartData;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

constexpr std::size_t kScanGrain = 4096;  // pairs that are worth a task
constexpr std::size_t kLookGrain = 32;

// A margin is worth effort up to so many of the last step's motions: measured, README.md.
constexpr double kEnoughMotions = 16.0;
constexpr double kFastOfRadii = 0.25;
// Of a mesh pair up to this part of the smaller ball, since finding it opens boxes only.
constexpr double kEnoughOfRadius = 0.25;

}  // namespace

// T, the sum of the travels, is off by one rounding of 2^-52, and so was it when the margin s was
// proven at T0: limit = (s + T0)(1 - 2^-49) is below s + T0 by more than these and its own
// roundings. So T < limit implies that the points have moved by less than s.
inline bool Scene::Data::IsDue(int pair) const {
  const int p = pairs.p(pair), q = pairs.q(pair);
  return !(travel[p] + travel[q] < pairs.limit(pair));
}

void Scene::Data::FindActive(SceneCounters* counters) {
  const SceneRules& rules = options.rules;
  const std::size_t count = pairs.size();
  active.resize(count);
  active_counts.assign((count + kScanGrain - 1) / kScanGrain, 0);
  std::atomic<long> by_rest = 0, by_margin = 0;
  // Each chunk of pairs lists its own at its own place, so that the list does not depend on
  // threads.
  const auto scan = [&](std::size_t begin, std::size_t end) {
    for (std::size_t chunk = begin; chunk < end; ++chunk) {
      const std::size_t from = chunk * kScanGrain, to = std::min(count, from + kScanGrain);
      std::size_t at = from;
      long resting = 0, sure = 0;
      for (std::size_t i = from; i < to; ++i) {
        const int pair = static_cast<int>(i);
        const bool is_new = pair >= first_new_pair;
        if (!is_new && rules.rest && moved[pairs.p(pair)] == 0 && moved[pairs.q(pair)] == 0) {
          ++resting;
        } else if (!IsDue(pair)) {
          ++sure;
        } else {
          active[at++] = pair;
        }
      }
      active_counts[chunk] = static_cast<int>(at - from);
      by_rest += resting;
      by_margin += sure;
    }
  };
  // By reference: a copy of what it captures would be allocated.
  ForRanges(active_counts.size(), 1, options.threads, std::ref(scan));
  std::size_t at = 0;
  for (std::size_t chunk = 0; chunk < active_counts.size(); ++chunk) {
    const auto from = active.begin() + static_cast<std::ptrdiff_t>(chunk * kScanGrain);
    std::copy(from, from + active_counts[chunk], active.begin() + static_cast<std::ptrdiff_t>(at));
    at += active_counts[chunk];
  }
  active.resize(at);
  counters->by_rest += by_rest;
  counters->by_margin += by_margin;
}

// Memory for pairs with a mesh, made before threads share the work.
void Scene::Data::MakeMeshStates() {
  if (!has_meshes) return;
  for (const int pair : active) {
    PairState& state = pairs.state(pair);
    if (state.mesh >= 0 || !state.wants_verdict) continue;
    if (parts[pairs.p(pair)].part->is_convex() && parts[pairs.q(pair)].part->is_convex()) continue;
    state.mesh = mesh_states.Take();
    internal::MeshPairState& mesh = mesh_states[state.mesh];
    mesh.pair.reset();
    mesh.crossing = {-1, -1};
  }
}

// Asks for the memory of looks to come: what pairs and parts hold first, then what these name.
void Scene::Data::Fetch(std::size_t k, std::size_t end) const {
  constexpr std::size_t kFar = 12, kNear = 6;
  const auto fetch = [](const void* from, std::size_t bytes) {
    for (std::size_t i = 0; i < bytes; i += 64) {
      __builtin_prefetch(static_cast<const char*>(from) + i);
    }
  };
  if (k + kFar < end) {
    const int pair = active[k + kFar];
    fetch(&pairs.state(pair), sizeof(PairState));
    fetch(&parts[pairs.p(pair)], sizeof(PartData));
    fetch(&parts[pairs.q(pair)], sizeof(PartData));
  }
  if (k + kNear < end) {
    const int pair = active[k + kNear];
    fetch(&bodies[parts[pairs.p(pair)].body].pose, sizeof(WorldPose));
    fetch(&bodies[parts[pairs.q(pair)].body].pose, sizeof(WorldPose));
  }
}

void Scene::Data::LookAt(int k, SceneCounters* counters) {
  const int pair = active[k], p = pairs.p(pair), q = pairs.q(pair);
  PairState& state = pairs.state(pair);
  must_drop[k] = 0;
  const SceneRules& rules = options.rules;
  if (rules.broad_phase != BroadPhase::kAllPairs && !state.is_pinned &&
      !internal::Meet(boxes[p], boxes[q])) {
    ++counters->by_box;
    state.verdict = Verdict::kSeparate;
    must_drop[k] = 1;
    return;
  }
  if (!state.wants_verdict) {
    state.verdict = Verdict::kSeparate;
    return;
  }
  const internal::PlacedPart placed_p = Placed(p), placed_q = Placed(q);
  const double motion = parts[p].step_motion + parts[q].step_motion;
  const double radius_p = placed_p.part->outer_radius(), radius_q = placed_q.part->outer_radius();
  // No margin lasts where parts move by their own size.
  const double enough =
      motion < kFastOfRadii * (radius_p + radius_q) ? kEnoughMotions * motion : 0.0;
  Margin margin;
  if (state.mesh >= 0) {
    const double worth = std::max(enough, kEnoughOfRadius * std::min(radius_p, radius_q));
    margin =
        internal::DecideMesh(placed_p, placed_q, rules, worth, &mesh_states[state.mesh], counters);
  } else {
    margin = internal::DecideConvex(placed_p, placed_q, rules, enough, &state, counters);
    if (!rules.verdict_alone && margin.verdict == Verdict::kOverlap) {
      ++counters->depths;
      const auto pose = RelativePose::FromWorld(*placed_p.pose, *placed_q.pose);
      PenetrationDepth(placed_p.part->convex(), placed_q.part->convex(), *pose);
    }
  }
  assert(margin.verdict != Verdict::kUndecided);
  state.verdict = margin.verdict;
  const double sum = TravelOf(p) + TravelOf(q);
  pairs.limit(pair) =
      rules.margins && margin.value > 0.0 ? (margin.value + sum) * (1.0 - 0x1p-49) : -kInfinity;
}

// In order of the pairs, whoever looked at them.
void Scene::Data::TellChanges() {
  for (const int pair : active) {
    PairState& state = pairs.state(pair);
    const bool meets = state.is_told && state.verdict != Verdict::kSeparate;
    if (!meets && !state.in_contact) continue;
    if (meets && state.in_contact && state.verdict == state.told) continue;
    state.in_contact = meets;
    state.told = state.verdict;
    contacts.Change(ContactOf(pair, meets ? state.verdict : Verdict::kSeparate));
  }
}

void Scene::Data::Look(SceneCounters* counters) {
  FindActive(counters);
  MakeMeshStates();
  counters->looked_at += static_cast<long>(active.size());
  must_drop.resize(active.size());
  std::mutex mutex;
  const auto look = [&](std::size_t begin, std::size_t end) {
    SceneCounters local;
    for (std::size_t k = begin; k < end; ++k) {
      Fetch(k, end);
      LookAt(static_cast<int>(k), &local);
    }
    const std::lock_guard lock(mutex);
    counters->Add(local);
  };
  ForRanges(active.size(), kLookGrain, options.threads, std::ref(look));
  TellChanges();
  // The last first: removing a pair moves only pairs behind it.
  for (int k = static_cast<int>(active.size()) - 1; k >= 0; --k) {
    if (must_drop[k] != 0) RemovePair(active[k]);
  }
  first_new_pair = pairs.size();
}

}  // namespace touchstone
