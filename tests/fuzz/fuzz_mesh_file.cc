// SPDX-License-Identifier: MIT
//
// Any bytes as a mesh file, its format by the first byte: an error that names the file, or a soup
// whose indices are in range.
#include <unistd.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <new>
#include <string>

#include "touchstone/tests/fuzz/bytes.h"
#include "touchstone/tools/mesh_io.h"

namespace touchstone {
namespace {

void TryMeshFile(const std::uint8_t* data, std::size_t size) {
  static constexpr std::array kExtensions = {".off", ".obj", ".stl", ".ply"};
  const std::string path = "/dev/shm/touchstone_fuzz_" + std::to_string(getpid()) +
                           kExtensions[data[0] % kExtensions.size()];
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(data) + 1, static_cast<std::streamsize>(size) - 1);
  const Loaded<PolygonSoup> soup = ReadPolygonSoup(path);
  std::remove(path.c_str());
  if (!soup.ok()) {
    Require(soup.error().starts_with(path), "an error names the file");
    return;
  }
  for (const std::vector<int>& polygon : soup->polygons) {
    for (const int v : polygon)
      Require(v >= 0 && v < static_cast<int>(soup->points.size()), "indices are in range");
  }
}

}  // namespace
}  // namespace touchstone

// A file of 20 bytes may announce 10^9 vertices. What limits memory elsewhere does not get along
// with the address sanitizer, whose own operator new ends the program where there is no more.
void* operator new(std::size_t size) {
  static constexpr std::size_t kMost = std::size_t{1} << 28;
  if (size > kMost) throw std::bad_alloc();
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
// Other forms of new are the sanitizer's still, and meet these deletes.
extern "C" const char* __asan_default_options() { return "alloc_dealloc_mismatch=0"; }

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > 0) touchstone::TryMeshFile(data, size);
  return 0;
}
