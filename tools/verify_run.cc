// SPDX-License-Identifier: MIT
#include "touchstone/tools/verify_run.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <exception>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "touchstone/tools/case_file.h"

namespace touchstone {
namespace {

using Clock = std::chrono::steady_clock;

// Consecutive indices share shapes: a batch is one thread's.
constexpr std::uint64_t kBatch = 80;
// Case files for one suite, search and kind of finding.
constexpr int kMaxCases = 3;
// Bodies up to this product of vertex counts have their phase maxima checked at every query; larger
// ones at one query in 16, since that check takes O(mn).
constexpr long kAlwaysMaxima = 2500;
// Bodies up to this product are also judged in the construction tier, at one query in 16; M by
// exact hull takes milliseconds.
constexpr long kConstruct = 400;
constexpr std::uint64_t kSample = 16;

double SecondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

template <class Map>
void AddCounts(Map& into, const Map& from) {
  for (const auto& [key, count] : from) into[key] += count;
}

struct Batch {
  std::size_t suite;
  std::uint64_t begin, end;
};

// Hands out batches and collects what became of them.
class Scheduler {
 public:
  explicit Scheduler(const VerifyOptions& options)
      : options_(options),
        next_(options.suites.size(), options.first),
        seconds_(options.suites.size(), 0.0) {
    for (const Suite* suite : options.suites) {
      stats_.push_back(
          {std::string(suite->name()), std::vector<SearchStats>(options.searches.size())});
    }
  }

  std::optional<Batch> Take() {
    const std::lock_guard lock(mutex_);
    return options_.count > 0 ? TakeByCount() : TakeByTime();
  }

  void Return(const Batch& batch, double seconds, double expected,
              const std::vector<SearchStats>& stats) {
    const std::lock_guard lock(mutex_);
    seconds_[batch.suite] += seconds - expected;
    for (std::size_t s = 0; s < stats.size(); ++s) {
      SearchStats& total = stats_[batch.suite].by_search[s];
      total.Merge(stats[s]);
      queries_ += stats[s].queries;
      findings_ += stats[s].FindingCount();
    }
    done_ += batch.end - batch.begin;
  }

  Progress GetProgress() {
    const std::lock_guard lock(mutex_);
    const double fraction =
        options_.count > 0 ? static_cast<double>(done_) / (static_cast<double>(options_.count) *
                                                           static_cast<double>(stats_.size()))
                           : SecondsSince(start_) / (60.0 * options_.minutes);
    return {std::min(1.0, fraction), queries_, findings_};
  }

  // Seconds that a batch is charged in advance, so that threads spread over suites.
  static constexpr double kCharge = 0.05;

  std::vector<SuiteStats> TakeStats() { return std::move(stats_); }

  // Whether a further case file of this kind is wanted; counts it.
  bool WantsCase(const std::string& kind_of_case) {
    const std::lock_guard lock(mutex_);
    return cases_[kind_of_case]++ < kMaxCases;
  }

 private:
  std::optional<Batch> TakeByCount() {
    for (std::size_t tries = 0; tries < next_.size(); ++tries) {
      const std::size_t suite = turn_++ % next_.size();
      const std::uint64_t end = options_.first + options_.count;
      if (next_[suite] < end) return TakeFrom(suite, std::min(end, next_[suite] + kBatch));
    }
    return std::nullopt;
  }

  std::optional<Batch> TakeByTime() {
    if (SecondsSince(start_) >= 60.0 * options_.minutes) return std::nullopt;
    const auto least = std::min_element(seconds_.begin(), seconds_.end());
    const auto suite = static_cast<std::size_t>(least - seconds_.begin());
    *least += kCharge;
    return TakeFrom(suite, next_[suite] + kBatch);
  }

  Batch TakeFrom(std::size_t suite, std::uint64_t end) {
    return {suite, std::exchange(next_[suite], end), end};
  }

  const VerifyOptions& options_;
  std::mutex mutex_;
  std::vector<std::uint64_t> next_;  // by suite: the next index
  std::vector<double> seconds_;      // by suite: time spent
  std::size_t turn_ = 0;
  std::uint64_t done_ = 0, queries_ = 0, findings_ = 0;
  std::map<std::string, int> cases_;
  std::vector<SuiteStats> stats_;
  Clock::time_point start_ = Clock::now();
};

class Worker {
 public:
  Worker(const VerifyOptions& options, Scheduler& scheduler)
      : options_(options), scheduler_(scheduler) {}

