// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>

#include "touchstone/tests/tools/program.h"

namespace touchstone {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

TEST(VerifyCommand, JsonHasTheKeysOfEverySuiteAndSearch) {
  const ProgramRun run = RunProgram("verify --suite tetrahedra --count 160 --seed 3 --json");
  EXPECT_EQ(run.exit_code, 0) << run.err << run.out;
  EXPECT_THAT(run.err, IsEmpty());  // no progress bar where there is no terminal
  const nlohmann::json json = run.json();
  ASSERT_EQ(json["results"].size(), 3u);
  std::set<std::string> searches;
  for (const nlohmann::json& row : json["results"]) {
    for (const std::string key :
         {"suite", "search", "seed", "queries", "separate", "touch", "overlap", "undecided",
          "findings", "exact_fallbacks", "median_ns", "judged_per_second"}) {
      EXPECT_TRUE(row.contains(key)) << key;
    }
    searches.insert(row["search"].get<std::string>());
    EXPECT_EQ(row["suite"], "tetrahedra");
    EXPECT_EQ(row["seed"], 3);
    EXPECT_EQ(row["queries"], 160);
    EXPECT_EQ(row["separate"].get<int>() + row["touch"].get<int>() + row["overlap"].get<int>(),
              160);
    EXPECT_EQ(row["undecided"], 0);
    EXPECT_TRUE(row["findings"].is_object());
    EXPECT_GT(row["median_ns"].get<double>(), 0.0);
    EXPECT_GT(row["judged_per_second"].get<double>(), 0.0);
  }
  EXPECT_EQ(searches, (std::set<std::string>{"published", "phased", "portal"}));
  for (const std::string& search : searches) {
    EXPECT_EQ(json["coverage"][search]["queries"], 160);
    EXPECT_THAT(json["coverage"][search]["combinations"], Not(IsEmpty()));
  }
  EXPECT_EQ(json["total"]["queries"], 480);
}

// Totals must not depend on how work was spread, or a campaign could not be repeated.
TEST(VerifyCommand, ThreadsDoNotChangeTheTotals) {
  const auto totals = [](const std::string& threads) {
    nlohmann::json json =
        RunProgram("verify --suite boxes-edge --count 300 --json --threads " + threads).json();
    for (nlohmann::json& row : json["results"]) {
      row.erase("median_ns");
      row.erase("judged_per_second");
    }
    return json;
  };
  EXPECT_EQ(totals("1"), totals("3"));
}

TEST(VerifyCommand, TextEndsWithTheClosingLine) {
  const ProgramRun run = RunProgram("verify --suite reported --count 27 --coverage");
  EXPECT_EQ(run.exit_code, 0) << run.out;
  EXPECT_THAT(run.out, AllOf(HasSubstr("reported"), HasSubstr("exact touches"),
                             ContainsRegex("judged 81 queries: 0 findings in the proven searches, "
                                           "[0-9]+ in the published one\n$")));
}

TEST(VerifyCommand, MinutesBoundTheTime) {
  const ProgramRun run =
      RunProgram("verify --minutes 0.02 --suite boxes-face --search portal --json");
  EXPECT_EQ(run.exit_code, 0) << run.out;
  EXPECT_GT(run.json()["total"]["queries"].get<int>(), 0);
}

TEST(VerifyCommand, FailuresOfThePublishedSearchBecomeCasesThatReplay) {
  const TemporaryFolder folder("cases");
  // The family whose ties alone defeat the paper's arc test (and whose elongation defeats theorem
  // 1).
  const ProgramRun run =
      RunProgram("verify --suite ellipsoid-10 --search published --count 400 --json --cases " +
                 folder.path("cases"));
  EXPECT_EQ(run.exit_code, 0);  // counted, not an error
  ASSERT_GT(run.json()["total"]["published_findings"].get<int>(), 0);
  int replayed = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path("cases"))) {
    const ProgramRun replay = RunProgram("replay " + entry.path().string() + " --json");
    EXPECT_EQ(replay.exit_code, 1) << entry.path() << replay.err;
    const nlohmann::json json = replay.json();
    EXPECT_EQ(json["suite"], "ellipsoid-10");
    const std::string recorded = json["recorded_finding"].get<std::string>();
    bool found = false;
    for (const nlohmann::json& finding : json["findings"]) found |= finding["kind"] == recorded;
    EXPECT_TRUE(found) << recorded;
    // The repaired searches answer the same query without a finding.
    EXPECT_EQ(RunProgram("replay " + entry.path().string() + " --search portal").exit_code, 0);
    EXPECT_EQ(RunProgram("replay " + entry.path().string() + " --search phased").exit_code, 0);
    ++replayed;
  }
  EXPECT_GT(replayed, 0);
}

TEST(VerifyCommand, BadUsageIsOneLineAndCodeTwo) {
  const auto refused = [](const std::string& arguments, const std::string& text) {
    const ProgramRun run = RunProgram(arguments);
    EXPECT_EQ(run.exit_code, 2) << arguments;
    EXPECT_THAT(run.err, HasSubstr(text)) << arguments;
  };
  refused("verify --suite nothing", "no suite 'nothing'");
  refused("verify --search fastest", "'fastest' is none of");
  refused("verify --suite meshes", "--meshes");
  refused("verify --meshes /nonexistent", "not a folder");
  refused("verify --count many", "count");
  refused("verify --minutes -1", "minutes");
  refused("verify --early-exit often", "'often' is none of");
  refused("verify --depth shallow", "'shallow' is none of");
  refused("replay /nonexistent.case", "cannot be opened");
}

TEST(SuitesCommand, ListsEverySuite) {
  const ProgramRun text = RunProgram("suites");
  EXPECT_EQ(text.exit_code, 0);
  const nlohmann::json json = RunProgram("suites --json").json();
  std::set<std::string> names;
  for (const nlohmann::json& suite : json) {
    names.insert(suite["suite"].get<std::string>());
    EXPECT_THAT(text.out, HasSubstr(suite["suite"].get<std::string>()));
    EXPECT_FALSE(suite["summary"].get<std::string>().empty());
    EXPECT_FALSE(suite["attacks"].get<std::string>().empty());
  }
  EXPECT_EQ(names, (std::set<std::string>{"seldom",
                                          "ellipsoid-1",
                                          "ellipsoid-2",
                                          "ellipsoid-4",
                                          "ellipsoid-10",
                                          "ellipsoid-n20",
                                          "large",
                                          "grid",
                                          "boxes-face",
                                          "boxes-edge",
                                          "boxes-vertex",
                                          "prisms",
                                          "ties",
                                          "tetrahedra",
                                          "touch-face-vertex",
                                          "touch-vertex-face",
                                          "touch-edge-edge",
                                          "touch-face-edge",
                                          "touch-edge-face",
                                          "touch-face-face",
                                          "slivers",
                                          "far",
                                          "scales",
                                          "near-coplanar",
                                          "near-duplicates",
                                          "off-orthonormal",
                                          "nested",
                                          "world-poses",
                                          "reported",
                                          "meshes"}));
}

}  // namespace
}  // namespace touchstone
