// SPDX-License-Identifier: MIT
#include "touchstone/core/base/parallel.h"

#ifdef TOUCHSTONE_HAS_TBB
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#endif

namespace touchstone {

bool HasThreads() {
#ifdef TOUCHSTONE_HAS_TBB
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
  static_cast<void>(grain);
  static_cast<void>(threads);
  if (count > 0) body(0, count);
}

}  // namespace touchstone
