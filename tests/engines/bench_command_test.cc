// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "touchstone/tests/tools/program.h"
#include "touchstone/tools/engines/registry.h"

namespace touchstone {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// The smallest run that goes through all modes.
const std::string kTiny =
    "bench convex --quick -n 20 --orientations 3 --repeats 3 --pairs 40 --motions 1 ";

TEST(BenchConvex, JsonIsAnArrayOfRowsWithTheKeysOfTheContract) {
  const ProgramRun run = RunProgram(kTiny + "--json");
  EXPECT_EQ(run.exit_code, 0) << run.err << run.out;
  const nlohmann::json json = run.json();
  ASSERT_TRUE(json.is_array());
  std::set<std::string> engines, modes;
  std::set<double> gaps;
  for (const nlohmann::json& row : json) {
    std::set<std::string> keys;
    for (const auto& [key, value] : row.items()) keys.insert(key);
    EXPECT_EQ(keys, (std::set<std::string>{"engine", "shape", "n", "gap", "mode", "median_ns",
                                           "queries", "wrong", "undecided"}));
    EXPECT_EQ(row["n"], 20);
    EXPECT_GT(row["median_ns"].get<double>(), 0.0);
    EXPECT_GT(row["queries"].get<int>(), 0);
    EXPECT_LE(row["wrong"].get<int>() + row["undecided"].get<int>(), row["queries"].get<int>());
    if (row["engine"] == "portal") {
      EXPECT_EQ(row["wrong"], 0);
      EXPECT_EQ(row["undecided"], 0);
    }
    engines.insert(row["engine"].get<std::string>());
    modes.insert(row["mode"].get<std::string>());
    gaps.insert(row["gap"].get<double>());
  }
  EXPECT_EQ(modes, (std::set<std::string>{"repeat", "mixed", "warm"}));
  EXPECT_EQ(gaps, (std::set<double>{-5.0, -1e-6, 1e-6, 5.0}));
  std::set<std::string> available;
  for (const EngineDescription& engine : AllEngines()) {
    if (engine.unavailable.empty() && !engine.single_precision && !engine.quadratic)
      available.insert(engine.name);
  }
  EXPECT_EQ(engines, available);
  EXPECT_EQ(json.size(), engines.size() * modes.size() * gaps.size());
}

TEST(BenchConvex, TheSeedAloneDecidesWhatIsAsked) {
  const auto answers = [](const std::string& arguments) {
    nlohmann::json json =
        RunProgram(kTiny + "--json --engines published,portal " + arguments).json();
    for (nlohmann::json& row : json) row.erase("median_ns");
    return json;
  };
  EXPECT_EQ(answers("--seed 3"), answers("--seed 3"));
}

TEST(BenchConvex, OptionsChooseAndTheCsvHasEveryMode) {
  const TemporaryFolder folder("bench");
  const ProgramRun run = RunProgram(kTiny +
                                    "--engines portal,enhanced-gjk --shapes prism,grid --gaps -2,2 "
                                    "--modes repeat,warm-1deg --csv " +
                                    folder.path("rows.csv"));
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out,
              AllOf(HasSubstr("prism, n = 20, repeat"), HasSubstr("grid, n = 20, warm-1deg")));
  const std::string csv = folder.Read("rows.csv");
  EXPECT_THAT(csv,
              testing::StartsWith("engine,shape,n,gap,mode,median_ns,queries,wrong,undecided\n"));
  // Head, and 2 engines x 2 shapes x 2 gaps x 2 modes.
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 17);
  EXPECT_THAT(csv, HasSubstr("\nenhanced-gjk,grid,20,2,warm-1deg,"));
}

TEST(BenchConvex, BadUsageIsOneLineAndCodeTwo) {
  const auto refused = [](const std::string& arguments, const std::string& text) {
    const ProgramRun run = RunProgram("bench convex " + arguments);
    EXPECT_EQ(run.exit_code, 2) << arguments;
    EXPECT_THAT(run.err, HasSubstr(text)) << arguments;
    EXPECT_THAT(run.out, IsEmpty()) << arguments;
  };
  refused("--engines nothing", "no engine 'nothing'");
  refused("--shapes cube", "'cube' is none of");
  refused("--shapes ellipsoid--1", "'ellipsoid--1' is none of");
  refused("--shapes mesh", "--meshes");
  refused("--modes tepid", "'tepid' is none of");
  refused("-n 3", "from 4");
  refused("--gaps nan", "finite");
  refused("--repeats -1", "not negative");
  refused("--csv /nonexistent/rows.csv", "cannot be written");
}

TEST(BenchSupport, JsonHasEveryMethodAndOnlyTheLookMayBeLower) {
  const ProgramRun run = RunProgram("bench support --quick --json");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  std::set<std::string> methods;
  for (const nlohmann::json& row : run.json()) {
    const std::string method = row["method"].get<std::string>();
    methods.insert(method);
    EXPECT_GT(row["independent_ns"].get<double>(), 0.0);
    EXPECT_GT(row["dependent_ns"].get<double>(), 0.0);
    if (method != "table, one look") {
      EXPECT_EQ(row["lower"], 0.0) << method;
    }
  }
  EXPECT_EQ(methods.size(), 7u);
}

TEST(BenchFigures, WritesTheNumbersOfEveryFigure) {
  const TemporaryFolder folder("figures");
  const ProgramRun run = RunProgram(
      "bench figures --quick --orientations 2 --engines portal,enhanced-gjk " + folder.path("out"));
  // Without matplotlib the numbers are there all the same.
  if (run.exit_code != 0) {
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_THAT(run.err, HasSubstr("matplotlib"));
  }
  const auto starts = [&](const std::string& file, const std::string& head) {
    EXPECT_THAT(folder.Read("out/" + file), testing::StartsWith(head)) << file;
  };
  starts("figure8.csv", "engine,shape,n,gap,mode,median_ns,");
  starts("figure9.csv", "engine,shape,n,gap,mode,median_ns,");
  starts("figure10.csv", "n,gap,set-up,first-face,SEARCH-FV,SEARCH-VF,SEARCH-EE\n1000,-100,");
  starts("error-verdicts.csv",
         "engine,tolerance,is_best,shape,n,gap,median_ns,queries,wrong,undecided\nportal,,1,");
  starts("error-values.csv", "engine,tolerance,quantity,");
  if (run.exit_code == 0) {
    for (const std::string name :
         {"figure8", "figure9", "figure10", "error-verdicts", "error-gaps", "error-values"}) {
      EXPECT_THAT(folder.Read("out/" + name + ".svg"), HasSubstr("</svg>")) << name;
    }
  }
}

TEST(EnginesCommand, ListsEveryEngine) {
  const ProgramRun run = RunProgram("engines");
  EXPECT_EQ(run.exit_code, 0);
  for (const EngineDescription& engine : AllEngines()) EXPECT_THAT(run.out, HasSubstr(engine.name));
}

}  // namespace
}  // namespace touchstone
