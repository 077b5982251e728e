// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_TOUCHSTONE_HEAP_METER_H_
#define TOUCHSTONE_TOOLS_TOUCHSTONE_HEAP_METER_H_

#include "touchstone/tools/bench/heap_use.h"

namespace touchstone {

// The program's heap meter: what this thread holds through operator new.
HeapUse MeterHeap();

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_TOUCHSTONE_HEAP_METER_H_
