// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_TOUCHSTONE_CPD_H_
#define TOUCHSTONE_TOOLS_TOUCHSTONE_CPD_H_

#include <CLI/CLI.hpp>

namespace touchstone {

// `touchstone cpd` and `touchstone bench cpd`, as the subcommands of subcommands.h and bench.h.
void AddCpd(CLI::App& app, int& exit_code);
void AddBenchCpd(CLI::App& bench, int& exit_code);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_TOUCHSTONE_CPD_H_
