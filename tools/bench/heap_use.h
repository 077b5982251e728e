// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_BENCH_HEAP_USE_H_
#define TOUCHSTONE_TOOLS_BENCH_HEAP_USE_H_

namespace touchstone {

// What this thread has taken through operator new since it began: how often, and how many bytes it
// holds now. Counted only in the program, which replaces operator new (touchstone/heap_meter.cc);
// libraries and tests pass null.
struct HeapUse {
  long allocations = 0;
  long bytes = 0;
};
using HeapMeter = HeapUse (*)();

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_BENCH_HEAP_USE_H_
