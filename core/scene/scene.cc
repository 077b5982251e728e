// SPDX-License-Identifier: MIT
#include "touchstone/core/scene/scene.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>

#include "touchstone/core/scene/motion_internal.h"
#include "touchstone/core/scene/scene_data_internal.h"

namespace touchstone {

using internal::kNoPart;
using internal::PartData;
using internal::SceneBody;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Status UnknownBody(BodyHandle body) {
  return {StatusCode::kBadIndex, ElementKind::kNone, static_cast<int>(body.slot), -1,
          "the scene has no body " + std::to_string(body.slot) + " of generation " +
              std::to_string(body.generation)};
}

bool IsLength(double value) { return std::isfinite(value) && value >= 0.0 && value <= 1e100; }

Status CheckSubscriptions(const Subscriptions& wanted) {
  const auto fail = [](const char* what) {
    return Status{StatusCode::kOutOfRange, ElementKind::kNone, -1, -1, what};
  };
  if (wanted.distance && !IsLength(*wanted.distance)) {
    return fail("the margin of a distance is not within [0, 1e100]");
  }
  if (wanted.travel) {
    if (!IsLength(wanted.travel->reach))
      return fail("the reach of a travel is not within [0, 1e100]");
    const double length = wanted.travel->direction.stableNorm();
    if (!(length >= 1e-100 && length <= 1e100)) {
      return fail("the direction of a travel is not of a length within [1e-100, 1e100]");
    }
  }
  return {};
}

}  // namespace

Scene::Data::Data(const SceneOptions& chosen)
    : options(chosen), broad_phase(internal::MakeBroadPhase(chosen.rules.broad_phase)) {}

SceneBody* Scene::Data::Find(BodyHandle handle) {
  if (handle.slot >= bodies.size()) return nullptr;
  SceneBody& body = bodies[handle.slot];
  return body.life == SceneBody::Life::kAlive && body.generation == handle.generation ? &body
                                                                                      : nullptr;
}

void Scene::Data::MarkMoved(std::uint32_t slot) {
  if (bodies[slot].moved) return;
  bodies[slot].moved = true;
  moved_slots.push_back(slot);
}

void Scene::Data::LookAgain(const SceneBody& body) {
  ForParts(body, [&](int part) {
    box_limit[part] = -kInfinity;
    moved[part] = 1;
  });
}

const Subscriptions* Scene::Data::PairSubscriptions(std::uint32_t slot_a,
                                                    std::uint32_t slot_b) const {
  if (!bodies[slot_a].has_pairs || !bodies[slot_b].has_pairs) return nullptr;
  const auto found = pair_subscriptions.find({slot_a, slot_b});
  return found == pair_subscriptions.end() ? nullptr : &found->second;
}

bool Scene::Data::MayMeet(std::uint32_t slot_a, std::uint32_t slot_b) const {
  const SceneBody &a = bodies[slot_a], &b = bodies[slot_b];
  if ((a.filter.group & b.filter.mask) == 0 || (b.filter.group & a.filter.mask) == 0) return false;
  if (!a.has_pairs || !b.has_pairs) return true;
  return !ignored.contains({slot_a, slot_b});
}

bool Scene::Data::WantsVerdict(const SceneBody& a, const SceneBody& b,
                               const Subscriptions* pair) const {
  return a.subscriptions.verdict || b.subscriptions.verdict || (pair != nullptr && pair->verdict);
}

double Scene::Data::TravelOf(int part) const {
  return travel[part] == kInfinity ? 0.0 : travel[part];
}

internal::Contact Scene::Data::ContactOf(int pair, Verdict verdict) const {
  const PartData &p = parts[pairs.p(pair)], &q = parts[pairs.q(pair)];
  return {static_cast<std::uint32_t>(p.body), static_cast<std::uint32_t>(q.body), p.index, q.index,
          verdict};
}

int Scene::Data::TakePart() {
  if (free_part != kNoPart) return std::exchange(free_part, parts[free_part].next);
  parts.emplace_back();
  travel.push_back(0.0);
  box_limit.push_back(0.0);
  moved.push_back(0);
  boxes.push_back({Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()});
  return static_cast<int>(parts.size()) - 1;
}

// Bodies count as unmoved again, and removed ones' slots as free, now that their ends were told.
void Scene::Data::Settle() {
  for (const std::uint32_t slot : moved_slots) {
    SceneBody& body = bodies[slot];
    body.moved = false;
    ForParts(body, [&](int part) {
      moved[part] = 0;
      parts[part].step_motion = 0.0;
      if (travel[part] == kInfinity) travel[part] = 0.0;
    });
  }
  moved_slots.clear();
  if (removed_slots.empty()) return;
  for (const std::uint32_t slot : removed_slots) {
    SceneBody& body = bodies[slot];
    ++body.generation;
    body.life = SceneBody::Life::kFree;
    free_slots.push_back(slot);
  }
  removed_slots.clear();
  std::sort(free_slots.begin(), free_slots.end(), std::greater<>());
}

