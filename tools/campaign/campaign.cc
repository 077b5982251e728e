// SPDX-License-Identifier: MIT
#include "touchstone/tools/campaign/campaign.h"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <limits>
#include <map>
#include <optional>
#include <string>

namespace touchstone {
namespace {

using Clock = std::chrono::steady_clock;

// Seconds that a batch is charged in advance where suites share time.
constexpr double kCharge = 0.2;
// How often signals and time are looked at.
constexpr double kPatience = 0.1;

class Campaign {
 public:
  Campaign(const CampaignPlan& plan, const CampaignLimits& limits, CampaignStore& store,
           Workers& workers)
      : plan_(plan), limits_(limits), store_(store), workers_(workers) {
    for (const Suite* suite : plan.suites) {
      const std::string name(suite->name());
      done_.push_back(store.Done(name));
      next_block_.push_back(0);
      seconds_.push_back(store.SecondsOf(name));
    }
    for (const auto& blocks : done_) {
      for (const auto& [block, end] : blocks) {
        if (limits.count > 0)
          indices_ += std::min(end, limits.count) - std::min(block * kBatchIndices, limits.count);
      }
    }
    first_index_ = indices_;
  }

  CampaignEnd Run(const std::function<void(const CampaignProgress&)>& report) {
    const std::int64_t started = std::time(nullptr);
    std::optional<CampaignEnd> end;
    while (!end || workers_.Running() > 0) {
      if (!end) end = HandOut();
      Save(workers_.Collect(kPatience));
      if (report) report(Progress());
    }
    store_.AddRun(started, Seconds(), batches_, queries_);
    return *end;
  }

 private:
  double Seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  std::optional<CampaignEnd> HandOut() {
    while (workers_.Free() > 0) {
      if (limits_.stop != nullptr && *limits_.stop) return CampaignEnd::kStopped;
      if (limits_.minutes > 0.0 && Seconds() >= 60.0 * limits_.minutes)
        return CampaignEnd::kTimeIsUp;
      const std::optional<Batch> batch = Next();
      if (!batch) return CampaignEnd::kComplete;
      workers_.Give(*batch);
    }
    if (limits_.stop != nullptr && *limits_.stop) return CampaignEnd::kStopped;
    return std::nullopt;
  }

  std::optional<Batch> Next() {
    if (limits_.count == 0) {
      const auto least = std::min_element(seconds_.begin(), seconds_.end());
      *least += kCharge;
      return NextOf(static_cast<std::size_t>(least - seconds_.begin()));
    }
    for (std::size_t tries = 0; tries < plan_.suites.size(); ++tries) {
      if (const auto batch = NextOf(turn_++ % plan_.suites.size())) return batch;
    }
    return std::nullopt;
  }

  // The next part of a suite that is not done.
  std::optional<Batch> NextOf(std::size_t suite) {
    const std::uint64_t count =
        limits_.count > 0 ? limits_.count : std::numeric_limits<std::uint64_t>::max();
    while (true) {
      const std::uint64_t block = next_block_[suite];
      const std::uint64_t begin = block * kBatchIndices;
      if (begin >= count) return std::nullopt;
      ++next_block_[suite];
      const auto done = done_[suite].find(block);
      const std::uint64_t first = done == done_[suite].end() ? begin : done->second;
      const std::uint64_t end = std::min(begin + kBatchIndices, count);
      if (first < end) return Batch{suite, first, end};
    }
  }

  void Save(const std::vector<BatchResult>& results) {
    store_.Add(results, plan_);
    for (const BatchResult& result : results) {
      seconds_[result.batch.suite] += result.seconds - (limits_.count == 0 ? kCharge : 0.0);
      indices_ += result.batch.end - result.batch.first;
      findings_ += result.findings.size();
      ++batches_;
      for (const auto& [name, count] : result.tally) {
        if (name.ends_with("\tqueries")) queries_ += count;
      }
    }
  }

  CampaignProgress Progress() const {
    CampaignProgress progress;
    progress.queries = queries_;
    progress.findings = findings_;
    progress.seconds = Seconds();
    const double by_time =
        limits_.minutes > 0.0 ? progress.seconds / (60.0 * limits_.minutes) : 0.0;
    const double total =
        static_cast<double>(limits_.count) * static_cast<double>(plan_.suites.size());
    const double by_count = total > 0.0 ? static_cast<double>(indices_) / total : 0.0;
    progress.fraction = std::min(1.0, std::max(by_time, by_count));
    const double this_run = static_cast<double>(indices_ - first_index_);
    double left = limits_.minutes > 0.0 ? 60.0 * limits_.minutes - progress.seconds
                                        : std::numeric_limits<double>::infinity();
    if (total > 0.0 && this_run > 0.0) {
      left = std::min(left, progress.seconds * (total - static_cast<double>(indices_)) / this_run);
    }
    progress.seconds_left = std::max(0.0, left);
    return progress;
  }

  const CampaignPlan& plan_;
  const CampaignLimits& limits_;
  CampaignStore& store_;
  Workers& workers_;
  std::vector<std::map<std::uint64_t, std::uint64_t>> done_;  // by suite
  std::vector<std::uint64_t> next_block_;                     // by suite
  std::vector<double> seconds_;                               // by suite
  std::size_t turn_ = 0;
  std::uint64_t indices_ = 0, first_index_ = 0, queries_ = 0, findings_ = 0, batches_ = 0;
  Clock::time_point start_ = Clock::now();
};

}  // namespace

CampaignEnd RunCampaign(const CampaignPlan& plan, const CampaignLimits& limits,
                        CampaignStore& store, Workers& workers,
                        const std::function<void(const CampaignProgress&)>& report) {
  return Campaign(plan, limits, store, workers).Run(report);
}

}  // namespace touchstone
