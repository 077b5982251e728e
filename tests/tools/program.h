// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TESTS_TOOLS_PROGRAM_H_
#define TOUCHSTONE_TESTS_TOOLS_PROGRAM_H_

#include <sys/types.h>

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

// A command of the shell's that runs beside the test; killed when the test leaves it behind.
class Background {
 public:
  explicit Background(const std::string& command);
  ~Background();
  Background(const Background&) = delete;
  Background& operator=(const Background&) = delete;

  void Signal(int signal) const;
  bool has_ended();
  // The exit code, or 128 + n when signal n ended it.
  int Wait();

 private:
  pid_t pid_;
  int status_ = 0;
  bool ended_ = false;
};

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