  void Run() {
    const double charge = options_.count > 0 ? 0.0 : Scheduler::kCharge;
    while (const std::optional<Batch> batch = scheduler_.Take()) {
      const Clock::time_point start = Clock::now();
      std::vector<SearchStats> stats(options_.searches.size());
      for (std::uint64_t index = batch->begin; index < batch->end; ++index) {
        RunPair(*options_.suites[batch->suite], index, stats);
      }
      scheduler_.Return(*batch, SecondsSince(start), charge, stats);
    }
  }

 private:
  void RunPair(const Suite& suite, std::uint64_t index, std::vector<SearchStats>& stats) {
    const PlacedPair pair = suite.Generate(options_.seed, index);
    for (std::size_t s = 0; s < stats.size(); ++s)
      RunQuery(suite, index, pair, options_.searches[s], stats[s]);
  }

  bool AsksEarlyExit(Search search, std::uint64_t index) const {
    switch (options_.early_exit) {
      case EarlyExit::kNever:
        return false;
      case EarlyExit::kAlways:
        return true;
      // The quarter moves along with the rounds of placements, which have 20 steps.
      case EarlyExit::kMixed:
        return search != Search::kPublished && (index + index / 20) % 4 == 3;
    }
    return false;
  }

  JudgeDepth DepthOf(std::uint64_t index, const PlacedPair& pair) const {
    switch (options_.depth) {
      case Depth::kProof:
        return {.phase_maxima = false, .construct = false, .twin = false, .warm = true};
      case Depth::kPhases:
        return {.phase_maxima = true, .construct = false, .twin = false, .warm = true};
      case Depth::kFull:
        return {.phase_maxima = true, .construct = true, .twin = true, .warm = true};
      case Depth::kMixed:
        break;
    }
    const long product = static_cast<long>(pair.p.vertex_count()) * pair.q.vertex_count();
    // Moves along with the rounds of placements as well.
    const std::uint64_t draw = (index + index / 20) % kSample;
    return {.phase_maxima = product <= kAlwaysMaxima || draw == 0,
            .construct = product <= kConstruct && draw == 1,
            .twin = product <= kAlwaysMaxima || draw == 2,
            .warm = index % 2 == 0};
  }

  void RunQuery(const Suite& suite, std::uint64_t index, const PlacedPair& pair, Search search,
                SearchStats& stats) {
    const CollideOptions options{.search = search,
                                 .certainty = options_.certainty,
                                 .early_exit = AsksEarlyExit(search, index),
                                 .trace = false};
    const JudgeDepth depth = DepthOf(index, pair);
    JudgedQuery query;
    try {
      query = AskAndJudge(pair, options, depth, bodies_);
    } catch (const std::exception& error) {
      query.findings.push_back({"exception", error.what()});
    }
    Count(pair, options, depth, query, stats);
    for (const NamedFinding& finding : query.findings)
      WriteCaseFile(suite, index, pair, options, finding);
  }

  static void Count(const PlacedPair& pair, const CollideOptions& options, const JudgeDepth& depth,
                    const JudgedQuery& query, SearchStats& stats) {
    const CollideResult& result = query.result;
    ++stats.queries;
    ++stats.verdicts[static_cast<std::size_t>(result.verdict)];
    ++stats.tiers[static_cast<std::size_t>(result.tier)];
    stats.n_at_least_100 += std::max(pair.p.vertex_count(), pair.q.vertex_count()) >= 100;
    stats.early_exits_asked += options.early_exit;
    stats.phase_maxima_checked += depth.phase_maxima;
    stats.constructed += depth.construct;
    stats.twin_runs += query.twin_ran;
    stats.search_ns.Add(query.search_ns);
    stats.judge_seconds += query.judge_ns * 1e-9;
    for (const NamedFinding& finding : query.findings) ++stats.findings[finding.kind];
    for (const NamedFinding& finding : query.rounding_findings)
      ++stats.rounding_findings[finding.kind];
    stats.failed_queries += !query.findings.empty();
    const std::string face_class =
        result.face ? std::string(ToString(result.face->face_class)) : "none";
    ++stats.coverage[{options.search, face_class, result.phase, result.verdict}];
  }

