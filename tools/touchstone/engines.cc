// SPDX-License-Identifier: MIT
#include <iomanip>
#include <iostream>

#include "touchstone/tools/engines/registry.h"
#include "touchstone/tools/touchstone/subcommands.h"

namespace touchstone {

void AddEngines(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("engines", "List the engines that are timed and judged");
  command->callback([&exit_code] {
    for (const EngineDescription& engine : AllEngines()) {
      std::cout << std::left << std::setw(20) << engine.name
                << (engine.unavailable.empty() ? engine.summary
                                               : "unavailable: " + engine.unavailable)
                << '\n';
    }
    exit_code = kFine;
  });
}

}  // namespace touchstone
