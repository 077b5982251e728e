// SPDX-License-Identifier: MIT
//
// `touchstone minkowski` and `touchstone membership`, driven as a user would.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "touchstone/tests/tools/program.h"

namespace touchstone {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

constexpr const char* kCube =
    "OFF\n8 6 0\n"
    "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
    "4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";

// The same without its last side.
constexpr const char* kOpenCube =
    "OFF\n8 5 0\n"
    "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
    "4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n";

// Two tetrahedra, the second a needle through the first.
constexpr const char* kCrossing =
    "OFF\n8 8 0\n"
    "0 0 0\n4 0 0\n0 4 0\n0 0 4\n-2 1 1\n6 0.9 0.9\n6 1.2 0.9\n6 0.9 1.2\n"
    "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n3 5 6 7\n3 4 6 5\n3 4 7 6\n3 4 5 7\n";

class MeshCommands : public ::testing::Test {
 protected:
  // Bad input: exit code 2, nothing on stdout, and one line on stderr that holds all of `texts`.
  template <class... Texts>
  void ExpectRefused(const std::string& arguments, const Texts&... texts) {
    const ProgramRun run = RunProgram(arguments);
    EXPECT_EQ(run.exit_code, 2) << arguments << "\n" << run.err;
    EXPECT_THAT(run.out, IsEmpty()) << arguments;
    EXPECT_THAT(run.err, AllOf(HasSubstr(texts)...)) << arguments;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << arguments << "\n" << run.err;
  }

  TemporaryFolder folder{"minkowski"};
  std::string cube = folder.Write("cube.off", kCube);
};

TEST_F(MeshCommands, CubeAndCube) {
  const std::string out = folder.path("sum.off");
  const ProgramRun run =
      RunProgram("minkowski " + cube + ' ' + cube + " --out " + out + " --judge --json");
  ASSERT_EQ(run.exit_code, 0) << run.out << run.err;
  const auto json = run.json();
  EXPECT_GE(json["triangles"], 12);
  EXPECT_EQ(json["components"], 1);
  EXPECT_GT(json["seconds"], 0.0);
  EXPECT_THAT(json["findings"], IsEmpty());
  EXPECT_EQ(json["euler_characteristics"][0], 2);
  EXPECT_EQ(json["sheets"], 0);
  EXPECT_EQ(json["judge"]["enumerated"], true);
  EXPECT_EQ(json["judge"]["constructed"], true);
  EXPECT_THAT(folder.Read("sum.off"), StartsWith("OFF\n"));
  // What was written is a body: it is read, and its sum with the cube is [-2, 2]^3 again.
  const ProgramRun again = RunProgram("minkowski " + out + ' ' + cube + " --judge --json");
  ASSERT_EQ(again.exit_code, 0) << again.out << again.err;
  const ProgramRun text = RunProgram("minkowski " + cube + ' ' + cube + " --judge");
  EXPECT_EQ(text.exit_code, 0);
  EXPECT_THAT(text.out, AllOf(HasSubstr("components       1, Euler characteristics 2"),
                              HasSubstr("0 findings"), HasSubstr("Nef")));
}

TEST_F(MeshCommands, ShapesPosesAndSlots) {
  const ProgramRun slot = RunProgram("minkowski shape:u shape:key --judge --json");
  ASSERT_EQ(slot.exit_code, 0) << slot.out << slot.err;
  EXPECT_GT(slot.json()["sheets"], 0);
  const ProgramRun turned = RunProgram(
      "minkowski shape:torus:128 shape:star --pose 0 -1 0 0.5 1 0 0 0.25 0 0 1 2 --judge --json");
  ASSERT_EQ(turned.exit_code, 0) << turned.out << turned.err;
  EXPECT_THAT(turned.json()["findings"], IsEmpty());
  EXPECT_EQ(turned.json()["judge"]["constructed"], false);
}

// Off degenerate poses, where several names fit a point, every builder leaves the same surface to
// the byte.
TEST_F(MeshCommands, LocalSumsByEveryBuilder) {
  const std::string out = folder.path("local.off"), csv = folder.path("frames.csv");
  std::set<std::string> surfaces;
  for (const std::string builder : {"full", "brute-force", "sphere-hierarchy", "gap-filling"}) {
    const ProgramRun run = RunProgram(
        "minkowski shape:torus:128 shape:star --ball 0 0 4 4" + (" --builder " + builder) +
        " --frames 5 --turn 7 --axis 1 2 3 --out " + out + " --csv " + csv + " --judge --json");
    ASSERT_EQ(run.exit_code, 0) << run.out << run.err;
    const auto json = run.json();
    EXPECT_EQ(json["builder"], builder);
    EXPECT_GT(json["triangles"], 0);
    EXPECT_EQ(json["frames"], 5);
    EXPECT_EQ(json["judge"]["segments"], 100);
    EXPECT_EQ(json["judge"]["refuted"], 0);
    const std::string rows = folder.Read("frames.csv");
    EXPECT_THAT(rows, StartsWith("frame,milliseconds,triangles,cells,facets,new,kept,dropped,"));
    EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), 6);
    surfaces.insert(folder.Read("local.off"));
  }
  EXPECT_EQ(surfaces.size(), 1u);
  EXPECT_THAT(*surfaces.begin(), StartsWith("OFF\n"));
}

