// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_MINKOWSKI_FLAT_TABLE_INTERNAL_H_
#define TOUCHSTONE_CORE_MINKOWSKI_FLAT_TABLE_INTERNAL_H_

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace touchstone::internal {

// Finds the numbers of things again by what they are, in one piece of memory: open addressing, half
// full at most. Only hashes and numbers are stored, eight bytes each; the things themselves are
// kept, and compared, by the caller.
class NumberTable {
 public:
  static std::uint64_t Hash(const std::array<int, 4>& key) {
    std::uint64_t hash = 0;
    for (const int part : key) {
      hash = (hash ^ static_cast<std::uint32_t>(part)) * 0x9e3779b97f4a7c15u;
      hash ^= hash >> 32;
    }
    return hash;
  }

  // The number of the thing with this hash for which is_same(number), or else `number`, under which
  // it is found from now on.
  template <class IsSame>
  int Insert(std::uint64_t hash, int number, const IsSame& is_same) {
    if (2 * (size_ + 1) > entries_.size()) Grow();
    const auto own = static_cast<std::uint32_t>(hash);
    std::size_t place = own & (entries_.size() - 1);
    for (; entries_[place].number >= 0; place = (place + 1) & (entries_.size() - 1)) {
      if (entries_[place].hash == own && is_same(entries_[place].number)) {
        return entries_[place].number;
      }
    }
    entries_[place] = {own, number};
    ++size_;
    return number;
  }

  // Keeps the room.
  void Clear() {
    if (size_ > 0) std::fill(entries_.begin(), entries_.end(), Entry());
    size_ = 0;
  }

  // Makes room for so many things.
  void Reserve(std::size_t count) {
    if (entries_.size() < 2 * count) GrowTo(std::bit_ceil(2 * count));
  }

 private:
  struct Entry {
    std::uint32_t hash = 0;
    int number = -1;
  };

  void Grow() { GrowTo(entries_.empty() ? 32 : 2 * entries_.size()); }

  // To a power of two.
  void GrowTo(std::size_t size) {
    std::vector<Entry> before(size);
    std::swap(before, entries_);
    for (const Entry& entry : before) {
      if (entry.number < 0) continue;
      std::size_t place = entry.hash & (entries_.size() - 1);
      while (entries_[place].number >= 0) place = (place + 1) & (entries_.size() - 1);
      entries_[place] = entry;
    }
  }

  std::vector<Entry> entries_;
  std::size_t size_ = 0;
};

// Finds the numbers of pairs of numbers again: for each first one a list of its pairs, short where
// few pairs share it. Pairs are numbered 0, 1, ... in the order in which they come.
class PairTable {
 public:
  // Of pairs with first numbers below `count`.
  explicit PairTable(int count) : newest_(static_cast<std::size_t>(count), -1) {}

  // The number of the pair, and whether it is new.
  std::pair<int, bool> Insert(int first, int second) {
    for (int i = newest_[first]; i >= 0; i = links_[i].older) {
      if (links_[i].second == second) return {i, false};
    }
    const int number = static_cast<int>(links_.size());
    links_.push_back({second, newest_[first]});
    newest_[first] = number;
    return {number, true};
  }

 private:
  struct Link {
    int second;
    int older;  // another pair with the same first number
  };
  std::vector<int> newest_;
  std::vector<Link> links_;
};

// Lists of items by owner in one piece of memory: those of owner i are items[first[i]] to
// items[first[i + 1] - 1], in the order in which they came.
template <class Item>
struct ItemLists {
  std::vector<int> first;
  std::vector<Item> items;

  std::span<const Item> Of(int owner) const {
    return {items.data() + first[owner], items.data() + first[owner + 1]};
  }
};

// for_each_item(visit) calls visit(owner, item) for every item, twice over in the same order.
template <class Item, class ForEachItem>
ItemLists<Item> ListByOwner(int owner_count, const ForEachItem& for_each_item) {
  ItemLists<Item> lists;
  lists.first.assign(static_cast<std::size_t>(owner_count) + 1, 0);
  for_each_item([&](int owner, const Item&) { ++lists.first[owner]; });
  int sum = 0;
  for (int& place : lists.first) place = std::exchange(sum, sum + place);
  lists.items.resize(static_cast<std::size_t>(sum));
  for_each_item([&](int owner, const Item& item) { lists.items[lists.first[owner]++] = item; });
  for (int i = owner_count; i > 0; --i) lists.first[i] = lists.first[i - 1];
  lists.first[0] = 0;
  return lists;
}

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_MINKOWSKI_FLAT_TABLE_INTERNAL_H_
