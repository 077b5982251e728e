// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_TOUCHSTONE_SUBCOMMANDS_H_
#define TOUCHSTONE_TOOLS_TOUCHSTONE_SUBCOMMANDS_H_

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "touchstone/core/cd_dual/result.h"
#include "touchstone/tools/bad_input.h"

namespace touchstone {

// What the program returns.
enum ExitCode {
  kFine = 0,
  kFindings = 1,  // the judge found something
  kBadInput = 2,  // bad usage or bad data; one line on stderr says what
};

// One subcommand a file. Each registers its arguments; when it is the one that was asked for, it
// runs and leaves the exit code.
void AddBench(CLI::App& app, int& exit_code);
void AddCollide(CLI::App& app, int& exit_code);
void AddDepth(CLI::App& app, int& exit_code);
void AddDirection(CLI::App& app, int& exit_code);
void AddDistance(CLI::App& app, int& exit_code);
void AddEngines(CLI::App& app, int& exit_code);
void AddFuzz(CLI::App& app, int& exit_code);
void AddMembership(CLI::App& app, int& exit_code);
void AddMinkowski(CLI::App& app, int& exit_code);
void AddReplay(CLI::App& app, int& exit_code);
void AddScene(CLI::App& app, int& exit_code);
void AddSuites(CLI::App& app, int& exit_code);
void AddVerify(CLI::App& app, int& exit_code);

// The values of --search and --certainty; throw BadInput for other words.
Search ParseSearch(const std::string& word);
Certainty ParseCertainty(const std::string& word);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_TOUCHSTONE_SUBCOMMANDS_H_
