// SPDX-License-Identifier: MIT
#include "touchstone/tools/campaign/campaign.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>

#include "touchstone/tests/tools/program.h"
#include "touchstone/tools/bad_input.h"
#include "touchstone/tools/campaign/report.h"
#include "touchstone/tools/suites/registry.h"
#include "touchstone/tools/suites/shapes.h"

namespace touchstone {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// Two boxes; at one index the process ends, at another it never answers.
class DeadlySuite : public Suite {
 public:
  std::string_view name() const override { return "deadly"; }
  std::string_view summary() const override { return "ends its process"; }
  std::string_view attacks() const override { return "the watch over workers"; }
  PlacedPair Generate(std::uint64_t, std::uint64_t index) const override {
    if (index == 7) std::abort();
    if (index == 11) {
      for (;;) pause();
    }
    return {BoxBody({1, 1, 1}), BoxBody({1, 1, 1}), RelativePose()};
  }
};

std::vector<std::string> Described(const CampaignStore& store) {
  std::vector<std::string> lines;
  for (const StoredFinding& finding : store.FirstFindings(100)) {
    lines.push_back(finding.engine + ' ' + finding.suite + ' ' + std::to_string(finding.index) +
                    ' ' + finding.kind);
  }
  return lines;
}

TEST(Campaign, CrashesAndHangsAreFindingsAndNothingElseIsLost) {
  const TemporaryFolder folder("campaign");
  const DeadlySuite suite;
  const CampaignPlan plan{.suites = {&suite}, .engines = {"portal"}, .seed = 1, .rates = {}};
  CampaignStore store(folder.path("out"), plan);
  const std::unique_ptr<Workers> workers = MakeLocalWorkers(plan, 2, 0.5);
  EXPECT_EQ(RunCampaign(plan, {.count = 20}, store, *workers, nullptr), CampaignEnd::kComplete);
  EXPECT_THAT(Described(store), ElementsAre("judge deadly 7 crash", "judge deadly 11 hang"));
  const CampaignTotals totals(store);
  EXPECT_EQ(totals.Of("portal", keys::kQueries), 18u);
  EXPECT_EQ(totals.Of("portal", keys::kFindings), 0u);
  EXPECT_EQ(totals.ProvenFindings(), 2u);
}

TEST(Campaign, AnotherPlanIsRefusedAndACountMayGrow) {
  const TemporaryFolder folder("campaign");
  const std::vector<std::unique_ptr<Suite>> all = MakeSuites("");
  CampaignPlan plan{.suites = {all[6].get()}, .engines = {"portal"}, .seed = 3, .rates = {}};
  {
    CampaignStore store(folder.path("out"), plan);
    const auto workers = MakeLocalWorkers(plan, 1, 20.0);
    // Not at the end of a batch.
    RunCampaign(plan, {.count = 100}, store, *workers, nullptr);
    RunCampaign(plan, {.count = 1000}, store, *workers, nullptr);
    RunCampaign(plan, {.count = 900}, store, *workers, nullptr);
    EXPECT_EQ(CampaignTotals(store).Of("portal", keys::kQueries), 1000u);
  }
  // Suites may be added, and none taken away.
  plan.suites.push_back(all[7].get());
  {
    CampaignStore store(folder.path("out"), plan);
    const auto workers = MakeLocalWorkers(plan, 1, 20.0);
    RunCampaign(plan, {.count = 1000}, store, *workers, nullptr);
    EXPECT_EQ(CampaignTotals(store).Of("portal", keys::kQueries), 2000u);
  }
  plan.suites.pop_back();
  EXPECT_THROW(CampaignStore(folder.path("out"), plan), BadInput);
  plan.suites.push_back(all[7].get());
  plan.seed = 4;
  try {
    const CampaignStore other(folder.path("out"), plan);
    FAIL() << "another seed was taken";
  } catch (const BadInput& bad) {
    EXPECT_THAT(bad.message, HasSubstr("its seed is '3', not '4'"));
  }
  EXPECT_THROW(CampaignStore(folder.path("none")), BadInput);
  folder.Write("campaign.sqlite", "not a data base, but long enough to be looked at as one....");
  EXPECT_THROW(CampaignStore(folder.path("")), BadInput);
}

// Every split of the indices gives the same tally, bit for bit.
TEST(Campaign, TheSplitIntoBatchesChangesNoTotal) {
  const std::vector<std::unique_ptr<Suite>> all = MakeSuites("");
  for (const std::unique_ptr<Suite>& suite : all) {
    if (!suite->unavailable().empty() || suite->name() == "large") continue;
    const CampaignPlan plan{
        .suites = {suite.get()}, .engines = {"portal", "phased"}, .seed = 5, .rates = {}};
    const SayPosition silent = [](std::uint64_t, int) {};
    BatchRunner whole(plan), parts(plan);
    Tally sum;
    for (const auto& [first, end] : {std::pair{70, 160}, {0, 33}, {33, 70}}) {
      Merge(sum, parts
                     .Run({0, static_cast<std::uint64_t>(first), static_cast<std::uint64_t>(end)},
                          {}, silent)
                     .tally);
    }
    EXPECT_EQ(sum, whole.Run({0, 0, 160}, {}, silent).tally) << suite->name();
  }
}

TEST(Campaign, TheJudgeSeesWhatIsPlanted) {
  const std::vector<std::unique_ptr<Suite>> all = MakeSuites("");
  Tally sum;
  for (const std::unique_ptr<Suite>& suite : all) {
    if (!suite->unavailable().empty()) continue;
    const CampaignPlan plan{
        .suites = {suite.get()}, .engines = {"corrupted"}, .seed = 6, .rates = {}};
    Merge(sum, BatchRunner(plan).Run({0, 0, 240}, {}, [](std::uint64_t, int) {}).tally);
  }
  EXPECT_EQ(sum.count("corrupted\tfindings"), 0u);
  int kinds = 0;
  for (const auto& [key, count] : sum) {
    if (!key.starts_with("corrupted\tplanted ")) continue;
    EXPECT_GE(count, 10u) << key;
    ++kinds;
  }
  EXPECT_EQ(kinds, 18);
}

TEST(Campaign, BatchesSurviveTheWayThroughAPipe) {
  BatchResult result;
  result.batch = {3, 960, 1920};
  result.seconds = 0.1;
  result.tally = {{"portal\tqueries", 960}, {"fcl-own:default\tfinding crash", 2}};
  result.findings = {{"fcl-own:default", 961, "crash", "one line\nand\ttabs"}};
  const BatchResult read = BatchResultFromText(ToText(result));
  EXPECT_EQ(read.batch, result.batch);
  EXPECT_EQ(read.seconds, result.seconds);
  EXPECT_EQ(read.tally, result.tally);
  ASSERT_EQ(read.findings.size(), 1u);
  EXPECT_EQ(read.findings[0].detail, "one line and tabs");
}

}  // namespace
}  // namespace touchstone
