// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_CAMPAIGN_BATCH_H_
#define TOUCHSTONE_TOOLS_CAMPAIGN_BATCH_H_

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace touchstone {

// Consecutive indices of one suite: what is handed out, repeated after a crash, and stored whole or
// not at all. A multiple of every suite's period of shapes (80, 64, 60, 40), so that shapes are
// made once; the split of a campaign into batches changes no total.
inline constexpr std::uint64_t kBatchIndices = 960;

struct Batch {
  std::size_t suite = 0;  // in the plan's list
  std::uint64_t first = 0, end = 0;
  friend auto operator<=>(const Batch&, const Batch&) = default;
};

// A query that ended a worker: it is not asked again, and counts as a finding.
struct FatalQuery {
  std::uint64_t index = 0;
  int contestant = -1;  // in the plan's list; -1: the suite or the judge
  std::string kind;     // "crash" or "hang"
  std::string detail;
};

// Counts by what is counted: an engine's name, a tab, and a key (campaign/keys.h).
using Tally = std::map<std::string, std::uint64_t, std::less<>>;

void Merge(Tally& into, const Tally& from);

struct CampaignFinding {
  std::string engine;
  std::uint64_t index = 0;
  std::string kind, detail;  // one line each
};

// What became of a batch. All of it but the time is a function of plan and batch alone.
struct BatchResult {
  Batch batch;
  double seconds = 0.0;  // of a processor
  Tally tally;
  std::vector<CampaignFinding> findings;
};

// As text, for pipes and ranks.
std::string ToText(const BatchResult& result);
// Requires what ToText wrote.
BatchResult BatchResultFromText(std::string_view text);
std::string ToText(const Batch& batch, const std::vector<FatalQuery>& fatal);
void FromText(std::string_view text, Batch& batch, std::vector<FatalQuery>& fatal);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_CAMPAIGN_BATCH_H_
