// SPDX-License-Identifier: MIT
#include <iomanip>
#include <iostream>
#include <memory>

#include "touchstone/tools/result_json.h"
#include "touchstone/tools/suites/registry.h"
#include "touchstone/tools/touchstone/subcommands.h"

namespace touchstone {
namespace {

int RunSuites(bool as_json) {
  Json json = Json::array();
  for (const std::unique_ptr<Suite>& suite : MakeSuites("")) {
    if (as_json) {
      json.push_back(
          {{"suite", suite->name()}, {"summary", suite->summary()}, {"attacks", suite->attacks()}});
    } else {
      std::cout << std::left << std::setw(16) << suite->name() << suite->summary() << '\n';
    }
  }
  if (as_json) std::cout << json.dump(2) << '\n';
  return kFine;
}

}  // namespace

void AddSuites(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("suites", "List the suites of queries, one line each");
  const auto json = std::make_shared<bool>(false);
  command->add_flag("--json", *json, "print JSON, with what each attacks");
  command->callback([json, &exit_code] { exit_code = RunSuites(*json); });
}

}  // namespace touchstone
