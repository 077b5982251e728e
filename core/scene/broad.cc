// SPDX-License-Identifier: MIT
//
// From poses to candidate pairs.
#include <algorithm>
#include <cmath>
#include <limits>

#include "touchstone/core/scene/motion_internal.h"
#include "touchstone/core/scene/scene_data_internal.h"

namespace touchstone {

using internal::kNoPart;
using internal::PairNumbers;
using internal::PairState;
using internal::PartData;
using internal::SceneBody;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A fat box is larger than the part's by this part of its radius, and by so many of the last
// step's motions unless that is more than the radius: measured, README.md.
constexpr double kFatOfRadius = 0.05;
constexpr double kFatOfMotion = 8.0;

// How far beyond itself a body looks: where a distance is at most the margin, or a travel begins
// within the reach, boxes that are larger by this meet. The factor covers poses that are rigid up
// to 1e-6 only.
double LookAhead(const Subscriptions& wanted) {
  double ahead = 0.0;
  if (wanted.distance) ahead = *wanted.distance;
  if (wanted.travel) {
    ahead = std::max(ahead, wanted.travel->reach * wanted.travel->direction.stableNorm());
  }
  return (1.0 + 1e-5) * ahead;
}

Box3 Grown(const Box3& box, double by) {
  return {box.low - Eigen::Vector3d::Constant(by), box.high + Eigen::Vector3d::Constant(by)};
}

// How far the inner box is from leaving the outer one, rounded down.
double Clearance(const Box3& inner, const Box3& outer) {
  const double clearance =
      std::min((inner.low - outer.low).minCoeff(), (outer.high - inner.high).minCoeff());
  return (1.0 - 0x1p-46) * clearance;
}

}  // namespace

void Scene::Data::MakeBox(int part) {
  const PartData& data = parts[part];
  const SceneBody& body = bodies[data.body];
  const Box3 tight =
      Grown(internal::PlacedBox(*data.part, body.pose), LookAhead(body.subscriptions));
  const double radius = data.part->outer_radius(), ahead = kFatOfMotion * data.step_motion;
  const double fat = kFatOfRadius * radius + (ahead < radius ? ahead : 0.0);
  // A part that is nearly out of its box gets a new one at once.
  if (box_limit[part] != -kInfinity) {
    const double clearance = Clearance(tight, boxes[part]);
    if (clearance > 0.25 * fat) {
      box_limit[part] = (1.0 - 0x1p-50) * (TravelOf(part) + clearance);
      return;
    }
  }
  boxes[part] = Grown(tight, fat);
  box_limit[part] =
      (1.0 - 0x1p-50) * (TravelOf(part) + std::max(0.0, Clearance(tight, boxes[part])));
  boxed.push_back(part);
}

void Scene::Data::UpdateBoxes(SceneCounters* counters) {
  boxed.clear();
  for (const std::uint32_t slot : moved_slots) {
    const SceneBody& body = bodies[slot];
    if (body.life != SceneBody::Life::kAlive) continue;
    ForParts(body, [&](int part) {
      if (options.rules.broad_phase == BroadPhase::kAllPairs) {
        if (box_limit[part] == -kInfinity) boxed.push_back(part);
        box_limit[part] = kInfinity;
      } else if (!(travel[part] < box_limit[part])) {
        MakeBox(part);
      }
    });
  }
  counters->boxes_made = static_cast<long>(boxed.size());
  if (!boxed.empty()) broad_phase->Update(boxes, boxed);
}

// Parts of removed bodies leave the broad phase, their pairs end.
void Scene::Data::ForgetRemoved() {
  if (removed_slots.empty()) return;
  const auto is_gone = [&](int part) {
    return bodies[parts[part].body].life != SceneBody::Life::kAlive;
  };
  for (int pair = pairs.size() - 1; pair >= 0; --pair) {
    if (is_gone(pairs.p(pair)) || is_gone(pairs.q(pair))) RemovePair(pair);
  }
  for (const std::uint32_t slot : removed_slots) {
    SceneBody& body = bodies[slot];
    const long count = body.shape->part_count();
    pairs_within -= count * (count - 1) / 2;
    part_count -= static_cast<int>(count);
    for (int part = body.first_part; part != kNoPart;) {
      const int next = parts[part].next;
      // A body that came and went between two steps was never announced.
      if (box_limit[part] != -kInfinity) broad_phase->Remove(part);
      parts[part].part = nullptr;
      parts[part].next = free_part;
      free_part = part;
      part = next;
    }
    body.first_part = kNoPart;
    body.shape.reset();
  }
}

int Scene::Data::AddPair(int part_a, int part_b, bool is_pinned) {
  int p = part_a, q = part_b;
  if (parts[p].body == parts[q].body) return -1;
  if (parts[p].body > parts[q].body) std::swap(p, q);
  const int known = pairs.Find(p, q);
  if (known >= 0) {
    pairs.state(known).is_pinned |= is_pinned;
    return known;
  }
  const auto slot_a = static_cast<std::uint32_t>(parts[p].body);
  const auto slot_b = static_cast<std::uint32_t>(parts[q].body);
  if (!MayMeet(slot_a, slot_b)) return -1;
  const Subscriptions* wanted = PairSubscriptions(slot_a, slot_b);
  if (!bodies[slot_a].subscriptions.any() && !bodies[slot_b].subscriptions.any() &&
      wanted == nullptr) {
    return -1;
  }
  const int pair = pairs.Add(p, q);
  pairs.state(pair).is_pinned = is_pinned;
  Wire(pair);
  return pair;
}