TEST_F(MeshCommands, MembershipAnswersAndIsJudged) {
  const std::string pair = "membership shape:slot shape:key ";
  for (const auto& [at, answer] : {std::pair("2 1 2", "touch"), std::pair("2.25 1 2", "overlap"),
                                   std::pair("2 1 8", "separate")}) {
    const ProgramRun run = RunProgram(pair + "--judge --json --at " + at);
    ASSERT_EQ(run.exit_code, 0) << run.out << run.err;
    EXPECT_EQ(run.json()["answer"], answer);
    EXPECT_EQ(run.json()["judge"]["answer"], answer);
    EXPECT_TRUE(run.json().contains("tier"));
    EXPECT_GE(run.json()["microseconds"], 0.0);
  }
  const ProgramRun unsure = RunProgram(pair + "--certainty float --json --at 2 1 2");
  EXPECT_EQ(unsure.json()["answer"], "undecided");
  EXPECT_EQ(unsure.json()["tier"], "none");
}

TEST_F(MeshCommands, BadArgumentsAreRefused) {
  const std::string open = folder.Write("open.off", kOpenCube);
  const std::string crossing = folder.Write("crossing.off", kCrossing);
  for (const std::string command : {"minkowski ", "membership --at 0 0 0 -- "}) {
    ExpectRefused(command + folder.path("none.off") + ' ' + cube, "none.off");
    ExpectRefused(command + open + ' ' + cube, "open.off", "edge");
    ExpectRefused(command + cube + " shape:teapot", "shape:teapot", "unknown shape");
    ExpectRefused(command + cube + " shape:torus:x", "no number of faces");
  }
  ExpectRefused("minkowski " + crossing + ' ' + cube, "crossing.off", "faces ", "meet");
  ExpectRefused("minkowski " + cube + ' ' + cube + " --pose 1 2 3", "takes 12 numbers");
  ExpectRefused("minkowski " + cube + ' ' + cube + " --pose 1 0 0 0 0 1 0 0 0 0 -1 0", "--pose: ");
  ExpectRefused("minkowski " + cube + ' ' + cube + " --out " + folder.path("no/such.off"),
                "cannot be written");
  ExpectRefused("membership " + cube + ' ' + cube + " --at 0 0 x", "'x' is not a finite number");
  ExpectRefused("membership " + cube + ' ' + cube + " --at 0 0 inf", "is not a finite number");
  ExpectRefused("membership " + cube + ' ' + cube, "--at");
  ExpectRefused("minkowski " + cube, "B is required");
  const std::string pair = "minkowski " + cube + ' ' + cube;
  ExpectRefused(pair + " --frames 3", "--frames requires --ball");
  ExpectRefused(pair + " --ball 0 0 nan 1", "is not a finite number");
  ExpectRefused(pair + " --ball 0 0 0 -1", "radius is negative");
  ExpectRefused(pair + " --ball 0 0 0 1 --builder any", "'any' is none of");
}

TEST(VerifyMembership, PiecesAddUp) {
  const auto run = [](const std::string& range) {
    const ProgramRun result = RunProgram("verify --membership --json " + range);
    EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
    return result.json();
  };
  const auto whole = run("--count 700"), first = run("--count 300"),
             second = run("--first 300 --count 400");
  std::set<std::string> seen;
  for (int p = 0; p < 3; ++p) {
    for (const std::string key :
         {"placements", "separate", "touch", "overlap", "wrong", "undecided", "wrong_in_doubles"}) {
      EXPECT_EQ(whole["results"][p][key].get<int>(),
                first["results"][p][key].get<int>() + second["results"][p][key].get<int>());
      if (whole["results"][p][key] > 0) seen.insert(key);
    }
  }
  EXPECT_EQ(seen.count("wrong"), 0u);
  EXPECT_EQ(seen.count("touch"), 1u);
  EXPECT_EQ(seen.count("undecided"), 1u);
}

// Of the whole campaign every so many a few: all shapes come up.
TEST(VerifyBoundary, CasesAreWithoutFindings) {
  int cases = 0, aligned = 0, thin = 0, enumerated = 0;
  for (int first = 0; first < 361; first += 19) {
    const ProgramRun run =
        RunProgram("verify --boundary --json --count 3 --first " + std::to_string(first));
    ASSERT_EQ(run.exit_code, 0) << run.out << run.err;
    const auto json = run.json();
    ASSERT_EQ(json["results"].size(), 3u);
    for (const auto& row : json["results"]) {
      EXPECT_EQ(row["findings"], 0);
      EXPECT_TRUE(row["samples"].empty());
      cases += row["cases"].get<int>();
      thin += row["with_thin_parts"].get<int>();
      enumerated += row["enumerated"].get<int>();
      if (row["turned"] == "aligned") aligned += row["cases"].get<int>();
    }
  }
  EXPECT_EQ(cases, 3 * 19);
  EXPECT_GT(aligned, 5);
  EXPECT_GT(thin, 0);
  EXPECT_GT(enumerated, 0);
}

TEST(VerifyBoundary, RefusesMinutes) {
  const ProgramRun run = RunProgram("verify --boundary --minutes 1");
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("--boundary takes a --count"));
}

}  // namespace
}  // namespace touchstone
