// SPDX-License-Identifier: MIT
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "touchstone/tools/boundary_run.h"
#include "touchstone/tools/cpd_judge_run.h"
#include "touchstone/tools/membership_run.h"
#include "touchstone/tools/mesh_depth_run.h"
#include "touchstone/tools/numbers.h"
#include "touchstone/tools/proximity_report.h"
#include "touchstone/tools/proximity_run.h"
#include "touchstone/tools/result_json.h"
#include "touchstone/tools/suites/registry.h"
#include "touchstone/tools/table.h"
#include "touchstone/tools/touchstone/subcommands.h"
#include "touchstone/tools/verify_report.h"
#include "touchstone/tools/words.h"

namespace touchstone {
namespace {

struct Arguments {
  std::string suite = "all", search = "all";
  std::uint64_t seed = 1, first = 0, count = 0;
  double minutes = 0.0;
  std::string meshes, cases;
  int threads = 0;
  std::string certainty = "exact", early_exit = "mixed", depth = "mixed";
  bool coverage = false, proximity = false, membership = false, boundary = false,
       mesh_depth = false, nef = false, cpd = false, json = false;
};

constexpr std::uint64_t kDefaultCount = 1000;
constexpr std::uint64_t kDefaultBoundaries = 400;
constexpr std::uint64_t kBoundaryPiece = 100;  // cases from one line of progress to the next
constexpr std::uint64_t kMembershipPiece =
    10000;  // placements from one line of progress to the next

EarlyExit ParseEarlyExit(const std::string& word) {
  if (word == "never") return EarlyExit::kNever;
  if (word == "always") return EarlyExit::kAlways;
  if (word == "mixed") return EarlyExit::kMixed;
  throw BadInput{"--early-exit: '" + word + "' is none of never, always, mixed"};
}

Depth ParseDepth(const std::string& word) {
  if (word == "proof") return Depth::kProof;
  if (word == "phases") return Depth::kPhases;
  if (word == "mixed") return Depth::kMixed;
  if (word == "full") return Depth::kFull;
  throw BadInput{"--depth: '" + word + "' is none of proof, phases, mixed, full"};
}

// The suites asked for that can run; says on stderr which cannot.
std::vector<const Suite*> SelectSuites(const Arguments& arguments,
                                       const std::vector<std::unique_ptr<Suite>>& all) {
  std::vector<const Suite*> selected;
  bool known = arguments.suite == "all";
  for (const std::unique_ptr<Suite>& suite : all) {
    if (arguments.suite != "all" && suite->name() != arguments.suite) continue;
    known = true;
    const std::string reason = suite->unavailable();
    if (reason.empty()) {
      selected.push_back(suite.get());
    } else if (arguments.suite == "all") {
      std::cerr << "touchstone: suite " << suite->name() << " left out: " << reason << '\n';
    } else {
      throw BadInput{"suite " + arguments.suite + ": " + reason};
    }
  }
  if (!known)
    throw BadInput{"--suite: there is no suite '" + arguments.suite +
                   "'; `touchstone suites` lists them"};
  return selected;
}

std::vector<Search> SelectSearches(const std::string& word) {
  if (word == "all") return {kAllSearches.begin(), kAllSearches.end()};
  if (const auto search = SearchFromWord(word)) return {*search};
  throw BadInput{"--search: '" + word + "' is none of published, phased, portal, all"};
}

std::string PrepareCases(const std::string& directory) {
  if (directory.empty()) return directory;
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (!std::filesystem::is_directory(directory))
    throw BadInput{"--cases: " + directory + " is not a folder and cannot be made one"};
  return directory;
}

void ShowProgress(const Progress& progress) {
  constexpr int kWidth = 40;
  const int filled = static_cast<int>(progress.fraction * kWidth);
  std::cerr << "\r[" << std::string(filled, '#') << std::string(kWidth - filled, '.') << "] "
            << static_cast<int>(100.0 * progress.fraction) << "%  " << progress.queries
            << " judged, " << progress.findings << " findings " << std::flush;
}

int RunBoundaryCommand(const Arguments& arguments) {
  if (arguments.minutes != 0.0) throw BadInput{"--minutes: --boundary takes a --count"};
  const BoundaryRunOptions options{arguments.seed, arguments.first,
                                   arguments.count == 0 ? kDefaultBoundaries : arguments.count};
  const bool terminal = isatty(STDERR_FILENO) != 0;
  const auto stats = RunBoundaryCases(options, [&](std::uint64_t cases, std::uint64_t findings) {
    if (!terminal && cases % kBoundaryPiece != 0) return;
    std::cerr << (terminal ? "\r" : "") << "cases " << options.first << " to "
              << options.first + cases << ", " << findings << " findings" << (terminal ? " " : "\n")
              << std::flush;
  });
  if (terminal) std::cerr << "\r\033[K";
  Json json = {{"seed", options.seed}, {"first", options.first}, {"count", options.count}};
  json["results"] = Json::array();
  Table table;
  table.Row({"turned", "cases", "triangles", "components", "with thin parts", "every piece placed",
             "findings"});
  std::uint64_t findings = 0;
  for (int t = 0; t < kBoundaryTurnCount; ++t) {
    const BoundaryStats& own = stats[t];
    const std::string name(ToString(static_cast<BoundaryTurn>(t)));
    json["results"].push_back({{"turned", name},
                               {"cases", own.cases},
                               {"triangles", own.triangles},
                               {"components", own.components},
                               {"with_thin_parts", own.with_thin_parts},
                               {"enumerated", own.enumerated},
                               {"findings", own.findings},
                               {"samples", own.samples}});
    table.Row({name, std::to_string(own.cases), std::to_string(own.triangles),
               std::to_string(own.components), std::to_string(own.with_thin_parts),
               std::to_string(own.enumerated), std::to_string(own.findings)});
    findings += own.findings;
  }
  if (arguments.json) {
    std::cout << json.dump(2) << '\n';
  } else {
    table.Print(std::cout);
    for (const BoundaryStats& own : stats) {
      for (const std::string& sample : own.samples) std::cout << sample << '\n';
    }
  }
  return findings == 0 ? kFine : kFindings;
}

int RunMembershipCommand(const Arguments& arguments) {
  if (arguments.minutes != 0.0) throw BadInput{"--minutes: --membership takes a --count"};
  const MembershipRunOptions options{arguments.seed, arguments.first,
                                     arguments.count == 0 ? kDefaultCount : arguments.count};
  const bool terminal = isatty(STDERR_FILENO) != 0;
  // On a terminal one line that changes; else a line every so often, to go on from with --first.
  std::uint64_t told = 0;
  const auto stats = RunMembershipPlacements(options, [&](const MembershipProgress& progress) {
    if (!terminal && progress.placements < told + kMembershipPiece) return;
    told = progress.placements;
    std::cerr << (terminal ? "\r" : "") << "placements " << options.first << " to "
              << options.first + progress.placements << ", " << progress.wrong << " wrong"
              << (terminal ? " " : "\n") << std::flush;
  });
  if (terminal) std::cerr << "\r\033[K";
  Json json = {{"seed", options.seed}, {"first", options.first}, {"count", options.count}};
  json["results"] = Json::array();
  Table table;
  table.Row({"placements", "count", "separate", "touch", "overlap", "wrong", "wrong in doubles",
             "undecided in doubles"});
  std::uint64_t wrong = 0;
  for (int p = 0; p < kMembershipPlacementCount; ++p) {
    const MembershipStats& own = stats[p];
    const std::string name(ToString(static_cast<MembershipPlacement>(p)));
    json["results"].push_back({{"placement", name},
                               {"placements", own.placements},
                               {"separate", own.verdicts[0]},
                               {"touch", own.verdicts[1]},
                               {"overlap", own.verdicts[2]},
                               {"wrong", own.wrong},
                               {"wrong_in_doubles", own.wrong_in_doubles},
                               {"undecided", own.undecided},
                               {"samples", own.samples}});
    table.Row({name, std::to_string(own.placements), std::to_string(own.verdicts[0]),
               std::to_string(own.verdicts[1]), std::to_string(own.verdicts[2]),
               std::to_string(own.wrong), std::to_string(own.wrong_in_doubles),
               std::to_string(own.undecided)});
    wrong += own.wrong + own.wrong_in_doubles;
  }
  if (arguments.json) {
    std::cout << json.dump(2) << '\n';
  } else {
    table.Print(std::cout);
    for (const MembershipStats& own : stats) {
      for (const std::string& sample : own.samples) std::cout << sample << '\n';
    }
  }
  return wrong == 0 ? kFine : kFindings;
}

int RunMeshDepthCommand(const Arguments& arguments) {
  if (arguments.minutes != 0.0) throw BadInput{"--minutes: --mesh-depth takes a --count"};
  const MeshDepthRunOptions options{arguments.seed, arguments.first,
                                    arguments.count == 0 ? kDefaultCount : arguments.count,
                                    arguments.nef};
  const bool terminal = isatty(STDERR_FILENO) != 0;
  const auto stats = RunMeshDepths(options, [&](double fraction) {
    if (terminal) std::cerr << '\r' << static_cast<int>(100.0 * fraction) << "% " << std::flush;
  });
  if (terminal) std::cerr << "\r\033[K";
  Json json = {{"seed", options.seed},
               {"first", options.first},
               {"count", options.count},
               {"nef", options.nef}};
  json["results"] = Json::array();
  Table table;
  table.Row({"placements", "count", "overlapping", "certain", "by boundary", "natural vertices",
             "judged", "late", "wrong"});
  std::uint64_t wrong = 0;
  for (int p = 0; p < kDepthPlacementCount; ++p) {
    const MeshDepthStats& own = stats[p];
    const std::string name(ToString(static_cast<DepthPlacement>(p)));
    json["results"].push_back({{"placement", name},
                               {"placements", own.placements},
                               {"overlapping", own.overlapping},
                               {"certain", own.certain},
                               {"by_boundary", own.by_boundary},
                               {"natural_vertices", own.natural_vertices},
                               {"judged", own.judged},
                               {"late", own.late},
                               {"late_pairs", own.late_pairs},
                               {"wrong", own.wrong},
                               {"samples", own.samples}});
    std::vector<std::string> row = {name};
    for (const std::uint64_t count : {own.placements, own.overlapping, own.certain, own.by_boundary,
                                      own.natural_vertices, own.judged, own.late, own.wrong}) {
      row.push_back(std::to_string(count));
    }
    table.Row(row);
    wrong += own.wrong;
  }
  if (arguments.json) {
    std::cout << json.dump(2) << '\n';
  } else {
    table.Print(std::cout);
    for (const MeshDepthStats& own : stats) {
      for (const std::string& pair : own.late_pairs) std::cout << "late: " << pair << '\n';
      for (const std::string& sample : own.samples) std::cout << sample << '\n';
    }
  }
  return wrong == 0 ? kFine : kFindings;
}

int RunCpdJudgeCommand(const Arguments& arguments) {
  if (arguments.minutes != 0.0) throw BadInput{"--minutes: --cpd takes a --count"};
  const CpdJudgeOptions options{arguments.seed, arguments.first,
                                arguments.count == 0 ? kDefaultCount : arguments.count};
  const bool terminal = isatty(STDERR_FILENO) != 0;
  const auto stats = RunCpdJudge(options, [&](double fraction) {
    if (terminal) std::cerr << '\r' << static_cast<int>(100.0 * fraction) << "% " << std::flush;
  });
  if (terminal) std::cerr << "\r\033[K";
  Json json = {{"seed", options.seed}, {"first", options.first}, {"count", options.count}};
  json["results"] = Json::array();
  Table table;
  table.Row({"placements", "count", "overlapping", "projections", "on kept triangles", "wrong"});
  std::uint64_t wrong = 0;
  for (int c = 0; c < kCpdCaseCount; ++c) {
    const CpdJudgeStats& own = stats[c];
    const std::string name(ToString(static_cast<CpdCase>(c)));
    json["results"].push_back({{"case", name},
                               {"placements", own.placements},
                               {"overlapping", own.overlapping},
                               {"found", own.found},
                               {"kept", own.kept},
                               {"wrong", own.wrong},
                               {"samples", own.samples}});
    table.Row({name, std::to_string(own.placements), std::to_string(own.overlapping),
               std::to_string(own.found), std::to_string(own.kept), std::to_string(own.wrong)});
    wrong += own.wrong;
  }
  if (arguments.json) {
    std::cout << json.dump(2) << '\n';
  } else {
    table.Print(std::cout);
    for (const CpdJudgeStats& own : stats) {
      for (const std::string& sample : own.samples) std::cout << sample << '\n';
    }
  }
  return wrong == 0 ? kFine : kFindings;
}

int RunVerifyCommand(const Arguments& arguments) {
  if (arguments.nef && !arguments.mesh_depth) throw BadInput{"--nef: belongs to --mesh-depth"};
  if (arguments.mesh_depth) return RunMeshDepthCommand(arguments);
  if (arguments.cpd) return RunCpdJudgeCommand(arguments);
  if (arguments.membership) return RunMembershipCommand(arguments);
  if (arguments.boundary) return RunBoundaryCommand(arguments);
  if (!arguments.meshes.empty() && !std::filesystem::is_directory(arguments.meshes)) {
    throw BadInput{"--meshes: " + arguments.meshes + " is not a folder"};
  }
  if (!(arguments.minutes >= 0.0)) throw BadInput{"--minutes: takes a number that is not negative"};
  if (arguments.threads < 0) throw BadInput{"--threads: takes a number that is not negative"};
  VerifyOptions options;
  options.searches = SelectSearches(arguments.search);
  options.certainty = ParseCertainty(arguments.certainty);
  options.early_exit = ParseEarlyExit(arguments.early_exit);
  options.depth = ParseDepth(arguments.depth);
  options.seed = arguments.seed;
  options.first = arguments.first;
  options.count =
      arguments.count == 0 && arguments.minutes == 0.0 ? kDefaultCount : arguments.count;
  options.minutes = arguments.minutes;
  options.threads = arguments.threads > 0
                        ? arguments.threads
                        : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  options.cases_dir = PrepareCases(arguments.cases);
  const std::vector<std::unique_ptr<Suite>> all = MakeSuites(arguments.meshes);
  options.suites = SelectSuites(arguments, all);

  const bool terminal = isatty(STDERR_FILENO) != 0;
  const auto show = terminal ? std::function<void(const Progress&)>(ShowProgress) : nullptr;
  if (arguments.proximity) {
    const std::vector<SuiteProximity> suites = RunProximity(options, show);
    if (terminal) std::cerr << "\r\033[K";
    if (arguments.json) {
      std::cout << ProximityJson(options, suites).dump(2) << '\n';
    } else {
      PrintProximity(std::cout, suites);
    }
    return ProvenFindings(suites) == 0 ? kFine : kFindings;
  }
  const std::vector<SuiteStats> stats = RunVerify(options, show);
  if (terminal) std::cerr << "\r\033[K";

  if (arguments.json) {
    std::cout << VerifyJson(options, stats).dump(2) << '\n';
  } else {
    if (arguments.coverage) PrintCoverage(std::cout, options, stats);
    PrintVerify(std::cout, options, stats);
  }
  return Total(options, stats).proven_findings == 0 ? kFine : kFindings;
}

}  // namespace

void AddVerify(CLI::App& app, int& exit_code) {
  CLI::App* command =
      app.add_subcommand("verify", "Run suites through searches and the exact judge");
  const auto arguments = std::make_shared<Arguments>();
  command->add_option("--suite", arguments->suite, "a suite's name, or all")->capture_default_str();
  command->add_option("--search", arguments->search, "published, phased, portal, or all")
      ->capture_default_str();
  command->add_option("--seed", arguments->seed, "which stream of queries")->capture_default_str();
  command->add_option("--first", arguments->first, "the first index")->capture_default_str();
  command->add_option("--count", arguments->count,
                      "indices per suite; 1000 unless --minutes is given");
  command->add_option("--minutes", arguments->minutes,
                      "instead of a count: so long, the suites in equal shares");
  command->add_option("--meshes", arguments->meshes, "folder of meshes for the suite of that name");
  command->add_option("--threads", arguments->threads, "0: as many as the machine has")
      ->capture_default_str();
  command->add_option("--certainty", arguments->certainty, "float or exact")->capture_default_str();
  command
      ->add_option("--early-exit", arguments->early_exit,
                   "never, always, or mixed: one in four, in the proven searches")
      ->capture_default_str();
  command
      ->add_option("--depth", arguments->depth,
                   "how far the judge looks: proof, phases, mixed, or full (slow)")
      ->capture_default_str();
  command->add_option("--cases", arguments->cases, "folder for the case files of failing queries");
  command->add_flag("--coverage", arguments->coverage,
                    "print the count of every combination of class, phase, verdict");
  command->add_flag("--proximity", arguments->proximity,
                    "ask distances, depths and travels instead of verdicts");
  command->add_flag(
      "--membership", arguments->membership,
      "ask where meshes stand, exactly, near contact and anywhere: --count placements "
      "from --first on, on one thread");
  command->add_flag("--mesh-depth", arguments->mesh_depth,
                    "ask global depths of meshes, judged by exact upper and lower checks: --count "
                    "placements from --first on, on one thread");
  command->add_flag("--nef", arguments->nef,
                    "with --mesh-depth: small bodies, against whole boundaries by Nef polyhedra, "
                    "30 s each at most");
  command->add_flag("--cpd", arguments->cpd,
                    "ask continuous depths of random pairs and along the paper's scenes, and judge "
                    "each by exact membership, the depth, and its residual: --count placements "
                    "from --first on, on one thread");
  command->add_flag("--boundary", arguments->boundary,
                    "build whole Minkowski boundaries of small bodies, aligned, nearly so and "
                    "anyhow, and judge them: --count cases from --first on, on one thread");
  command->add_flag("--json", arguments->json, "print JSON");
  command->footer(
      "Exit code 1 when a proven search has a finding; the published search's are counted, not an "
      "error.");
  command->callback([arguments, &exit_code] { exit_code = RunVerifyCommand(*arguments); });
}

}  // namespace touchstone
