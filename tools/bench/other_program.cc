// SPDX-License-Identifier: MIT
#include "touchstone/tools/bench/other_program.h"

#include <array>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include "touchstone/tools/result_json.h"

namespace touchstone {
namespace {

// The standard output of a command; nothing when it fails.
std::optional<std::string> OutputOf(const std::string& command) {
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return std::nullopt;
  std::string output;
  std::array<char, 4096> buffer;
  while (const std::size_t got = std::fread(buffer.data(), 1, buffer.size(), pipe))
    output.append(buffer.data(), got);
  if (pclose(pipe) != 0) return std::nullopt;
  return output;
}

BenchMode ModeFromWord(const std::string& word) {
  for (const BenchMode mode : {BenchMode::kRepeat, BenchMode::kMixed, BenchMode::kWarm}) {
    if (ToString(mode) == word) return mode;
  }
  return BenchMode::kRepeat;
}

}  // namespace

std::optional<std::string> ProgramBeside(const std::string& name) {
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error) return std::nullopt;
  const std::filesystem::path path = self.parent_path() / name;
  if (!std::filesystem::exists(path, error)) return std::nullopt;
  return path.string();
}

std::optional<std::vector<ConvexBenchRow>> RunConvexBenchOf(const std::string& program,
                                                            const std::string& arguments) {
  const std::optional<std::string> output =
      OutputOf("'" + program + "' bench convex " + arguments + " --json 2>/dev/null");
  if (!output) return std::nullopt;
  const Json json = Json::parse(*output, nullptr, /*allow_exceptions=*/false);
  if (!json.is_array()) return std::nullopt;
  std::vector<ConvexBenchRow> rows;
  for (const Json& row : json) {
    rows.push_back({row["engine"], row["shape"], row["n"], row["gap"], ModeFromWord(row["mode"]),
                    row["median_ns"], row["queries"], row["wrong"], row["undecided"]});
  }
  return rows;
}

}  // namespace touchstone
