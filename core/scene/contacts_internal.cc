// SPDX-License-Identifier: MIT
#include "touchstone/core/scene/contacts_internal.h"

#include <algorithm>

namespace touchstone::internal {
namespace {

bool Before(const Contact& x, const Contact& y) { return x.key() < y.key(); }

bool BodiesBefore(const Contact& x, const Contact& y) {
  return std::tuple(x.slot_a, x.slot_b) < std::tuple(y.slot_a, y.slot_b);
}

// Past the contacts of the same two bodies as `from`; the strongest of their verdicts.
std::vector<Contact>::const_iterator SkipBodies(std::vector<Contact>::const_iterator from,
                                                std::vector<Contact>::const_iterator end,
                                                Verdict* verdict) {
  *verdict = Verdict::kTouch;
  auto next = from;
  for (; next != end && next->SameBodies(*from); ++next) {
    if (next->verdict == Verdict::kOverlap) *verdict = Verdict::kOverlap;
  }
  return next;
}

}  // namespace

// Both lists are ordered; a change replaces or ends the contact of its parts.
void Contacts::Merge() {
  std::sort(changes_.begin(), changes_.end(), Before);
  before_.swap(contacts_);
  contacts_.clear();
  auto old = before_.begin();
  for (const Contact& change : changes_) {
    for (; old != before_.end() && Before(*old, change); ++old) contacts_.push_back(*old);
    if (old != before_.end() && old->key() == change.key()) ++old;
    if (change.verdict != Verdict::kSeparate) contacts_.push_back(change);
  }
  contacts_.insert(contacts_.end(), old, before_.end());
  changes_.clear();
}

void Contacts::Step(const std::function<BodyHandle(std::uint32_t)>& handle) {
  const bool changed = !changes_.empty();
  if (!changed && all_persist_) return;
  if (changed) {
    Merge();
  } else {
    before_ = contacts_;
  }
  events_.clear();
  all_persist_ = true;
  const auto add = [&](EventKind kind, const Contact& contact, Verdict verdict) {
    events_.push_back({kind, {handle(contact.slot_a), handle(contact.slot_b)}, verdict});
    if (kind != EventKind::kPersist) all_persist_ = false;
  };
  auto old = before_.cbegin();
  auto now = contacts_.cbegin();
  Verdict verdict, verdict_before;
  while (old != before_.cend() || now != contacts_.cend()) {
    if (now == contacts_.cend() || (old != before_.cend() && BodiesBefore(*old, *now))) {
      add(EventKind::kEnd, *old, Verdict::kSeparate);
      old = SkipBodies(old, before_.cend(), &verdict_before);
      continue;
    }
    const bool persists = old != before_.cend() && old->SameBodies(*now);
    const Contact first = *now;
    now = SkipBodies(now, contacts_.cend(), &verdict);
    if (persists) old = SkipBodies(old, before_.cend(), &verdict_before);
    add(persists ? EventKind::kPersist : EventKind::kBegin, first, verdict);
  }
}

Verdict Contacts::verdict(std::uint32_t slot_a, std::uint32_t slot_b) const {
  const Contact wanted{slot_a, slot_b, 0, 0, Verdict::kSeparate};
  const auto range = std::equal_range(contacts_.begin(), contacts_.end(), wanted, BodiesBefore);
  Verdict verdict = Verdict::kSeparate;
  if (range.first != range.second) SkipBodies(range.first, range.second, &verdict);
  return verdict;
}

std::size_t Contacts::bytes() const {
  return (contacts_.capacity() + before_.capacity() + changes_.capacity()) * sizeof(Contact) +
         events_.capacity() * sizeof(SceneEvent);
}

}  // namespace touchstone::internal
