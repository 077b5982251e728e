// SPDX-License-Identifier: MIT
//
// What came and what went, from sorted lists.
#ifndef TOUCHSTONE_CORE_MINKOWSKI_SUM_CHANGES_INTERNAL_H_
#define TOUCHSTONE_CORE_MINKOWSKI_SUM_CHANGES_INTERNAL_H_

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "touchstone/core/minkowski/dynamic_convolution.h"

namespace touchstone::internal {

// Calls add for each of `from` that is not in `without`; both sorted.
template <class T, class Add>
void ForEachMissing(const std::vector<T>& from, const std::vector<T>& without, const Add& add) {
  auto other = without.begin();
  for (const T& item : from) {
    while (other != without.end() && *other < item) ++other;
    if (other == without.end() || item < *other) add(item);
  }
}

// Sorts the changes, and takes out what came and went between two updates.
inline void CancelChanges(SumChanges* changes, SumChanges* scratch) {
  std::sort(changes->dropped.begin(), changes->dropped.end());
  std::sort(changes->added.begin(), changes->added.end());
  scratch->dropped.clear();
  scratch->added.clear();
  std::set_difference(changes->dropped.begin(), changes->dropped.end(), changes->added.begin(),
                      changes->added.end(), std::back_inserter(scratch->dropped));
  std::set_difference(changes->added.begin(), changes->added.end(), changes->dropped.begin(),
                      changes->dropped.end(), std::back_inserter(scratch->added));
  std::swap(*changes, *scratch);
}

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_MINKOWSKI_SUM_CHANGES_INTERNAL_H_
