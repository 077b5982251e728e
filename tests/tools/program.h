// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TESTS_TOOLS_PROGRAM_H_
#define TOUCHSTONE_TESTS_TOOLS_PROGRAM_H_

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace touchstone {

// What a run of the program left behind.
struct ProgramRun {
  int exit_code;  // 128 + n when signal n ended it
  std::string out, err;

  nlohmann::json json() const { return nlohmann::json::parse(out); }
};

// Runs `touchstone ARGUMENTS` through the shell.
ProgramRun RunProgram(const std::string& arguments);

// A folder for one test, empty at first and removed at the end.
class TemporaryFolder {
 public:
  explicit TemporaryFolder(std::string_view name);
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::string path(std::string_view file) const { return (path_ / file).string(); }
  // Writes a file and returns its path.
  std::string Write(std::string_view file, std::string_view content) const;
  std::string Read(std::string_view file) const;

 private:
  std::filesystem::path path_;
};

}  // namespace touchstone

#endif  // TOUCHSTONE_TESTS_TOOLS_PROGRAM_H_
