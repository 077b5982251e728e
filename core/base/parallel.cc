// SPDX-License-Identifier: MIT
#include "touchstone/core/base/parallel.h"

// Under the thread sanitizer plain threads: it does not see how oneTBB's library orders things.
#ifdef __SANITIZE_THREAD__
#undef TOUCHSTONE_HAS_TBB
#define TOUCHSTONE_HAS_PLAIN_THREADS
#include <algorithm>
#include <thread>
#include <vector>
#endif
#ifdef TOUCHSTONE_HAS_TBB
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#endif

namespace touchstone {

bool HasThreads() {
#if defined(TOUCHSTONE_HAS_TBB) || defined(TOUCHSTONE_HAS_PLAIN_THREADS)
  return true;
#else
  return false;
#endif
}

void ForRanges(std::size_t count, std::size_t grain, Threads threads,
               const std::function<void(std::size_t, std::size_t)>& body) {
#ifdef TOUCHSTONE_HAS_TBB
  if (threads == Threads::kAll && count > grain) {
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, count, grain),
                              [&](const auto& range) { body(range.begin(), range.end()); });
    return;
  }
#endif
#ifdef TOUCHSTONE_HAS_PLAIN_THREADS
  if (threads == Threads::kAll && count > grain) {
    const std::size_t part = std::max(grain, (count + 3) / 4);
    std::vector<std::jthread> all;
    for (std::size_t begin = 0; begin < count; begin += part) {
      all.emplace_back([&, begin] { body(begin, std::min(count, begin + part)); });
    }
    return;
  }
#endif
  static_cast<void>(grain);
  static_cast<void>(threads);
  if (count > 0) body(0, count);
}

}  // namespace touchstone
