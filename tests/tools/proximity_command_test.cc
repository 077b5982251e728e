// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

#include "touchstone/tests/tools/program.h"

namespace touchstone {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr std::string_view kCubeOff =
    "OFF\n8 6 0\n"
    "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
    "4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";

class ProximityCommands : public testing::Test {
 protected:
  std::string Cubes(const std::string& x, const std::string& y, const std::string& z) const {
    return cube + " " + cube + " --pose 1 0 0 " + x + " 0 1 0 " + y + " 0 0 1 " + z;
  }

  TemporaryFolder folder{"proximity"};
  std::string cube = folder.Write("cube.off", kCubeOff);
};

TEST_F(ProximityCommands, DistanceIsJudged) {
  const ProgramRun apart = RunProgram("distance " + Cubes("4", "5", "0.5") + " --judge --json");
  ASSERT_EQ(apart.exit_code, 0) << apart.out << apart.err;
  EXPECT_EQ(apart.json()["kind"], "separate");
  EXPECT_NEAR(apart.json()["distance"]["value"], 5.0, 1e-14);
  EXPECT_LE(apart.json()["lower"], apart.json()["upper"]);
  EXPECT_EQ(apart.json()["feature_p"]["kind"], "edge");
  EXPECT_EQ(apart.json()["optimal"], true);
  EXPECT_THAT(apart.json()["judge"]["findings"], IsEmpty());
  EXPECT_EQ(apart.json()["judge"]["constructed"], true);
  const ProgramRun meet = RunProgram("distance " + Cubes("1", "0.25", "0.5") + " --judge --json");
  EXPECT_EQ(meet.exit_code, 0);
  EXPECT_EQ(meet.json()["kind"], "meet");
  EXPECT_EQ(meet.json()["distance"]["value"], 0.0);
  EXPECT_EQ(meet.json()["certificate"]["kind"], "touching_facet");
  const ProgramRun text = RunProgram("distance " + Cubes("3", "0.25", "0.5") + " --judge");
  EXPECT_THAT(text.out, HasSubstr("distance         2 +- "));
  EXPECT_THAT(text.out, HasSubstr("proven nearest"));
  EXPECT_THAT(text.out, HasSubstr("judge            no findings; M was built whole, too"));
}

TEST_F(ProximityCommands, DepthIsJudged) {
  const ProgramRun deep =
      RunProgram("depth " + Cubes("0.75", "0.5", "0.125") + " --judge --certificate --json");
  ASSERT_EQ(deep.exit_code, 0) << deep.out << deep.err;
  EXPECT_EQ(deep.json()["verdict"], "overlap");
  EXPECT_NEAR(deep.json()["depth"]["value"], 0.25, 1e-14);
  EXPECT_NEAR(deep.json()["translation"][0], 0.25, 1e-14);
  EXPECT_EQ(deep.json()["facet"]["class"], "FaceFace");
  EXPECT_EQ(deep.json()["minimal"], true);
  EXPECT_GE(deep.json()["inner_polytope"].size(), 4u);
  EXPECT_THAT(deep.json()["judge"]["findings"], IsEmpty());
  EXPECT_EQ(RunProgram("depth " + Cubes("1", "0.5", "0.125") + " --json").json()["verdict"],
            "touch");
  const ProgramRun apart = RunProgram("depth " + Cubes("2", "0.5", "0.125") + " --judge");
  EXPECT_EQ(apart.exit_code, 0);
  EXPECT_THAT(apart.out, HasSubstr("verdict          separate"));
}

TEST_F(ProximityCommands, DirectionIsJudged) {
  const std::string bodies = Cubes("3", "0.5", "0.125");
  const ProgramRun meets =
      RunProgram("direction " + bodies + " --along -2 0 0 --judge --json --published");
  ASSERT_EQ(meets.exit_code, 0) << meets.out << meets.err;
  EXPECT_EQ(meets.json()["kind"], "interval");
  EXPECT_EQ(meets.json()["enter"]["travel"]["value"], 1.0);
  EXPECT_EQ(meets.json()["leave"]["travel"]["value"], 2.0);
  EXPECT_EQ(meets.json()["enter"]["facet"]["class"], "FaceFace");
  EXPECT_EQ(meets.json()["grazing"], false);
  EXPECT_THAT(meets.json()["judge"]["findings"], IsEmpty());
  EXPECT_EQ(meets.json()["published"]["kind"], "travel");
  EXPECT_EQ(meets.json()["published"]["weights"].size(), 3u);
  EXPECT_THAT(meets.json()["published"]["findings"], IsEmpty());
  const ProgramRun never = RunProgram("direction " + bodies + " --along 0 0 1 --judge --json");
  EXPECT_EQ(never.exit_code, 0);
  EXPECT_EQ(never.json()["kind"], "never");
  EXPECT_EQ(never.json()["separator"].size(), 2u);
  const ProgramRun grazing =
      RunProgram("direction " + Cubes("3", "1", "0") + " --along -1 0 0 --judge");
  EXPECT_EQ(grazing.exit_code, 0);
  EXPECT_THAT(grazing.out, HasSubstr("interval, grazing"));
}

TEST_F(ProximityCommands, BadArgumentsAreRefused) {
  const auto refused = [](const std::string& arguments, const std::string& text) {
    const ProgramRun run = RunProgram(arguments);
    EXPECT_EQ(run.exit_code, 2) << arguments;
    EXPECT_THAT(run.err, HasSubstr(text)) << arguments;
    EXPECT_THAT(run.out, IsEmpty()) << arguments;
  };
  refused("direction " + Cubes("3", "0", "0") + " --along 0 0 0", "--along: ");
  refused("direction " + Cubes("3", "0", "0") + " --along 1 2", "takes 3 numbers, not 2");
  refused("direction " + Cubes("3", "0", "0") + " --along 1 2 x", "'x' is not a number");
  refused("direction " + Cubes("3", "0", "0"), "--along");
  refused("distance " + cube + " " + cube + " --pose 1 2 3", "takes 12 numbers");
  refused("depth " + cube + " " + folder.path("missing.off"), "missing.off");
  refused("depth " + Cubes("3", "0", "0") + " --certainty sure", "none of float, exact");
}

// Every suite, every query, counts that do not depend on the threads.
TEST(VerifyProximity, AllSuitesWithoutFindings) {
  const ProgramRun run = RunProgram("verify --proximity --count 24 --threads 2 --json");
  ASSERT_EQ(run.exit_code, 0) << run.out.substr(0, 4000) << run.err;
  const auto json = run.json();
  EXPECT_EQ(json["total"]["findings"], 0);
  std::set<std::string> suites, queries, answers;
  for (const auto& result : json["results"]) {
    suites.insert(result["suite"]);
    queries.insert(result["query"]);
    EXPECT_EQ(result["seed"], 1);
    EXPECT_GT(result["queries"], 0);
    for (const auto& [answer, count] : result["answers"].items())
      answers.insert(std::string(result["query"]) + " " + answer);
  }
  EXPECT_GE(suites.size(), 14u);
  EXPECT_EQ(queries.size(), 6u);
  for (const char* answer :
       {"distance separate", "distance meet", "depth overlap", "depth touch", "depth separate",
        "travel interval", "travel never", "travel grazing", "published travel"}) {
    EXPECT_TRUE(answers.contains(answer)) << answer;
  }
  auto alone = RunProgram("verify --proximity --count 24 --threads 1 --json").json();
  auto both = json;
  for (auto* side : {&alone, &both}) {
    for (auto& result : (*side)["results"]) {
      result.erase("median_ns");
      result.erase("judged_per_second");
    }
  }
  EXPECT_EQ(alone, both);
  const ProgramRun text =
      RunProgram("verify --proximity --suite tetrahedra --count 40 --certainty float");
  EXPECT_EQ(text.exit_code, 0) << text.out;
  EXPECT_THAT(text.out, HasSubstr("judged 200 queries: 0 findings"));
}

}  // namespace
}  // namespace touchstone