Scene::Scene(const SceneOptions& options) : data_(std::make_unique<Data>(options)) {}
Scene::~Scene() = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;

StatusOr<BodyHandle> Scene::Add(const SceneShape& shape, const WorldPose& pose,
                                const Subscriptions& subscriptions, const Filter& filter) {
  if (Status status = internal::CheckWorldPose(pose); !status.ok()) return status;
  if (Status status = CheckSubscriptions(subscriptions); !status.ok()) return status;
  Data& d = *data_;
  std::uint32_t slot;
  if (d.free_slots.empty()) {
    slot = static_cast<std::uint32_t>(d.bodies.size());
    d.bodies.emplace_back();
  } else {
    slot = d.free_slots.back();
    d.free_slots.pop_back();
  }
  SceneBody& body = d.bodies[slot];
  body.life = SceneBody::Life::kAlive;
  body.has_pairs = false;
  body.pose = pose;
  body.filter = filter;
  body.subscriptions = subscriptions;
  body.shape = shape;
  for (int index = shape.part_count() - 1; index >= 0; --index) {
    const int part = d.TakePart();
    const ScenePart& source = shape.part(index);
    d.has_meshes |= !source.is_convex();
    d.parts[part] = {
        &source, pose.rotation * source.middle(), static_cast<int>(slot), index, body.first_part,
        0.0};
    body.first_part = part;
    d.travel[part] = 0.0;
    d.box_limit[part] = -kInfinity;
    d.moved[part] = 1;
  }
  d.part_count += shape.part_count();
  d.pairs_within += static_cast<long>(shape.part_count()) * (shape.part_count() - 1) / 2;
  ++d.alive_count;
  d.MarkMoved(slot);
  return d.HandleOf(slot);
}

Status Scene::Remove(BodyHandle handle) {
  Data& d = *data_;
  SceneBody* body = d.Find(handle);
  if (body == nullptr) return UnknownBody(handle);
  body->life = SceneBody::Life::kRemoved;
  d.removed_slots.push_back(handle.slot);
  --d.alive_count;
  if (body->has_pairs) {
    const auto names = [&](const Data::Slots& slots) {
      return slots.first == handle.slot || slots.second == handle.slot;
    };
    std::erase_if(d.pair_subscriptions, [&](const auto& entry) { return names(entry.first); });
    std::erase_if(d.ignored, names);
  }
  return {};
}

Status Scene::Move(BodyHandle handle, const WorldPose& pose) {
  Data& d = *data_;
  SceneBody* body = d.Find(handle);
  if (body == nullptr) return UnknownBody(handle);
  if (Status status = internal::CheckWorldPose(pose); !status.ok()) return status;
  bool moves = false;
  d.ForParts(*body, [&](int part) {
    PartData& data = d.parts[part];
    const double motion =
        internal::MotionBound(body->pose, pose, data.part->middle(), data.part->outer_radius());
    if (motion == 0.0) return;
    moves = true;
    data.step_motion += motion;
    data.turned_middle = pose.rotation * data.part->middle();
    d.moved[part] = 1;
    // Rounded up. Where the sum has grown so large that it blurs margins, it starts afresh.
    const double sum = (d.travel[part] + motion) * (1.0 + 0x1p-51);
    d.travel[part] = sum < 0x1p24 * data.part->outer_radius() ? sum : kInfinity;
  });
  body->pose = pose;
  if (moves) d.MarkMoved(handle.slot);
  return {};
}

Status Scene::Subscribe(BodyHandle handle, const Subscriptions& subscriptions) {
  Data& d = *data_;
  SceneBody* body = d.Find(handle);
  if (body == nullptr) return UnknownBody(handle);
  if (Status status = CheckSubscriptions(subscriptions); !status.ok()) return status;
  body->subscriptions = subscriptions;
  d.MarkMoved(handle.slot);
  d.LookAgain(*body);
  d.must_rewire = true;
  return {};
}

Status Scene::SubscribePair(BodyHandle a, BodyHandle b, const Subscriptions& subscriptions) {
  Data& d = *data_;
  for (const BodyHandle& handle : {a, b}) {
    if (d.Find(handle) == nullptr) return UnknownBody(handle);
  }
  if (a.slot == b.slot) return UnknownBody(b);
  if (Status status = CheckSubscriptions(subscriptions); !status.ok()) return status;
  // Kept for the slots in order; the second body of the call is the one that travels.
  const Data::Slots slots = std::minmax(a.slot, b.slot);
  if (subscriptions.any()) {
    Subscriptions& kept = d.pair_subscriptions[slots];
    kept = subscriptions;
    if (a.slot > b.slot && kept.travel) kept.travel->direction *= -1.0;
  } else {
    d.pair_subscriptions.erase(slots);
  }
  for (const BodyHandle& handle : {a, b}) {
    SceneBody& body = d.bodies[handle.slot];
    body.has_pairs = true;
    d.MarkMoved(handle.slot);
    d.LookAgain(body);
  }
  d.must_rewire = true;
  return {};
}

