// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_SCENE_CONTACTS_INTERNAL_H_
#define TOUCHSTONE_CORE_SCENE_CONTACTS_INTERNAL_H_

#include <cstdint>
#include <functional>
#include <span>
#include <tuple>
#include <vector>

#include "touchstone/core/base/verdict.h"
#include "touchstone/core/scene/scene.h"

namespace touchstone::internal {

// Two parts and what they do; slot_a < slot_b.
struct Contact {
  std::uint32_t slot_a, slot_b;
  std::int32_t part_a, part_b;
  Verdict verdict;

  auto key() const { return std::tuple(slot_a, slot_b, part_a, part_b); }
  bool SameBodies(const Contact& other) const {
    return slot_a == other.slot_a && slot_b == other.slot_b;
  }
};

// The parts in contact, ordered, and the events of bodies that changes of parts amount to.
// Complexity of a step: O(c + k log k) for c contacts and k changes; O(1) without changes after a
// step without.
class Contacts {
 public:
  // A part pair whose verdict is new; kSeparate ends it. Each pair once a step.
  void Change(const Contact& contact) { changes_.push_back(contact); }
  // Makes the events of the step. `handle` tells a slot's current handle.
  void Step(const std::function<BodyHandle(std::uint32_t)>& handle);

  std::span<const SceneEvent> events() const { return events_; }
  // kSeparate where there is no contact.
  Verdict verdict(std::uint32_t slot_a, std::uint32_t slot_b) const;
  std::size_t bytes() const;

 private:
  void Merge();

  std::vector<Contact> contacts_, before_, changes_;
  std::vector<SceneEvent> events_;
  bool all_persist_ = true;  // events_ holds one kPersist for each pair of bodies in contact
};

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_SCENE_CONTACTS_INTERNAL_H_
