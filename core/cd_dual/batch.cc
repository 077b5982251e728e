// SPDX-License-Identifier: MIT
#include "touchstone/core/cd_dual/batch.h"

#include <algorithm>
#include <cassert>

namespace touchstone {
namespace {

constexpr std::size_t kGrain = 64;  // pairs that are worth a task
constexpr std::size_t kAhead = 2;   // pairs fetched before their turn

}  // namespace

void CollideBatch(std::span<const PlacedPairRef> pairs, const CollideOptions& options,
                  std::span<CollideResult> results, Threads threads) {
  assert(results.size() == pairs.size());
  ForRanges(pairs.size(), kGrain, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const PlacedPairRef& next = pairs[std::min(i + kAhead, end - 1)];
      next.p->Prefetch();
      next.q->Prefetch();
      const PlacedPairRef& pair = pairs[i];
      results[i] = Collide(*pair.p, *pair.q, *pair.pose, options, pair.cache);
    }
  });
}

}  // namespace touchstone
