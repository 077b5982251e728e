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

// Of a distance that was found beyond the margin by so much, or not beyond it (zero).
void Scene::Data::LimitDistance(double beyond, PairNumbers* wanted) const {
  wanted->distance_limit =
      options.rules.margins && beyond > 0.0
          ? (beyond + (TravelOf(wanted->p) + TravelOf(wanted->q))) * (1.0 - 0x1p-49)
          : -kInfinity;
}

void Scene::Data::FindMeshNumbersOf(internal::MeshPairState* meshes, Verdict verdict,
                                    PairNumbers* wanted, SceneCounters* counters) const {
  const internal::PlacedPart p = Placed(wanted->p), q = Placed(wanted->q);
  const MeshPair* placed = nullptr;
  const auto place = [&]() -> const MeshPair& {
    if (placed == nullptr) placed = &internal::PlaceMeshes(p, q, meshes);
    return *placed;
  };
  if (wanted->margin && !KeepsItsDistance(*wanted, counters)) {
    LimitDistance(internal::FindMeshDistance(place(), verdict, meshes, wanted, counters), wanted);
  }
  wanted->found.mesh_depth.reset();
  if (wanted->depth && verdict == Verdict::kOverlap) {
    internal::FindMeshDepth(p, q, options.rules, place(), wanted, counters);
  }
  if (wanted->travels[0] || wanted->travels[1] || wanted->travels[2]) {
    internal::FindMeshTravels(p, place(), verdict, meshes, wanted, counters);
  }
}

void Scene::Data::FindConvexNumbersOf(Verdict verdict, PairNumbers* wanted,
                                      SceneCounters* counters) const {
  const internal::PlacedPart p = Placed(wanted->p), q = Placed(wanted->q);
  if (wanted->margin && !KeepsItsDistance(*wanted, counters)) {
    LimitDistance(internal::FindDistance(p, q, options.rules, wanted, counters), wanted);
  }
  wanted->found.depth.reset();
  if (wanted->depth && verdict == Verdict::kOverlap) {
    internal::FindDepth(p, q, options.rules, wanted, counters);
  }
  internal::FindTravels(p, q, wanted, counters);
}

// Then it is not listed, and was not before.
bool Scene::Data::KeepsItsDistance(const PairNumbers& wanted, SceneCounters* counters) const {
  if (!(travel[wanted.p] + travel[wanted.q] < wanted.distance_limit)) return false;
  ++counters->numbers_kept;
  return true;
}

void Scene::Data::FindNumbersOf(PairNumbers* wanted, SceneCounters* counters) {
  const int p = wanted->p, q = wanted->q;
  if (p < 0) return;
  const bool has_moved = wanted->is_fresh || moved[p] != 0 || moved[q] != 0;
  if (options.rules.rest && !has_moved) {
    ++counters->numbers_kept;
    return;
  }
  wanted->is_fresh = false;
  const internal::PairState& state = pairs.state(pairs.Find(p, q));
  if (wanted->cpd && has_moved) {
    internal::FindContinuousDepth(Placed(p), Placed(q), state.verdict, wanted, counters);
  }
  if (parts[p].part->is_convex() && parts[q].part->is_convex()) {
    FindConvexNumbersOf(state.verdict, wanted, counters);
  } else if (wanted->margin || wanted->depth || wanted->travels[0] || wanted->travels[1] ||
             wanted->travels[2]) {
    FindMeshNumbersOf(&mesh_states[state.mesh], state.verdict, wanted, counters);
  }
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

void Scene::Data::ListNumbersOf(const PairNumbers& numbers_of_pair) {
  const PartData &p = parts[numbers_of_pair.p], &q = parts[numbers_of_pair.q];
  const BodyPair both{HandleOf(static_cast<std::uint32_t>(p.body)),
                      HandleOf(static_cast<std::uint32_t>(q.body))};
  const auto list = [&](const auto& found, auto* numbers_listed) {
    if (found) numbers_listed->push_back({both, p.index, q.index, *found});
  };
  const PairNumbers::Found& found = numbers_of_pair.found;
  list(found.distance, &distances);
  list(found.mesh_distance, &mesh_distances);
  list(found.depth, &depths);
  list(found.mesh_depth, &mesh_depths);
  list(found.continuous_depth, &continuous_depths);
  for (const auto& each : found.travels) list(each, &travels);
  for (const auto& each : found.mesh_travels) list(each, &mesh_travels);
}

void Scene::Data::ListNumbers() {
  distances.clear();
  mesh_distances.clear();
  depths.clear();
  mesh_depths.clear();
  continuous_depths.clear();
  travels.clear();
  mesh_travels.clear();
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
