// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_CD_DUAL_CACHE_H_
#define TOUCHSTONE_CORE_CD_DUAL_CACHE_H_

#include <Eigen/Core>
#include <array>

#include "touchstone/core/cd_dual/minkowski_difference.h"
#include "touchstone/core/cd_dual/result.h"

namespace touchstone {

// What a caller keeps of one pair from frame to frame, so that a query may begin where the last one
// ended. It holds guesses only: whatever comes out of it is proven anew at the new pose, and a
// cache that is stale, or of another pair, or made up, costs time and never an answer. Not to be
// shared between threads that query at once.
struct CollideCache {
  // The direction that separated last, in P's frame, with the corners that reached furthest.
  bool has_direction = false;
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  CornerPair support;

  // The last triangle of M's vertices that the ray left by, and the interior points it came from:
  // encloses o while the bodies overlap, separates by its plane while they do not.
  bool has_triangle = false;
  std::array<CornerPair, 3> triangle;
  int interior_p = 0, interior_q = 0;

  void Clear() { *this = CollideCache{}; }
};

class Signs;

// Whether the cache names a triangle of corners that M has.
bool HoldsTriangle(const MinkowskiDifference& m, const CollideCache& cache);

// The verdict, if what the cache holds proves it at the new pose in doubles. Then fills verdict,
// tier, phase, termination and certificate of `result`, takes c from the cached interior points
// where the proof rests on them, and returns true. Complexity: O(1), and a short climb on each
// body.
bool AnswerFromCache(MinkowskiDifference* m, Signs* signs, CollideCache* cache,
                     CollideResult* result);

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_CD_DUAL_CACHE_H_