  void WriteCaseFile(const Suite& suite, std::uint64_t index, const PlacedPair& pair,
                     const CollideOptions& options, const NamedFinding& finding) {
    if (options_.cases_dir.empty()) return;
    const std::string kind = std::string(suite.name()) + "-" +
                             std::string(ToString(options.search)) + "-" + finding.kind;
    if (!scheduler_.WantsCase(kind)) return;
    const auto path =
        std::filesystem::path(options_.cases_dir) /
        (kind + "-" + std::to_string(options_.seed) + "-" + std::to_string(index) + ".case");
    std::ofstream out(path);
    WriteCase(out, {std::string(suite.name()), options_.seed, index, options.search,
                    options.certainty, options.early_exit, finding.kind, finding.detail, pair});
  }

  const VerifyOptions& options_;
  Scheduler& scheduler_;
  ExactBodies bodies_;
};

}  // namespace

void DurationHistogram::Add(double nanoseconds) {
  const auto value = static_cast<std::uint64_t>(std::max(0.0, nanoseconds));
  const int octave =
      std::max(0, static_cast<int>(std::bit_width(value)) - 7);  // value >> octave is below 128
  const std::size_t bin = static_cast<std::size_t>(octave) * 64 + (value >> octave);
  ++bins_[std::min(bin, bins_.size() - 1)];
  ++total_;
}

void DurationHistogram::Merge(const DurationHistogram& other) {
  for (std::size_t i = 0; i < bins_.size(); ++i) bins_[i] += other.bins_[i];
  total_ += other.total_;
}

double DurationHistogram::Median() const {
  std::uint64_t below = 0;
  for (std::size_t bin = 0; bin < bins_.size(); ++bin) {
    below += bins_[bin];
    if (2 * below < total_ || total_ == 0) continue;
    const std::size_t octave = bin < 128 ? 0 : bin / 64 - 1;
    const double low = std::ldexp(static_cast<double>(bin - 64 * octave), static_cast<int>(octave));
    return low + std::ldexp(0.5, static_cast<int>(octave));
  }
  return 0.0;
}

void SearchStats::Merge(const SearchStats& other) {
  queries += other.queries;
  for (std::size_t i = 0; i < verdicts.size(); ++i) verdicts[i] += other.verdicts[i];
  for (std::size_t i = 0; i < tiers.size(); ++i) tiers[i] += other.tiers[i];
  AddCounts(findings, other.findings);
  AddCounts(rounding_findings, other.rounding_findings);
  failed_queries += other.failed_queries;
  n_at_least_100 += other.n_at_least_100;
  early_exits_asked += other.early_exits_asked;
  phase_maxima_checked += other.phase_maxima_checked;
  constructed += other.constructed;
  twin_runs += other.twin_runs;
  search_ns.Merge(other.search_ns);
  judge_seconds += other.judge_seconds;
  AddCounts(coverage, other.coverage);
}

std::uint64_t SearchStats::FindingCount() const {
  std::uint64_t count = 0;
  for (const auto& [kind, n] : findings) count += n;
  return count;
}

std::vector<SuiteStats> RunVerify(const VerifyOptions& options,
                                  const std::function<void(const Progress&)>& report) {
  Scheduler scheduler(options);
  std::mutex mutex;
  std::condition_variable ended;
  int running = options.threads;
  std::vector<std::thread> threads;
  for (int i = 0; i < options.threads; ++i) {
    threads.emplace_back([&] {
      Worker(options, scheduler).Run();
      const std::lock_guard lock(mutex);
      --running;
      ended.notify_one();
    });
  }
  {
    std::unique_lock lock(mutex);
    while (!ended.wait_for(lock, std::chrono::milliseconds(250), [&] { return running == 0; })) {
      if (report) report(scheduler.GetProgress());
    }
  }
  for (std::thread& thread : threads) thread.join();
  return scheduler.TakeStats();
}

}  // namespace touchstone
