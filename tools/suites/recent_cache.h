// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_SUITES_RECENT_CACHE_H_
#define TOUCHSTONE_TOOLS_SUITES_RECENT_CACHE_H_

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace touchstone {

// The last few results of a pure function of (name, seed, block): suites keep shapes here over
// consecutive indices. One per thread: declare it thread_local.
template <class Value>
class RecentCache {
 public:
  // The value for the key, from `make()` when it is not among the last four. Valid until the next
  // call.
  template <class Make>
  const Value& Get(std::string_view name, std::uint64_t seed, std::uint64_t block, Make make) {
    for (const std::optional<Entry>& entry : entries_) {
      if (entry && entry->name == name && entry->seed == seed && entry->block == block)
        return entry->value;
    }
    std::optional<Entry>& slot = entries_[next_++ % entries_.size()];
    slot.emplace(Entry{std::string(name), seed, block, make()});
    return slot->value;
  }

 private:
  struct Entry {
    std::string name;
    std::uint64_t seed, block;
    Value value;
  };
  std::array<std::optional<Entry>, 4> entries_;
  std::size_t next_ = 0;
};

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_SUITES_RECENT_CACHE_H_
