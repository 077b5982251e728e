// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_MINKOWSKI_FLAT_TABLE_INTERNAL_H_
#define TOUCHSTONE_CORE_MINKOWSKI_FLAT_TABLE_INTERNAL_H_

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace touchstone::internal {

// From keys of four numbers to numbers, in one piece of memory: open addressing, half full at most.
class FlatTable {
 public:
  using Key = std::array<int, 4>;

  // The value under the key, and whether it was new: then it is `value`. The reference lives until
  // the next call.
  std::pair<int&, bool> Insert(const Key& key, int value) {
    if (2 * (size_ + 1) > entries_.size()) Grow();
    Entry& entry = entries_[PlaceOf(key)];
    if (entry.is_used) return {entry.value, false};
    entry = {key, value, true};
    ++size_;
    return {entry.value, true};
  }

 private:
  struct Entry {
    Key key;
    int value;
    bool is_used = false;
  };

  static std::uint64_t Hash(const Key& key) {
    std::uint64_t hash = 0;
    for (const int part : key) {
      hash = (hash ^ static_cast<std::uint32_t>(part)) * 0x9e3779b97f4a7c15u;
      hash ^= hash >> 32;
    }
    return hash;
  }

  std::size_t PlaceOf(const Key& key) const {
    std::size_t place = Hash(key) & (entries_.size() - 1);
    while (entries_[place].is_used && entries_[place].key != key) {
      place = (place + 1) & (entries_.size() - 1);
    }
    return place;
  }

  void Grow() {
    std::vector<Entry> before(entries_.empty() ? 32 : 2 * entries_.size());
    std::swap(before, entries_);
    for (const Entry& entry : before) {
      if (entry.is_used) entries_[PlaceOf(entry.key)] = entry;
    }
  }

  std::vector<Entry> entries_;
  std::size_t size_ = 0;
};

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_MINKOWSKI_FLAT_TABLE_INTERNAL_H_
