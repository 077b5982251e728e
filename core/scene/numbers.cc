// SPDX-License-Identifier: MIT
//
// Distances, depths and travels of the pairs that are subscribed to them.
#include <algorithm>
#include <functional>
#include <limits>
#include <mutex>
#include <tuple>

#include "touchstone/core/base/parallel.h"
#include "touchstone/core/scene/scene_data_internal.h"

namespace touchstone {

using internal::PairNumbers;
using internal::PartData;

namespace {

constexpr std::size_t kGrain = 8;  // pairs that are worth a task
constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

void Scene::Data::FindNumbersOf(PairNumbers* wanted, SceneCounters* counters) {
  const int p = wanted->p, q = wanted->q;
  if (p < 0) return;
  const SceneRules& rules = options.rules;
  if (rules.rest && !wanted->is_fresh && moved[p] == 0 && moved[q] == 0) {
    ++counters->numbers_kept;
    return;
  }
  wanted->is_fresh = false;
  const internal::PlacedPart placed_p = Placed(p), placed_q = Placed(q);
  wanted->mesh_depth_found.reset();
  if (!placed_p.part->is_convex() || !placed_q.part->is_convex()) {
    const internal::PairState& state = pairs.state(pairs.Find(p, q));
    if (wanted->depth && state.verdict == Verdict::kOverlap) {
      internal::FindMeshDepth(placed_p, placed_q, rules, &mesh_states[state.mesh], wanted,
                              counters);
    }
    return;
  }
  if (wanted->margin) {
    if (travel[p] + travel[q] < wanted->distance_limit) {
      ++counters->numbers_kept;
      wanted->distance_found.reset();
    } else {
      const double beyond = FindDistance(placed_p, placed_q, rules, wanted, counters);
      wanted->distance_limit = rules.margins && beyond > 0.0
                                   ? (beyond + (TravelOf(p) + TravelOf(q))) * (1.0 - 0x1p-49)
                                   : -kInfinity;
    }
  }
  wanted->depth_found.reset();
  const int pair = pairs.Find(p, q);
  if (wanted->depth && pairs.state(pair).verdict == Verdict::kOverlap) {
    internal::FindDepth(placed_p, placed_q, rules, wanted, counters);
  }
  internal::FindTravels(placed_p, placed_q, wanted, counters);
}

void Scene::Data::FindNumbers(SceneCounters* counters) {
  std::mutex mutex;
  const auto find = [&](std::size_t begin, std::size_t end) {
    SceneCounters local;
    for (std::size_t i = begin; i < end; ++i) {
      FindNumbersOf(&numbers[static_cast<int>(i)], &local);
    }
    const std::lock_guard lock(mutex);
    counters->Add(local);
  };
  ForRanges(numbers.size(), kGrain, options.threads, std::ref(find));
}

void Scene::Data::ListNumbersOf(const PairNumbers& found) {
  const PartData &p = parts[found.p], &q = parts[found.q];
  const BodyPair both{HandleOf(static_cast<std::uint32_t>(p.body)),
                      HandleOf(static_cast<std::uint32_t>(q.body))};
  // Of meshes depth alone; said where the bodies meet, which every scene finds alike.
  const bool is_convex = p.part->is_convex() && q.part->is_convex();
  const bool meets =
      !is_convex && pairs.state(pairs.Find(found.p, found.q)).verdict != Verdict::kSeparate;
  const NumberStatus status = is_convex ? NumberStatus::kFound : NumberStatus::kNeedsConvex;
  if (found.distance_found || (meets && found.margin)) {
    distances.push_back(
        {both, p.index, q.index, status, found.distance_found.value_or(DistanceResult{})});
  }
  if (found.depth_found) {
    depths.push_back({both, p.index, q.index, status, *found.depth_found});
  }
  if (found.mesh_depth_found) {
    mesh_depths.push_back({both, p.index, q.index, NumberStatus::kFound, *found.mesh_depth_found});
  }
  for (std::size_t k = 0; k < found.travels.size(); ++k) {
    if (found.travels_found[k] || (meets && found.travels[k])) {
      travels.push_back(
          {both, p.index, q.index, status, found.travels_found[k].value_or(DirectionalResult{})});
    }
  }
}

void Scene::Data::ListNumbers() {
  distances.clear();
  depths.clear();
  mesh_depths.clear();
  travels.clear();
  listed.clear();
  for (int i = 0; i < numbers.size(); ++i) {
    if (numbers[i].p >= 0) listed.push_back(i);
  }
  std::sort(listed.begin(), listed.end(), [&](int i, int j) {
    const auto key = [&](int k) {
      const PartData &p = parts[numbers[k].p], &q = parts[numbers[k].q];
      return std::tuple(p.body, q.body, p.index, q.index);
    };
    return key(i) < key(j);
  });
  for (const int i : listed) ListNumbersOf(numbers[i]);
}

}  // namespace touchstone
