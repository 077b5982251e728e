// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_CD_DUAL_BATCH_H_
#define TOUCHSTONE_CORE_CD_DUAL_BATCH_H_

#include <span>

#include "touchstone/core/base/parallel.h"
#include "touchstone/core/cd_dual/cd_dual.h"

namespace touchstone {

// One question of many. What the pointers name must outlive the call; bodies and poses may be
// shared, a cache belongs to one pair.
struct PlacedPairRef {
  const ConvexPolyhedron* p = nullptr;
  const ConvexPolyhedron* q = nullptr;
  const RelativePose* pose = nullptr;
  CollideCache* cache = nullptr;
};

// results[i] = Collide(pairs[i]), the same bit for bit for any number of threads, as if asked one
// by one. The bodies of the pairs to come are fetched while one is computed, which is what pairs
// that come from memory wait for. Requires as many results as pairs. Complexity: that of the
// queries.
void CollideBatch(std::span<const PlacedPairRef> pairs, const CollideOptions& options,
                  std::span<CollideResult> results, Threads threads = Threads::kOne);

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_CD_DUAL_BATCH_H_
