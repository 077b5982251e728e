// SPDX-License-Identifier: MIT
//
// Any bytes as a case file: an error with a line, or a case that is written and read back the same.
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <sstream>
#include <string>

#include "touchstone/tests/fuzz/bytes.h"
#include "touchstone/tools/case_file.h"

namespace touchstone {
namespace {

// A file in memory.
class MemoryFile {
 public:
  explicit MemoryFile(const std::string& content) : file_(memfd_create("case", 0)) {
    Require(file_ >= 0 && write(file_, content.data(), content.size()) ==
                              static_cast<ssize_t>(content.size()),
            "a file in memory");
  }
  ~MemoryFile() { close(file_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  std::string path() const { return "/proc/self/fd/" + std::to_string(file_); }

 private:
  int file_;
};

void TryCaseFile(const std::string& content) {
  const MemoryFile file(content);
  const Loaded<CaseFile> loaded = ReadCase(file.path());
  if (!loaded.ok()) {
    Require(loaded.error().starts_with(file.path() + ":"), "an error names file and line");
    return;
  }
  std::ostringstream written;
  WriteCase(written, *loaded);
  const MemoryFile again(written.str());
  const Loaded<CaseFile> reread = ReadCase(again.path());
  Require(reread.ok(), "what is written is read");
  std::ostringstream rewritten;
  WriteCase(rewritten, *reread);
  Require(rewritten.str() == written.str(), "and is the same");
}

}  // namespace
}  // namespace touchstone

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  touchstone::TryCaseFile(std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}
