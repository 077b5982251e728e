// SPDX-License-Identifier: MIT
#include "touchstone/tools/campaign/plan.h"

#include <ctime>
#include <exception>

namespace touchstone {
namespace {

// Of this process: other processes' load does not count.
double ProcessorSeconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

bool IsWrongVerdict(const std::string& kind) {
  return kind == "wrong_verdict" || kind == "unexpected_verdict" || kind == "missed_overlap" ||
         kind == "missed_touch" || kind == "false_overlap" || kind.ends_with("_called_touch");
}

}  // namespace

class BatchRunner::Impl {
 public:
  explicit Impl(const CampaignPlan& plan)
      : plan_(plan), contestants_(MakeContestants(plan.engines)), tallies_(contestants_.size()) {}

  BatchResult Run(const Batch& batch, std::span<const FatalQuery> fatal, const SayPosition& say) {
    const double start = ProcessorSeconds();
    BatchResult result;
    result.batch = batch;
    const Suite& suite = *plan_.suites[batch.suite];
    for (std::uint64_t index = batch.first; index < batch.end; ++index) {
      say(index, -1);
      if (const FatalQuery* ended = Find(fatal, index, -1)) {
        Add("judge", index, {ended->kind, ended->detail}, result);
        ++result.tally["judge\tfindings"];
        ++result.tally["judge\tfinding " + ended->kind];
        continue;
      }
      RunIndex(suite, index, fatal, say, result);
    }
    for (std::size_t c = 0; c < contestants_.size(); ++c)
      tallies_[c].MoveTo(result.tally, contestants_[c]->name());
    result.seconds = ProcessorSeconds() - start;
    return result;
  }

 private:
  static const FatalQuery* Find(std::span<const FatalQuery> fatal, std::uint64_t index,
                                int contestant) {
    for (const FatalQuery& query : fatal) {
      if (query.index == index && query.contestant == contestant) return &query;
    }
    return nullptr;
  }

  static void Add(const std::string& engine, std::uint64_t index, const NamedFinding& finding,
                  BatchResult& result) {
    result.findings.push_back({engine, index, finding.kind, finding.detail});
  }

  void RunIndex(const Suite& suite, std::uint64_t index, std::span<const FatalQuery> fatal,
                const SayPosition& say, BatchResult& result) {
    const PlacedPair pair = suite.Generate(plan_.seed, index);
    const CampaignQuery query(pair, index, plan_.rates, bodies_);
    // The truth is the judge's, and no contestant's crash.
    for (std::size_t c = 0; c < contestants_.size(); ++c) {
      if (NeedsTruth(*contestants_[c])) {
        query.truth();
        break;
      }
    }
    for (std::size_t c = 0; c < contestants_.size(); ++c) {
      say(index, static_cast<int>(c));
      std::vector<NamedFinding> findings;
      if (const FatalQuery* ended = Find(fatal, index, static_cast<int>(c))) {
        findings.push_back({ended->kind, ended->detail});
      } else {
        findings = AskOne(*contestants_[c], query, tallies_[c]);
      }
      Count(findings, tallies_[c]);
      for (const NamedFinding& finding : findings)
        Add(contestants_[c]->name(), index, finding, result);
    }
  }

  static bool NeedsTruth(const Contestant& contestant) {
    return MakeJudgedSearch(contestant.name()) == nullptr && contestant.name() != "corrupted";
  }

  static std::vector<NamedFinding> AskOne(Contestant& contestant, const CampaignQuery& query,
                                          EngineTally& tally) {
    try {
      return contestant.Ask(query, tally);
    } catch (const std::exception& error) {
      return {{"exception", error.what()}};
    }
  }

  static void Count(const std::vector<NamedFinding>& findings, EngineTally& tally) {
    tally.Count(keys::kQueries);
    bool wrong = false;
    for (const NamedFinding& finding : findings) {
      tally.Count(keys::kFindings);
      tally.Count(std::string(keys::kFinding) + finding.kind);
      wrong |= IsWrongVerdict(finding.kind);
    }
    if (wrong) tally.Count(keys::kWrong);
  }

  const CampaignPlan& plan_;
  std::vector<std::unique_ptr<Contestant>> contestants_;
  std::vector<EngineTally> tallies_;
  ExactBodies bodies_;
};

BatchRunner::BatchRunner(const CampaignPlan& plan) : impl_(std::make_unique<Impl>(plan)) {}
BatchRunner::~BatchRunner() = default;

BatchResult BatchRunner::Run(const Batch& batch, std::span<const FatalQuery> fatal,
                             const SayPosition& say) {
  return impl_->Run(batch, fatal, say);
}

}  // namespace touchstone
