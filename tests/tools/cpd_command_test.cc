// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "touchstone/tests/tools/program.h"

namespace touchstone {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

TEST(CpdCommand, PairIsJudged) {
  const ProgramRun run = RunProgram(
      "cpd shape:torus:200 shape:star --pose 1 0 0 1.8 0 0.8 -0.6 0.1 0 0.6 0.8 0 --judge --json");
  ASSERT_EQ(run.exit_code, 0) << run.out << run.err;
  EXPECT_EQ(run.json()["depth"]["status"], "certain");
  EXPECT_LE(run.json()["depth"]["lower"], run.json()["depth"]["upper"]);
  EXPECT_GE(run.json()["cpd"]["magnitude"].get<double>(),
            run.json()["depth"]["lower"].get<double>() - 1e-9);
  EXPECT_GE(run.json()["contact_space"]["magnitude"].get<double>(),
            run.json()["depth"]["lower"].get<double>() - 1e-9);
  EXPECT_THAT(run.json()["judge"]["findings"], IsEmpty());
}

TEST(CpdCommand, SceneWritesCsvAndSvg) {
  const TemporaryFolder folder("cpd");
  const ProgramRun run =
      RunProgram("cpd --scene fish-torus --frames 4 --csv " + folder.path("out.csv") + " --svg " +
                 folder.path("out.svg") + " --json");
  ASSERT_EQ(run.exit_code, 0) << run.out << run.err;
  EXPECT_EQ(run.json()["frames"], 4);
  const std::string csv = folder.Read("out.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 5);
  EXPECT_THAT(csv, HasSubstr("cpd_x"));
  EXPECT_THAT(folder.Read("out.svg"), HasSubstr("</svg>"));
}

TEST(CpdCommand, BenchRows) {
  const ProgramRun run = RunProgram("bench cpd --quick --frames 3 --scene fish-torus --json");
  ASSERT_LE(run.exit_code, 1) << run.out << run.err;  // 1: an event was counted
  ASSERT_EQ(run.json().size(), 9u);
  for (const auto& row : run.json()) {
    for (const char* key :
         {"scene", "method", "median_ms", "p99_ms", "frames", "events", "jumps", "findings"}) {
      EXPECT_TRUE(row.contains(key)) << key;
    }
  }
}

TEST(CpdCommand, BenchProfile) {
  const ProgramRun one = RunProgram("bench cpd --profile --quick --scene fish-torus");
  ASSERT_EQ(one.exit_code, 0) << one.out << one.err;
  EXPECT_THAT(one.out, HasSubstr("fish-torus"));
  EXPECT_THAT(one.out, Not(HasSubstr("tori")));
  const ProgramRun all = RunProgram("bench cpd --profile --quick");
  ASSERT_EQ(all.exit_code, 0) << all.out << all.err;
  for (const char* word : {"cone-axes", "torus-torus", "contact body ms", "\n2000", "\n8000"}) {
    EXPECT_THAT(all.out, HasSubstr(word));
  }
}

TEST(CpdCommand, ContinuousDepthsAreJudged) {
  const ProgramRun run = RunProgram("verify --cpd --count 72 --seed 5 --json");
  ASSERT_EQ(run.exit_code, 0) << run.out << run.err;
  const nlohmann::json json = run.json();
  ASSERT_EQ(json["results"].size(), 6u);
  int found = 0;
  for (const auto& row : json["results"]) {
    EXPECT_EQ(row["placements"], 12);
    EXPECT_EQ(row["wrong"], 0);
    found += row["found"].get<int>();
  }
  EXPECT_GT(found, 36);
}

TEST(CpdCommand, EveryOptionOfNormals) {
  double depth = 0.0;
  for (const std::string word : {"angle", "area", "uniform", "interpolated", "mean"}) {
    const ProgramRun run = RunProgram(
        "cpd shape:torus:200 shape:star --pose 1 0 0 1.8 0 0.8 -0.6 0.1 0 0.6 0.8 0 --normals " +
        word + " --json");
    ASSERT_EQ(run.exit_code, 0) << word << run.out << run.err;
    EXPECT_EQ(run.json()["cpd"]["status"], "found") << word;
    depth = run.json()["depth"]["lower"];
    EXPECT_GE(run.json()["cpd"]["magnitude"].get<double>(), depth - 1e-9) << word;
  }
  EXPECT_GT(depth, 0.0);
  EXPECT_EQ(RunProgram("cpd shape:star shape:star --normals best").exit_code, 2);
}

TEST(CpdCommand, PremiseOfTheorem3) {
  const ProgramRun run = RunProgram("cpd --premise --scene cone-axes --json");
  ASSERT_EQ(run.exit_code, 0) << run.out << run.err;
  const nlohmann::json json = run.json();
  ASSERT_EQ(json.size(), 1u);
  const nlohmann::json& row = json[0];
  EXPECT_GT(row["triangles"].get<int>(), 1000);
  EXPECT_GT(row["solutions"].get<int>(), 10);
  EXPECT_GT(row["share_above_10"].get<double>(), 0.0);
  EXPECT_LE(row["share_above_10"].get<double>(), 1.0);
}

TEST(CpdCommand, VerifyMeshDepths) {
  const ProgramRun run = RunProgram("verify --mesh-depth --count 64 --seed 5 --json");
  EXPECT_EQ(run.exit_code, 0) << run.out << run.err;
  const nlohmann::json json = run.json();
  int placements = 0, wrong = 0;
  for (const nlohmann::json& row : json["results"]) {
    placements += row["placements"].get<int>();
    wrong += row["wrong"].get<int>();
    EXPECT_EQ(row["certain"], row["overlapping"]) << row;
  }
  EXPECT_EQ(placements, 64);
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(RunProgram("verify --nef").exit_code, 2);
}

TEST(CpdCommand, BadInputIsNamed) {
  const ProgramRun run = RunProgram("cpd --scene nowhere");
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("nowhere"));
  EXPECT_EQ(RunProgram("cpd").exit_code, 2);
}

}  // namespace
}  // namespace touchstone
