// SPDX-License-Identifier: MIT
//
// Our own searches, judged whole: verdict, certificate, face, values and counters at every query,
// the phase maxima and M built whole on samples.
#include <algorithm>
#include <cmath>

#include "touchstone/tools/campaign/contestant.h"

namespace touchstone {
namespace {

// Sizes up to which a query of the sample is looked at: the phase maxima of the largest bodies take
// seconds, M by exact hull takes milliseconds at this product.
constexpr long kLargestMaxima = 60'000;
constexpr long kLargestConstruct = 400;
// The gap that counts as close, over the size.
constexpr double kClose = 1e-12;

class JudgedSearch : public Contestant {
 public:
  JudgedSearch(const std::string& name, Search search, Certainty certainty)
      : Contestant(name, search != Search::kPublished), search_(search), certainty_(certainty) {}

  std::vector<NamedFinding> Ask(const CampaignQuery& query, EngineTally& tally) override {
    const PlacedPair& pair = query.pair();
    const bool proven_search = search_ != Search::kPublished;
    const CollideOptions options{
        .search = search_,
        .certainty = certainty_,
        .early_exit = proven_search && query.Sampled(query.rates().early_exit, 3)};
    const JudgeDepth depth = DepthOf(query);
    const JudgedQuery judged = AskAndJudge(pair, options, depth, query.bodies());
    Count(query, options, depth, judged, tally);
    return judged.findings;
  }

 private:
  // In runs of five, so that of the queries under early exit, which come in turn, some are among
  // them: only those take a verdict from the cache.
  static bool IsAskedWarm(const CampaignQuery& query) {
    const std::uint64_t rate = query.rates().warm;
    return rate > 0 && query.index() / 5 % rate == 0;
  }

  static JudgeDepth DepthOf(const CampaignQuery& query) {
    const PlacedPair& pair = query.pair();
    const long product = static_cast<long>(pair.p.vertex_count()) * pair.q.vertex_count();
    const SamplingRates& rates = query.rates();
    return {.phase_maxima = product <= kLargestMaxima && query.Sampled(rates.maxima, 0),
            .construct = product <= kLargestConstruct && query.Sampled(rates.construct, 1),
            .twin = query.Sampled(rates.maxima, 2),
            .warm = IsAskedWarm(query)};
  }

  void Count(const CampaignQuery& query, const CollideOptions& options, const JudgeDepth& depth,
             const JudgedQuery& judged, EngineTally& tally) const {
    const CollideResult& result = judged.result;
    const PlacedPair& pair = query.pair();
    const int n = std::max(pair.p.vertex_count(), pair.q.vertex_count());
    tally.CountCoverage(result);
    if (result.verdict == Verdict::kTouch) tally.Count("exact touch");
    if (result.verdict == Verdict::kUndecided) tally.Count(keys::kUnresolved);
    if (n >= 100) tally.Count("n >= 100");
    if (n >= 1000) tally.Count("n >= 1000");
    if (options.early_exit) tally.Count("early exit asked");
    if (depth.phase_maxima) tally.Count("phase maxima checked");
    if (depth.construct) tally.Count("constructed");
    if (depth.warm && search_ == Search::kPortal) tally.Count("asked warm");
    if (judged.twin_ran) tally.Count("replayed exactly");
    for (const NamedFinding& finding : judged.rounding_findings)
      tally.Count("in doubles only " + finding.kind);
    if (result.exit_travel) CountTravel(result.exit_travel->value / query.size(), judged, tally);
  }

  static void CountTravel(double travel, const JudgedQuery& judged, EngineTally& tally) {
    // The travel bounds the gap from above.
    if (std::fabs(travel) < kClose && judged.result.verdict != Verdict::kTouch)
      tally.Count("gap < 1e-12");
    const std::string travel_class = TravelClass(travel);
    tally.Count(std::string(keys::kTravel) + travel_class);
    const auto is_wrong = [](const NamedFinding& f) { return f.kind == "wrong_verdict"; };
    if (std::any_of(judged.findings.begin(), judged.findings.end(), is_wrong))
      tally.Count(std::string(keys::kWrongTravel) + travel_class);
  }

  Search search_;
  Certainty certainty_;
};

}  // namespace

std::unique_ptr<Contestant> MakeJudgedSearch(const std::string& name) {
  const auto make = [&](Search search, Certainty certainty) {
    return std::make_unique<JudgedSearch>(name, search, certainty);
  };
  if (name == "portal") return make(Search::kPortal, Certainty::kExact);
  if (name == "portal-float") return make(Search::kPortal, Certainty::kFloat);
  if (name == "phased") return make(Search::kPhased, Certainty::kExact);
  if (name == "published") return make(Search::kPublished, Certainty::kExact);
  return nullptr;
}

}  // namespace touchstone
