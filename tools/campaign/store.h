// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_CAMPAIGN_STORE_H_
#define TOUCHSTONE_TOOLS_CAMPAIGN_STORE_H_

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "touchstone/tools/campaign/plan.h"

struct sqlite3;
struct sqlite3_stmt;

namespace touchstone {

// A finding as it is kept.
struct StoredFinding {
  std::string engine, suite;
  std::uint64_t index = 0;
  std::string kind, detail;
  std::string case_file;  // of the shrunk query, beside the data base; empty: none
};

// What a campaign has found so far, in DIR/campaign.sqlite:
//
//   plan(key, value)                                  what is asked; another plan is refused
//   run(started, seconds, batches, queries)           one row a run of the command
//   batch(suite, first, last, seconds, queries, wrong, unresolved, findings)   one row a batch
//   tally(engine, suite, key, count)                  what is counted (campaign/contestant.h)
//   finding(engine, suite, idx, kind, detail, case_file)                      one row a finding
//
// Batches are transactions: whatever ends the program, each is there whole or not at all, and the
// tallies are the sums over those that are. One process at a time adds to it: a job that was killed
// may store for a moment longer than its successor takes to start, which then waits for it. Throws
// BadInput, naming the file, where the data base cannot be opened, belongs to another plan, or is
// worked on by somebody else for longer than that.
class CampaignStore {
 public:
  // Creates folder and data base where they are missing.
  CampaignStore(const std::string& folder, const CampaignPlan& plan);
  // Of any plan, to be read.
  explicit CampaignStore(const std::string& folder);
  ~CampaignStore();
  CampaignStore(const CampaignStore&) = delete;
  CampaignStore& operator=(const CampaignStore&) = delete;

  // One transaction.
  void Add(std::span<const BatchResult> results, const CampaignPlan& plan);
  void AddRun(std::int64_t started, double seconds, std::uint64_t batches, std::uint64_t queries);

  // How far each block of kBatchIndices indices of a suite is done, by the block's number.
  std::map<std::uint64_t, std::uint64_t> Done(const std::string& suite) const;
  double SecondsOf(const std::string& suite) const;
  // Counts by suite, in the order of the plan.
  std::vector<std::pair<std::string, Tally>> Tallies() const;
  // The first findings of each engine, suite and kind, at most `each`.
  std::vector<StoredFinding> FirstFindings(int each) const;
  void NameCase(const StoredFinding& finding, const std::string& case_file);
  // A line of the plan; empty where there is none.
  std::string PlanValue(const std::string& key) const;

 private:
  void Open(const std::string& folder, bool create);
  void Run(const std::string& sql) const;
  // Binds, steps and calls `row` for each row.
  using Row = std::function<void(sqlite3_stmt*)>;
  void Query(const std::string& sql, const std::vector<std::string>& values, const Row& row) const;

  // Held while it lives.
  class Lock;

  std::unique_ptr<Lock> lock_;  // of who may add
  std::string path_;
  sqlite3* db_ = nullptr;
};

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_CAMPAIGN_STORE_H_
