// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_CAMPAIGN_REPORT_H_
#define TOUCHSTONE_TOOLS_CAMPAIGN_REPORT_H_

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include "touchstone/tools/campaign/store.h"
#include "touchstone/tools/result_json.h"

namespace touchstone {

// What a campaign's data base adds up to.
class CampaignTotals {
 public:
  explicit CampaignTotals(const CampaignStore& store);

  struct Row {
    std::string engine, suite;
    std::uint64_t queries = 0, wrong = 0, unresolved = 0, findings = 0;
  };
  // One row an engine and suite, engines in the order of the plan.
  const std::vector<Row>& rows() const { return rows_; }
  const std::vector<std::string>& engines() const { return engines_; }
  // Counts by suite, in the order of the plan, by "engine key" with a tab between.
  const std::vector<std::pair<std::string, Tally>>& by_suite() const { return by_suite_; }
  // The sum over suites.
  std::uint64_t Of(const std::string& engine, std::string_view key) const;
  // Sums over suites of all keys of an engine that begin with `prefix`, less the prefix.
  Tally WithPrefix(const std::string& engine, std::string_view prefix) const;
  // Findings of those whose findings are bugs of this project.
  std::uint64_t ProvenFindings() const;

  // {"results": one object an engine and suite, "engines": sums and counts, "total": ...}.
  Json ToJson() const;
  void Print(std::ostream& out) const;

 private:
  std::vector<std::pair<std::string, Tally>> by_suite_;
  std::vector<std::string> engines_;
  std::vector<Row> rows_;
};

// How often each reachable combination is to be met.
inline constexpr std::uint64_t kCoverageFloor = 1000;

// What a campaign of the proven searches (portal and phased together, always exact) is to reach,
// and how far it has come: enough of everything, and nothing wrong.
struct CampaignTarget {
  std::string name;
  std::uint64_t have = 0, needed = 0;  // needed 0: none may be had
  bool met = false;
};
std::vector<CampaignTarget> FindTargets(const CampaignTotals& totals);
void PrintTargets(const std::vector<CampaignTarget>& targets, std::ostream& out);

// Combinations of class, phase, verdict, termination and tier that `engine` can reach
// (campaign/reachable.cc) and that were hit fewer than `floor` times, with their counts; and those
// that were hit though they are not listed. Empty for engines without a list.
struct CoverageGaps {
  std::vector<std::pair<std::string, std::uint64_t>> too_few, unlisted;
};
CoverageGaps FindCoverageGaps(const CampaignTotals& totals, const std::string& engine,
                              std::uint64_t floor);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_CAMPAIGN_REPORT_H_
