// SPDX-License-Identifier: MIT
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <memory>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "touchstone/tools/campaign/campaign.h"
#include "touchstone/tools/campaign/cluster.h"
#include "touchstone/tools/campaign/report.h"
#include "touchstone/tools/campaign/shrunk_case.h"
#include "touchstone/tools/campaign/stability.h"
#include "touchstone/tools/suites/registry.h"
#include "touchstone/tools/touchstone/subcommands.h"

namespace touchstone {
namespace {

constexpr std::uint64_t kDefaultCount = kBatchIndices;

struct Arguments {
  std::vector<std::string> suites = {"all"}, engines = {"ours"};
  std::string out, meshes, report;
  std::uint64_t seed = 1, count = 0;
  double minutes = 0.0, hang_seconds = 20.0;
  int threads = 0;
  double shrink_seconds = 10.0, silence_seconds = 120.0;
  SamplingRates rates;
  bool coverage = false, json = false, markdown = false;
};

std::atomic<bool> stop_asked{false};

extern "C" void AskToStop(int signal) {
  // The second time there is no waiting.
  if (stop_asked.exchange(true)) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
}

std::vector<const Suite*> SelectSuites(const std::vector<std::string>& names,
                                       const std::vector<std::unique_ptr<Suite>>& all) {
  std::vector<const Suite*> selected;
  for (const std::string& name : names) {
    bool known = name == "all";
    for (const std::unique_ptr<Suite>& suite : all) {
      if (name == "all" ? !suite->unavailable().empty() : suite->name() != name) continue;
      if (!suite->unavailable().empty())
        throw BadInput{"--suites: " + name + " is unavailable: " + suite->unavailable()};
      known = true;
      selected.push_back(suite.get());
    }
    if (!known) throw BadInput{"--suites: there is no suite '" + name + "'; see touchstone suites"};
  }
  return selected;
}

std::string Clock(double seconds) {
  if (!(seconds < 360'000.0)) return "?";
  const int whole = static_cast<int>(seconds);
  char text[16];
  std::snprintf(text, sizeof(text), "%d:%02d:%02d", whole / 3600, whole / 60 % 60, whole % 60);
  return text;
}

// A bar where there is a terminal; elsewhere a line a minute.
class ProgressLine {
 public:
  void Show(const CampaignProgress& progress) {
    const double period = terminal_ ? 0.5 : 60.0;
    if (progress.seconds < next_) return;
    next_ = progress.seconds + period;
    const double rate =
        progress.seconds > 0.0 ? static_cast<double>(progress.queries) / progress.seconds : 0.0;
    std::cerr << (terminal_ ? "\r\033[K" : "") << std::fixed << std::setprecision(1)
              << 100.0 * progress.fraction << "%  " << progress.queries << " judged, "
              << progress.findings << " findings, " << static_cast<long>(rate) << "/s, "
              << Clock(progress.seconds_left) << " left" << (terminal_ ? "" : "\n") << std::flush;
  }
  void Clear() const {
    if (terminal_) std::cerr << "\r\033[K";
  }

 private:
  bool terminal_ = isatty(STDERR_FILENO) != 0;
  double next_ = terminal_ ? 0.0 : 60.0;
};

void PrintCoverage(std::ostream& out, const CampaignTotals& totals, const std::string& engine,
                   const CoverageGaps& gaps) {
  for (const auto& [combination, count] : totals.WithPrefix(engine, keys::kCoverage))
    out << engine << "  " << combination << "  " << count << '\n';
  for (const auto& [combination, count] : gaps.too_few)
    out << engine << ": too few: " << combination << ": " << count << '\n';
  for (const auto& [combination, count] : gaps.unlisted)
    out << engine << ": not listed as reachable: " << combination << ": " << count << '\n';
}

// Shrinks the first finding of every engine and kind that has no case file yet.
void ShrinkFindings(const Arguments& arguments, const CampaignPlan& plan, CampaignStore& store) {
  std::set<std::pair<std::string, std::string>> known;
  const std::vector<StoredFinding> findings = store.FirstFindings(1);
  for (const StoredFinding& finding : findings) {
    if (!finding.case_file.empty()) known.emplace(finding.engine, finding.kind);
  }
  for (const StoredFinding& finding : findings) {
    if (stop_asked) return;
    if (finding.engine == "judge" || finding.engine == "corrupted") continue;
    if (known.contains({finding.engine, finding.kind})) continue;
    const std::string name = WriteShrunkCase(
        finding, plan, arguments.out,
        {.seconds = arguments.shrink_seconds, .hang_seconds = arguments.hang_seconds});
    if (name.empty()) continue;
    store.NameCase(finding, name);
    known.emplace(finding.engine, finding.kind);
  }
}

const char* Describe(CampaignEnd end) {
  switch (end) {
    case CampaignEnd::kComplete:
      return "complete";
    case CampaignEnd::kTimeIsUp:
      return "the time is up; the same command goes on";
    case CampaignEnd::kStopped:
      return "stopped; the same command goes on";
  }
  return "";
}

int Conclude(const Arguments& arguments, const CampaignPlan& plan, const CampaignStore& store,
             CampaignEnd end) {
  const CampaignTotals totals(store);
  bool gaps_found = false;
  Json coverage = Json::array();
  for (const std::string& engine : plan.engines) {
    const CoverageGaps gaps = FindCoverageGaps(totals, engine, kCoverageFloor);
    for (const auto& [combination, count] : gaps.too_few)
      coverage.push_back({{"engine", engine}, {"combination", combination}, {"count", count}});
    // Only a run with a stated total can fall short.
    gaps_found |= !gaps.too_few.empty() && end == CampaignEnd::kComplete;
    gaps_found |= !gaps.unlisted.empty();
    if (arguments.coverage && !arguments.json) PrintCoverage(std::cout, totals, engine, gaps);
  }
  if (arguments.json) {
    Json json = totals.ToJson();
    json["end"] = Describe(end);
    json["too_few"] = coverage;
    std::cout << json.dump(2) << '\n';
  } else {
    totals.Print(std::cout);
    if (totals.Of("portal", keys::kQueries) + totals.Of("phased", keys::kQueries) > 0)
      PrintTargets(FindTargets(totals), std::cout);
    std::cout << Describe(end) << '\n';
  }
  const bool fails = totals.ProvenFindings() > 0 || (arguments.coverage && gaps_found);
  return fails ? kFindings : kFine;
}

void CheckArguments(const Arguments& arguments) {
  if (arguments.out.empty()) throw BadInput{"--out: names the folder of the campaign"};
  if (!(arguments.minutes >= 0.0)) throw BadInput{"--minutes: takes a number that is not negative"};
  if (!(arguments.hang_seconds > 0.0)) throw BadInput{"--hang-seconds: takes a positive number"};
  // A rank says that it is alive every two seconds.
  if (!(arguments.silence_seconds >= 5.0))
    throw BadInput{"--silence-seconds: takes a number from 5 on"};
  if (arguments.threads < 0) throw BadInput{"--threads: takes a number that is not negative"};
  if (!arguments.meshes.empty() && !std::filesystem::is_directory(arguments.meshes))
    throw BadInput{"--meshes: " + arguments.meshes + " is not a folder"};
}

// Hands out, stores, shrinks and reports.
int RunHere(const Arguments& arguments, const CampaignPlan& plan, const CampaignLimits& limits,
            Workers& workers) {
  CampaignStore store(arguments.out, plan);
  std::signal(SIGINT, AskToStop);
  std::signal(SIGTERM, AskToStop);
  ProgressLine line;
  const CampaignEnd end = RunCampaign(
      plan, limits, store, workers, [&](const CampaignProgress& progress) { line.Show(progress); });
  line.Clear();
  if (arguments.shrink_seconds > 0.0 && end != CampaignEnd::kStopped)
    ShrinkFindings(arguments, plan, store);
  return Conclude(arguments, plan, store, end);
}

int RunReport(const Arguments& arguments) {
  const CampaignStore store(arguments.report);
  ReportStability(CampaignTotals(store), arguments.report, arguments.markdown, std::cout);
  return kFine;
}

int RunFuzz(const Arguments& arguments) {
  if (!arguments.report.empty()) return RunReport(arguments);
  CheckArguments(arguments);
  const std::vector<std::unique_ptr<Suite>> all = MakeSuites(arguments.meshes);
  CampaignPlan plan;
  plan.suites = SelectSuites(arguments.suites, all);
  for (const auto& contestant : MakeContestants(arguments.engines))
    plan.engines.push_back(contestant->name());
  plan.seed = arguments.seed;
  plan.rates = arguments.rates;
  CampaignLimits limits{arguments.count, arguments.minutes, &stop_asked};
  if (limits.count == 0 && limits.minutes == 0.0) limits.count = kDefaultCount;
  const int threads = arguments.threads > 0
                          ? arguments.threads
                          : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  // Before a cluster is joined: workers are forked from a process without threads.
  std::unique_ptr<Workers> local = MakeLocalWorkers(plan, threads, arguments.hang_seconds);
  if (!Cluster::IsJob()) return RunHere(arguments, plan, limits, *local);
  const std::unique_ptr<Cluster> cluster = Cluster::Join();
  if (cluster->rank() > 0) {
    const bool in_order = ServeRank(*cluster, *local);
    local.reset();  // its processes end with it
    cluster->Leave(in_order, kFine);
    return kFine;
  }
  ClusterWorkers workers(*cluster, std::move(local), arguments.silence_seconds);
  try {
    const int exit_code = RunHere(arguments, plan, limits, workers);
    std::cout << std::flush;
    cluster->Leave(workers.Dismiss(), exit_code);
    return exit_code;
  } catch (const BadInput& bad) {
    // The other ranks wait for work.
    std::cerr << "touchstone: " << bad.message << std::endl;
    cluster->Leave(false, kBadInput);
    throw;
  }
}

}  // namespace

void AddFuzz(CLI::App& app, int& exit_code) {
  CLI::App* command =
      app.add_subcommand("fuzz", "Hunt for wrong answers: a campaign that is resumed and shrunk");
  const auto arguments = std::make_shared<Arguments>();
  command->add_option("--suites", arguments->suites, "names, or all")
      ->delimiter(',')
      ->capture_default_str();
  command
      ->add_option("--engines", arguments->engines,
                   "names (NAME, NAME:default, NAME:held), or ours, others, all; corrupted")
      ->delimiter(',')
      ->capture_default_str();
  command->add_option("--seed", arguments->seed, "which stream of queries")->capture_default_str();
  command->add_option("--count", arguments->count,
                      "indices per suite; 960 unless --minutes is given");
  command->add_option("--minutes", arguments->minutes,
                      "for so long; without --count the suites in equal shares");
  command
      ->add_option("--threads", arguments->threads,
                   "processes that ask and judge; 0: as many as the machine has processors")
      ->capture_default_str();
  command->add_option("--out", arguments->out,
                      "folder of the campaign; the same command goes on with it");
  command->add_option("--meshes", arguments->meshes, "folder of meshes for the suite of that name");
  command
      ->add_option("--silence-seconds", arguments->silence_seconds,
                   "a rank that says nothing for longer is given up")
      ->capture_default_str();
  command
      ->add_option("--hang-seconds", arguments->hang_seconds,
                   "a query that takes longer is ended and counted as a hang")
      ->capture_default_str();
  command
      ->add_option("--shrink-seconds", arguments->shrink_seconds,
                   "shrink the first finding of each engine and kind for so long; 0: not")
      ->capture_default_str();
  command
      ->add_option("--maxima-every", arguments->rates.maxima,
                   "phase maxima at one query in so many; 0: never")
      ->capture_default_str();
  command
      ->add_option("--construct-every", arguments->rates.construct,
                   "M built whole at one small query in so many; 0: never")
      ->capture_default_str();
  command
      ->add_option("--values-every", arguments->rates.values,
                   "distance and depth of engines at one query in so many; 0: never")
      ->capture_default_str();
  command->add_option("--report", arguments->report,
                      "instead: the stability report of the campaign in this folder");
  command->add_flag("--markdown", arguments->markdown, "the report's tables as Markdown");
  command->add_flag("--coverage", arguments->coverage,
                    "print every combination hit; fail where a complete run hit one fewer than "
                    "1000 times");
  command->add_flag("--json", arguments->json, "print JSON");
  command->footer(
      "Exit code 1 when a proven search has a finding; those of others are counted, not an error.");
  command->callback([arguments, &exit_code] { exit_code = RunFuzz(*arguments); });
}

}  // namespace touchstone
