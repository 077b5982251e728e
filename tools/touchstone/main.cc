// SPDX-License-Identifier: MIT
//
// The program links the exact half and CGAL, so its binary is under the GPL, version 3 or later.
#include <exception>
#include <iostream>

#include "touchstone/tools/touchstone/cpd.h"
#include "touchstone/tools/touchstone/subcommands.h"
#include "touchstone/tools/words.h"

namespace touchstone {

Search ParseSearch(const std::string& word) {
  if (const auto search = SearchFromWord(word)) return *search;
  throw BadInput{"--search: '" + word + "' is none of published, phased, portal"};
}

Certainty ParseCertainty(const std::string& word) {
  if (const auto certainty = CertaintyFromWord(word)) return *certainty;
  throw BadInput{"--certainty: '" + word + "' is none of float, exact"};
}

namespace {

int Run(int argc, char** argv) {
  CLI::App app("Touchstone: collision answers that can be proven", "touchstone");
  app.require_subcommand(1);
  app.footer("Exit code: 0 fine, 1 findings, 2 bad usage or bad data.");
  int exit_code = kFine;
  AddCollide(app, exit_code);
  AddDistance(app, exit_code);
  AddCpd(app, exit_code);
  AddDepth(app, exit_code);
  AddDirection(app, exit_code);
  AddVerify(app, exit_code);
  AddSuites(app, exit_code);
  AddReplay(app, exit_code);
  AddBench(app, exit_code);
  AddEngines(app, exit_code);
  AddFuzz(app, exit_code);
  AddMembership(app, exit_code);
  AddMinkowski(app, exit_code);
  AddScene(app, exit_code);
  // Otherwise CLI11 says only that a subcommand is required.
  const auto is_asked = [&](const CLI::App* command) { return command->get_name() == argv[1]; };
  if (argc > 1 && argv[1][0] != '-' && app.get_subcommands(is_asked).empty()) {
    throw BadInput{"there is no subcommand '" + std::string(argv[1]) + "'; see touchstone --help"};
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp& help) {
    return app.exit(help);
  } catch (const CLI::CallForAllHelp& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    throw BadInput{error.what()};
  }
  return exit_code;
}

}  // namespace
}  // namespace touchstone

int main(int argc, char** argv) {
  try {
    return touchstone::Run(argc, argv);
  } catch (const touchstone::BadInput& bad) {
    std::cerr << "touchstone: " << bad.message << '\n';
  } catch (const std::exception& error) {
    std::cerr << "touchstone: " << error.what() << '\n';
  }
  return touchstone::kBadInput;
}
