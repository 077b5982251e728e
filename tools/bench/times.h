// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_BENCH_TIMES_H_
#define TOUCHSTONE_TOOLS_BENCH_TIMES_H_

#include <time.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace touchstone {

// Processor time of this thread: other work on the machine does not count.
inline double ProcessorSeconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}
inline double ProcessorMs() { return 1e3 * ProcessorSeconds(); }

// The value with that part of the others below it: 0.5 for the median, the lower one of two. 0 of
// none.
inline double Quantile(std::vector<double> values, double part) {
  if (values.empty()) return 0.0;
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_BENCH_TIMES_H_