Status Scene::SetFilter(BodyHandle handle, const Filter& filter) {
  Data& d = *data_;
  SceneBody* body = d.Find(handle);
  if (body == nullptr) return UnknownBody(handle);
  body->filter = filter;
  d.MarkMoved(handle.slot);
  d.LookAgain(*body);
  d.must_rewire = true;
  return {};
}

Status Scene::SetIgnored(BodyHandle a, BodyHandle b, bool ignored) {
  Data& d = *data_;
  for (const BodyHandle& handle : {a, b}) {
    if (d.Find(handle) == nullptr) return UnknownBody(handle);
  }
  if (a.slot == b.slot) return UnknownBody(b);
  const Data::Slots slots = std::minmax(a.slot, b.slot);
  if (ignored) {
    d.ignored.insert(slots);
  } else {
    d.ignored.erase(slots);
  }
  for (const std::uint32_t slot : {slots.first, slots.second}) {
    d.bodies[slot].has_pairs = true;
    d.MarkMoved(slot);
    d.LookAgain(d.bodies[slot]);
  }
  d.must_rewire = true;
  return {};
}

SceneStep Scene::Step() {
  Data& d = *data_;
  SceneCounters counters;
  counters.bodies_moved = static_cast<long>(d.moved_slots.size());
  const bool nothing_moved = d.moved_slots.empty() && d.removed_slots.empty();
  if (!nothing_moved) {
    d.ForgetRemoved();
    if (d.must_rewire) d.Rewire();
    d.UpdateBoxes(&counters);
    d.AddPairs(&counters);
  }
  if (!nothing_moved || !d.options.rules.rest) {
    d.Look(&counters);
    d.FindNumbers(&counters);
  } else {
    counters.by_rest = d.pairs.size();
    counters.numbers_kept = static_cast<long>(d.listed.size());
  }
  d.contacts.Step([&](std::uint32_t slot) { return d.HandleOf(slot); });
  if (!nothing_moved) {
    d.ListNumbers();
    d.Settle();
  }
  counters.bodies = d.alive_count;
  counters.parts = d.part_count;
  counters.pairs_possible =
      static_cast<long>(d.part_count) * (d.part_count - 1) / 2 - d.pairs_within;
  counters.pairs = d.pairs.size();
  return {d.contacts.events(), d.distances, d.mesh_distances, d.depths, d.mesh_depths,
          d.continuous_depths, d.travels,   d.mesh_travels,   counters};
}

bool Scene::Has(BodyHandle body) const { return data_->Find(body) != nullptr; }

int Scene::body_count() const { return data_->alive_count; }

const WorldPose& Scene::pose(BodyHandle body) const { return data_->bodies[body.slot].pose; }

const SceneShape& Scene::shape(BodyHandle body) const { return *data_->bodies[body.slot].shape; }

std::vector<BodyHandle> Scene::bodies() const {
  std::vector<BodyHandle> handles;
  for (std::uint32_t slot = 0; slot < data_->bodies.size(); ++slot) {
    if (data_->bodies[slot].life == SceneBody::Life::kAlive)
      handles.push_back(data_->HandleOf(slot));
  }
  return handles;
}

Verdict Scene::verdict(BodyHandle a, BodyHandle b) const {
  if (!Has(a) || !Has(b)) return Verdict::kSeparate;
  return data_->contacts.verdict(std::min(a.slot, b.slot), std::max(a.slot, b.slot));
}

const SceneOptions& Scene::options() const { return data_->options; }

Scene::Memory Scene::memory() const {
  const Data& d = *data_;
  Memory memory;
  memory.bodies =
      d.bodies.capacity() * sizeof(SceneBody) + d.travel.capacity() * sizeof(double) +
      d.box_limit.capacity() * sizeof(double) + d.moved.capacity() +
      d.boxes.capacity() * sizeof(Box3) + d.parts.capacity() * sizeof(PartData) +
      d.broad_phase->bytes() + d.boxed.capacity() * sizeof(int) +
      (d.free_slots.capacity() + d.removed_slots.capacity() + d.moved_slots.capacity()) *
          sizeof(std::uint32_t);
  memory.pairs = d.pairs.bytes() + d.near.capacity() * sizeof d.near[0] +
                 d.active.capacity() * sizeof(int) + d.must_drop.capacity() + d.contacts.bytes();
  for (int i = 0; i < d.mesh_states.size(); ++i) memory.mesh_pairs += d.mesh_states[i].bytes();
  memory.numbers = static_cast<std::size_t>(d.numbers.size()) * sizeof(internal::PairNumbers) +
                   d.distances.capacity() * sizeof d.distances[0] +
                   d.mesh_distances.capacity() * sizeof d.mesh_distances[0] +
                   d.depths.capacity() * sizeof d.depths[0] +
                   d.mesh_depths.capacity() * sizeof d.mesh_depths[0] +
                   d.continuous_depths.capacity() * sizeof d.continuous_depths[0] +
                   d.travels.capacity() * sizeof d.travels[0] +
                   d.mesh_travels.capacity() * sizeof d.mesh_travels[0];
  return memory;
}

}  // namespace touchstone
