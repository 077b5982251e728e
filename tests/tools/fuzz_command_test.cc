// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <thread>

#include "touchstone/tests/tools/program.h"
#include "touchstone/tools/bad_input.h"
#include "touchstone/tools/campaign/store.h"

namespace touchstone {
namespace {

using ::testing::HasSubstr;

// Everything but how the run ended.
nlohmann::json Totals(const ProgramRun& run) {
  nlohmann::json json = run.json();
  json.erase("end");
  return json;
}

// Two suites of twenty batches.
constexpr const char* kCommand =
    "fuzz --suites grid,ties --engines portal,phased --count 9600 --json ";

// How many batches the campaign in `folder` has stored.
std::size_t Stored(const std::string& folder) {
  try {
    const CampaignStore store(folder);
    return store.Done("grid").size() + store.Done("ties").size();
  } catch (const BadInput&) {
    return 0;  // not there yet
  }
}

// Returns when the campaign has stored `batches`, or `run` has ended.
void AwaitBatches(const std::string& folder, std::size_t batches, Background& run) {
  while (!run.has_ended() && Stored(folder) < batches)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
}

TEST(FuzzCommand, CountsByEngineAndSuite) {
  const TemporaryFolder folder("fuzz");
  const ProgramRun run = RunProgram(
      "fuzz --suites boxes-face,far --engines portal,fcl-own,bullet-f32:held --count 240 --json "
      "--out " +
      folder.path("a"));
  EXPECT_EQ(run.exit_code, 0) << run.err;  // findings of others are counted, not an error
  const nlohmann::json json = run.json();
  ASSERT_EQ(json["results"].size(), 6u);
  for (const nlohmann::json& row : json["results"]) {
    for (const char* key : {"engine", "suite", "queries", "wrong", "unresolved", "findings"})
      EXPECT_TRUE(row.contains(key)) << key;
    EXPECT_EQ(row["queries"], 240);
    if (row["engine"] == "portal") {
      EXPECT_EQ(row["findings"], 0);
    }
  }
  EXPECT_EQ(json["total"]["queries"], 6 * 240);
  EXPECT_GT(json["total"]["wrong"], 0);
  EXPECT_EQ(json["total"]["proven_findings"], 0);
}

TEST(FuzzCommand, KilledStoppedAndSplitItEndsWithTheSameTotals) {
  const TemporaryFolder folder("fuzz");
  const ProgramRun whole =
      RunProgram(std::string(kCommand) + "--threads 1 --out " + folder.path("whole"));
  ASSERT_EQ(whole.exit_code, 0) << whole.err;
  // Killed for good and asked to stop, again and again, each time a little later.
  const std::string out = folder.path("pieces");
  const std::string command = std::string(kCommand) + "--threads 2 --out " + out;
  for (int i = 0; i < 6; ++i) {
    Background run(TOUCHSTONE_PROGRAM + (" " + command) + " >/dev/null 2>&1");
    AwaitBatches(out, Stored(out) + 1, run);
    ASSERT_FALSE(run.has_ended());
    run.Signal(i % 2 == 0 ? SIGKILL : SIGTERM);
    EXPECT_EQ(run.Wait(), i % 2 == 0 ? 128 + SIGKILL : 0);
  }
  const ProgramRun last = RunProgram(command);
  EXPECT_EQ(last.exit_code, 0) << last.err;
  EXPECT_EQ(last.json()["end"], "complete");
  EXPECT_TRUE(Totals(last) == Totals(whole));
  // Nothing left to do: the same again.
  EXPECT_TRUE(Totals(RunProgram(command)) == Totals(whole));
}

TEST(FuzzCommand, MinutesEndIt) {
  const TemporaryFolder folder("fuzz");
  const ProgramRun run = RunProgram(
      "fuzz --suites tetrahedra --engines portal --minutes 0.01 --json --out " + folder.path("a"));
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.json()["end"].get<std::string>(), HasSubstr("time is up"));
  EXPECT_GT(run.json()["total"]["queries"], 0);
}

// Ranks on one machine: more of them than processors, and as root.
class OnRanks : public testing::TestWithParam<int> {};
TEST_P(OnRanks, TheTotalsAreThoseOfOneProcess) {
  const std::string mpiexec = TOUCHSTONE_MPIEXEC;
  if (mpiexec.empty()) GTEST_SKIP() << "configured without MPI";
  const TemporaryFolder folder("fuzz");
  const ProgramRun whole =
      RunProgram(std::string(kCommand) + "--threads 1 --out " + folder.path("whole"));
  ASSERT_EQ(whole.exit_code, 0) << whole.err;
  const std::string launch = "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 " +
                             mpiexec + " --timeout 300 --oversubscribe -n " +
                             std::to_string(GetParam()) + ' ' + TOUCHSTONE_PROGRAM + ' ' +
                             kCommand + "--threads 1 --out " + folder.path("ranks");
  // A job that is killed on the way loses nothing.
  {
    Background job("env " + launch + " >/dev/null 2>&1");
    AwaitBatches(folder.path("ranks"), 3, job);
    ASSERT_FALSE(job.has_ended());
    job.Signal(SIGKILL);
    job.Wait();
  }
  const std::string out = folder.path("out.json");
  const std::string err = folder.path("err");
  EXPECT_EQ(std::system((launch + " >" + out + " 2>" + err).c_str()), 0) << folder.Read("err");
  nlohmann::json json = nlohmann::json::parse(folder.Read("out.json"));
  EXPECT_EQ(json["end"], "complete");
  json.erase("end");
  EXPECT_TRUE(json == Totals(whole));
}
INSTANTIATE_TEST_SUITE_P(Few, OnRanks, testing::Values(2, 4));

// Kills rank 2 of the job whose command line names `out`; the worker that it has forked goes with
// it.
std::string KillRankTwo(const std::string& out) {
  const std::string is_rank_two = "xF OMPI_COMM_WORLD_RANK=2 ";
  return "for e in $(grep -lz" + is_rank_two + "/proc/[0-9]*/environ 2>/dev/null); do " +
         "  d=${e%/environ}; grep -qzxF -e '" + out + "' $d/cmdline || continue; " +
         "  up=$(sed -n 's/^PPid:[^0-9]*//p' $d/status); " + "  grep -qz" + is_rank_two +
         "/proc/$up/environ || { kill -KILL ${d#/proc/} && echo killed; }; done";
}

// By default Open MPI ends the job with the rank; with --enable-recovery the others do its work.
// Either way the totals at the end are those of one process.
TEST(FuzzCommand, ALostRankLosesNothing) {
  const std::string mpiexec = TOUCHSTONE_MPIEXEC;
  if (mpiexec.empty()) GTEST_SKIP() << "configured without MPI";
  const TemporaryFolder folder("fuzz");
  const std::string command =
      "fuzz --suites grid,ties --engines portal,phased --count 38400 --seed 5 --json "
      "--threads 1 ";
  const ProgramRun whole = RunProgram(command + "--out " + folder.path("whole"));
  ASSERT_EQ(whole.exit_code, 0) << whole.err;
  for (const std::string option : {"", "--enable-recovery "}) {
    const bool recovers = !option.empty();
    const std::string out = folder.path(recovers ? "recovered" : "ended");
    Background job("env OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 " + mpiexec +
                   " --timeout 300 --oversubscribe " + option + "-n 4 " + TOUCHSTONE_PROGRAM + ' ' +
                   command + "--silence-seconds 5 --out " + out + " > " + folder.path("json") +
                   " 2> " + folder.path("err"));
    AwaitBatches(out, 6, job);
    ASSERT_EQ(std::system((KillRankTwo(out) + " > " + folder.path("kills")).c_str()), 0);
    EXPECT_THAT(folder.Read("kills"), HasSubstr("killed"));
    EXPECT_EQ(job.Wait() == 0, recovers) << folder.Read("err");
    if (recovers) {
      EXPECT_EQ(nlohmann::json::parse(folder.Read("json"))["end"], "complete");
    }
    EXPECT_TRUE(Totals(RunProgram(command + "--out " + out)) == Totals(whole)) << option;
  }
}

// What other engines get wrong becomes a small case that shows the same.
TEST(FuzzCommand, FindingsAreShrunkToCasesThatReplay) {
  const TemporaryFolder folder("fuzz");
  const ProgramRun run = RunProgram(
      "fuzz --suites ellipsoid-4 --engines fcl-own --count 40 --threads 1 --shrink-seconds 4 "
      "--out " +
      folder.path("a"));
  EXPECT_EQ(run.exit_code, 0) << run.err;
  int cases = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path("a/cases"))) {
    const ProgramRun replay = RunProgram("replay --json " + entry.path().string());
    EXPECT_EQ(replay.exit_code, 1) << entry.path() << replay.err;
    const nlohmann::json json = replay.json();
    EXPECT_EQ(json["engine"], "fcl-own");
    EXPECT_EQ(json["recorded_finding"], json["findings"][0]["kind"]);
    ++cases;
  }
  EXPECT_GT(cases, 0);
}

TEST(FuzzCommand, BadUsageIsOneLineAndCodeTwo) {
  const TemporaryFolder folder("fuzz");
  const auto refused = [&](const std::string& arguments, const std::string& text) {
    const ProgramRun run = RunProgram("fuzz " + arguments);
    EXPECT_EQ(run.exit_code, 2) << arguments;
    EXPECT_THAT(run.err, HasSubstr(text)) << arguments;
  };
  const std::string out = "--out " + folder.path("a");
  refused("", "--out");
  refused("--suites nothing " + out, "no suite 'nothing'");
  refused("--suites meshes " + out, "--meshes");
  refused("--engines nobody " + out, "no engine 'nobody'");
  refused("--engines portal,portal " + out, "portal is named twice");
  refused("--minutes -1 " + out, "--minutes");
  refused("--hang-seconds 0 " + out, "--hang-seconds");
  refused("--out /proc/none", "--out: /proc/none");
}

}  // namespace
}  // namespace touchstone
