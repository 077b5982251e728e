// SPDX-License-Identifier: MIT
#include "touchstone/core/scene/pair_table_internal.h"

#include <cassert>

namespace touchstone::internal {

// The finaliser of SplitMix64 over both numbers.
std::size_t PairTable::Hash(int p, int q) {
  std::uint64_t x = static_cast<std::uint64_t>(static_cast<std::uint32_t>(p)) << 32 |
                    static_cast<std::uint32_t>(q);
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return static_cast<std::size_t>(x ^ (x >> 31));
}

int PairTable::Find(int p, int q) const {
  if (slots_.empty()) return kNone;
  const std::size_t mask = slots_.size() - 1;
  for (std::size_t slot = Hash(p, q) & mask;; slot = (slot + 1) & mask) {
    const int i = slots_[slot];
    if (i == kNone || (p_[i] == p && q_[i] == q)) return i;
  }
}

int PairTable::Add(int p, int q) {
  assert(Find(p, q) == kNone);
  if (2 * (p_.size() + 1) > slots_.size()) Grow();
  const int i = size();
  p_.push_back(p);
  q_.push_back(q);
  limit_.push_back(-std::numeric_limits<double>::infinity());
  states_.emplace_back();
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = Hash(p, q) & mask;
  while (slots_[slot] != kNone) slot = (slot + 1) & mask;
  slots_[slot] = i;
  return i;
}

std::size_t PairTable::SlotOf(int i) const {
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = Hash(p_[i], q_[i]) & mask;
  while (slots_[slot] != i) slot = (slot + 1) & mask;
  return slot;
}

void PairTable::RemoveAt(int i) {
  const std::size_t mask = slots_.size() - 1;
  std::size_t hole = SlotOf(i);
  // Whatever follows without a gap and would be found from the hole moves back into it.
  for (std::size_t next = (hole + 1) & mask; slots_[next] != kNone; next = (next + 1) & mask) {
    const std::size_t home = Hash(p_[slots_[next]], q_[slots_[next]]) & mask;
    if (((next - home) & mask) >= ((next - hole) & mask)) {
      slots_[hole] = slots_[next];
      hole = next;
    }
  }
  slots_[hole] = kNone;
  const int last = size() - 1;
  if (i != last) {
    slots_[SlotOf(last)] = i;
    p_[i] = p_[last];
    q_[i] = q_[last];
    limit_[i] = limit_[last];
    states_[i] = states_[last];
  }
  p_.pop_back();
  q_.pop_back();
  limit_.pop_back();
  states_.pop_back();
}

void PairTable::Grow() {
  slots_.assign(slots_.empty() ? 16 : 2 * slots_.size(), kNone);
  const std::size_t mask = slots_.size() - 1;
  for (int i = 0; i < size(); ++i) {
    std::size_t slot = Hash(p_[i], q_[i]) & mask;
    while (slots_[slot] != kNone) slot = (slot + 1) & mask;
    slots_[slot] = i;
  }
}

void PairTable::Reserve(std::size_t pairs) {
  p_.reserve(pairs);
  q_.reserve(pairs);
  limit_.reserve(pairs);
  states_.reserve(pairs);
}

std::size_t PairTable::bytes() const {
  return p_.capacity() * sizeof p_[0] + q_.capacity() * sizeof q_[0] +
         limit_.capacity() * sizeof limit_[0] + states_.capacity() * sizeof states_[0] +
         slots_.capacity() * sizeof slots_[0];
}

}  // namespace touchstone::internal
