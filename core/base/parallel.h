// SPDX-License-Identifier: MIT
//
// The one place that knows of oneTBB.
#ifndef TOUCHSTONE_CORE_BASE_PARALLEL_H_
#define TOUCHSTONE_CORE_BASE_PARALLEL_H_

#include <cstddef>
#include <functional>

namespace touchstone {

enum class Threads {
  kOne,  // the calling thread
  kAll,  // those of oneTBB, where the library was built with it; else the calling thread
};

// Whether kAll means more than kOne.
bool HasThreads();

// Calls body(begin, end) for ranges that together make [0, count), in parallel where asked for. The
// ranges are no shorter than `grain` but for the last; the body must not care how they fall.
void ForRanges(std::size_t count, std::size_t grain, Threads threads,
               const std::function<void(std::size_t, std::size_t)>& body);

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_BASE_PARALLEL_H_