// Brings what a pair is wanted for up to date with subscriptions.
void Scene::Data::Wire(int pair) {
  PairState& state = pairs.state(pair);
  const PartData &p = parts[pairs.p(pair)], &q = parts[pairs.q(pair)];
  const SceneBody &a = bodies[p.body], &b = bodies[q.body];
  const Subscriptions* own =
      PairSubscriptions(static_cast<std::uint32_t>(p.body), static_cast<std::uint32_t>(q.body));
  PairNumbers wanted;
  for (const Subscriptions* each : {&a.subscriptions, &b.subscriptions, own}) {
    if (each == nullptr) continue;
    if (each->distance) wanted.margin = std::max(wanted.margin.value_or(0.0), *each->distance);
    wanted.depth |= each->depth;
    wanted.cpd |= each->cpd;
  }
  const auto travel_of = [](const Subscriptions& each, double sense) {
    return PairNumbers::Travel{sense * each.travel->direction, each.travel->reach};
  };
  if (a.subscriptions.travel) wanted.travels[0] = travel_of(a.subscriptions, -1.0);
  if (b.subscriptions.travel) wanted.travels[1] = travel_of(b.subscriptions, 1.0);
  if (own != nullptr && own->travel) wanted.travels[2] = travel_of(*own, 1.0);
  state.is_told = WantsVerdict(a, b, own);
  state.wants_verdict = state.is_told || wanted.depth || wanted.cpd ||
                        (wanted.any() && !(p.part->is_convex() && q.part->is_convex()));
  const bool is_new = state.numbers < 0;
  if (wanted.any() && is_new) state.numbers = numbers.Take();
  if (!wanted.any()) ReturnNumbers(&state);
  if (state.numbers >= 0) {
    PairNumbers& kept = numbers[state.numbers];
    kept.p = pairs.p(pair);
    kept.q = pairs.q(pair);
    kept.margin = wanted.margin;
    kept.depth = wanted.depth;
    kept.cpd = wanted.cpd;
    kept.travels = wanted.travels;
    kept.is_fresh = true;
    kept.distance_limit = -kInfinity;
    // A continuous depth goes on where the pair goes on.
    PairNumbers::Found found;
    if (wanted.cpd && !is_new) found.continuous_depth.swap(kept.found.continuous_depth);
    kept.found = std::move(found);
  }
  pairs.limit(pair) = -kInfinity;
}

void Scene::Data::RemovePair(int pair) {
  PairState& state = pairs.state(pair);
  if (state.in_contact) contacts.Change(ContactOf(pair, Verdict::kSeparate));
  if (state.mesh >= 0) mesh_states.Return(state.mesh);
  ReturnNumbers(&state);
  pairs.RemoveAt(pair);
}

void Scene::Data::ReturnNumbers(PairState* state) {
  if (state->numbers < 0) return;
  PairNumbers& kept = numbers[state->numbers];
  kept.p = kept.q = -1;
  kept.continuous_depth.reset();
  numbers.Return(state->numbers);
  state->numbers = -1;
}

void Scene::Data::Rewire() {
  must_rewire = false;
  for (int pair = pairs.size() - 1; pair >= 0; --pair) {
    const int p = parts[pairs.p(pair)].body, q = parts[pairs.q(pair)].body;
    if (!bodies[p].moved && !bodies[q].moved) continue;
    const auto slot_a = static_cast<std::uint32_t>(p), slot_b = static_cast<std::uint32_t>(q);
    const Subscriptions* own = PairSubscriptions(slot_a, slot_b);
    const bool wanted =
        bodies[p].subscriptions.any() || bodies[q].subscriptions.any() || own != nullptr;
    if (!wanted || !MayMeet(slot_a, slot_b)) {
      RemovePair(pair);
      continue;
    }
    pairs.state(pair).is_pinned = false;
    Wire(pair);
  }
  // A distance or a travel of a pair is looked for however far its bodies are from each other.
  pinned.clear();
  for (const auto& [slots, wanted] : pair_subscriptions) {
    if (!wanted.distance && !wanted.travel) continue;
    const internal::SceneBody& second = bodies[slots.second];
    ForParts(bodies[slots.first],
             [&](int p) { ForParts(second, [&](int q) { pinned.emplace_back(p, q); }); });
  }
}

void Scene::Data::AddPairs(SceneCounters* counters) {
  first_new_pair = pairs.size();
  near.clear();
  if (!boxed.empty()) broad_phase->FindPairs(boxes, boxed, &near);
  for (const auto& [a, b] : near) AddPair(a, b, false);
  for (const auto& [a, b] : pinned) AddPair(a, b, true);
  pinned.clear();
  counters->pairs_new = pairs.size() - first_new_pair;
}

}  // namespace touchstone
