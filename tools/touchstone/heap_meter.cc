// SPDX-License-Identifier: MIT
//
// The program's operator new, which counts: `bench` reports allocations per query and bytes per
// vertex. C libraries that call malloc themselves are not seen.
#include "touchstone/tools/touchstone/heap_meter.h"

#include <malloc.h>

#include <cstdlib>
#include <new>

namespace touchstone {
namespace {

thread_local HeapUse use;

void* Counted(void* block) {
  if (block == nullptr) throw std::bad_alloc();
  ++use.allocations;
  use.bytes += static_cast<long>(malloc_usable_size(block));
  return block;
}

void Free(void* block) {
  if (block == nullptr) return;
  use.bytes -= static_cast<long>(malloc_usable_size(block));
  std::free(block);
}

}  // namespace

HeapUse MeterHeap() { return use; }

}  // namespace touchstone

// The array and nothrow forms of the standard library call these.
void* operator new(std::size_t size) { return touchstone::Counted(std::malloc(size)); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  const auto align = static_cast<std::size_t>(alignment);
  return touchstone::Counted(std::aligned_alloc(align, (size + align - 1) / align * align));
}
void operator delete(void* block) noexcept { touchstone::Free(block); }
void operator delete(void* block, std::size_t) noexcept { touchstone::Free(block); }
void operator delete(void* block, std::align_val_t) noexcept { touchstone::Free(block); }
void operator delete(void* block, std::size_t, std::align_val_t) noexcept {
  touchstone::Free(block);
}
