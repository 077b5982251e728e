// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "touchstone/tests/tools/program.h"

namespace touchstone {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr std::string_view kTwoCubes = R"({
  "shapes": {"cube": {"box": [1, 1, 1]}},
  "bodies": [
    {"name": "still", "shape": "cube"},
    {"name": "comer", "shape": "cube", "position": [4, 0.5, 0], "motion": {"velocity": [-0.5, 0, 0]},
     "subscriptions": {"distance": 1.0, "depth": true}}],
  "steps": 8})";

std::vector<std::string> Keys(const nlohmann::ordered_json& json) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : json.items()) keys.push_back(key);
  return keys;
}

TEST(SceneCommand, StepsAFile) {
  const TemporaryFolder folder("scene");
  const std::string file = folder.Write("cubes.json", kTwoCubes);
  const ProgramRun run = RunProgram("scene " + file);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, StartsWith("step,ms,bodies_moved,pairs,"));
  EXPECT_EQ(std::count(run.out.begin(), run.out.end(), '\n'), 9);
  const ProgramRun checked = RunProgram("scene " + file + " --check --json");
  ASSERT_EQ(checked.exit_code, 0) << checked.out << checked.err;
  const auto json = nlohmann::ordered_json::parse(checked.out);
  const std::vector<std::string> keys = Keys(json);
  ASSERT_GE(keys.size(), 3u);
  EXPECT_EQ(std::vector<std::string>(keys.end() - 3, keys.end()),
            (std::vector<std::string>{"steps", "mismatches", "findings"}));
  EXPECT_EQ(json["steps"], 8);
  EXPECT_EQ(json["mismatches"], 0);
  EXPECT_EQ(json["findings"], 0);
  EXPECT_EQ(json["begin"], 1);  // the faces touch after four steps
  EXPECT_EQ(json["persist"], 4);
  EXPECT_GE(json["pairs_judged"], 8);
}

TEST(SceneCommand, EveryDemoStandsTheCheck) {
  const std::vector<std::pair<std::string, int>> demos = {
      {"box-stack", 10}, {"hull-rain", 4}, {"gears", 6}, {"robot-arm", 25}, {"tori", 6}};
  for (const auto& [demo, steps] : demos) {
    const ProgramRun run = RunProgram("scene --demo " + demo + " --steps " + std::to_string(steps) +
                                      " --check --json");
    ASSERT_EQ(run.exit_code, 0) << demo << run.out << run.err;
    EXPECT_EQ(run.json()["steps"], steps);
    EXPECT_EQ(run.json()["mismatches"], 0);
    EXPECT_EQ(run.json()["findings"], 0);
  }
}

// Every quantity, of convex bodies, compounds and meshes.
constexpr std::string_view kAllNumbers = R"({
  "shapes": {"cube": {"box": [0.5, 0.5, 0.5]}, "torus": {"mesh": "torus", "faces": 120, "scale": 0.5},
             "bars": {"compound": [{"box": [1, 0.1, 0.1]}, {"box": [0.1, 1, 0.1]}]}},
  "bodies": [
    {"shape": "torus", "subscriptions": {"distance": 0.4, "depth": true, "cpd": true,
                                         "travel": {"direction": [0, 0, 1], "reach": 1}}},
    {"shape": "cube", "position": [1.2, 0, 1.1], "motion": {"velocity": [0, 0, -0.1]}},
    {"shape": "bars", "position": [-1.2, 0, 1.0], "motion": {"velocity": [0, 0.05, -0.1]},
     "subscriptions": {"distance": 3, "depth": true, "travel": {"direction": [1, 0, 0], "reach": 4}}},
    {"shape": "torus", "position": [0, 1, -0.9], "motion": {"velocity": [0, 0, 0.1], "spin": [0.1, 0, 0]}}],
  "steps": 10})";

TEST(SceneCommand, EveryNumberIsListedAndJudged) {
  const TemporaryFolder folder("scene");
  const ProgramRun run = RunProgram("scene " + folder.Write("numbers.json", kAllNumbers) +
                                    " --check --json --numbers " + folder.path("numbers.csv"));
  ASSERT_EQ(run.exit_code, 0) << run.out << run.err;
  EXPECT_EQ(run.json()["mismatches"], 0);
  EXPECT_EQ(run.json()["findings"], 0);
  EXPECT_GT(run.json()["numbers_checked"], 50);
  const std::string listed = folder.Read("numbers.csv");
  EXPECT_THAT(listed, StartsWith("step,quantity,body_a,part_a,body_b,part_b,value,lower,upper,"));
  for (const char* quantity : {"distance", "depth", "continuous_depth", "travel"}) {
    EXPECT_GE(run.json()["numbers_judged"][std::string(quantity) + "s"], 4) << quantity;
    EXPECT_THAT(listed, HasSubstr(std::string(",") + quantity + ',')) << quantity;
  }
}

TEST(SceneCommand, RulesDoNotChangeWhatIsTold) {
  const TemporaryFolder folder("scene");
  const std::string record = folder.path("record.json");
  ASSERT_EQ(RunProgram("scene --demo box-stack --steps 5 --record " + record).exit_code, 0);
  for (const std::string options :
       {"", "--without all", "--without margins --without rest", "--without tree --threads"}) {
    const ProgramRun run = RunProgram("scene " + record + " --json " + options);
    ASSERT_EQ(run.exit_code, 0) << run.out << run.err;
    EXPECT_EQ(run.json()["replay_mismatches"], 0);
    EXPECT_EQ(run.json()["steps"], 5);
  }
  // A record that tells otherwise is noticed.
  std::string text = folder.Read("record.json");
  const std::size_t at = text.find("begin ");
  ASSERT_NE(at, std::string::npos);
  text.replace(at, 5, "ended");
  const ProgramRun run = RunProgram("scene " + folder.Write("bent.json", text) + " --json");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_EQ(run.json()["replay_mismatches"], 1);
}

TEST(SceneCommand, BadFilesAreNamedWithTheElement) {
  const TemporaryFolder folder("scene");
  const std::string head = R"({"shapes": {"cube": {"box": [1, 1, 1]}}, "bodies": [)";
  const std::vector<std::pair<std::string, std::string>> bad = {
      {"{", "bad.json: byte"},
      {"[]", "bad.json: is no object"},
      {R"({"bodies": []})", "lacks 'shapes'"},
      {R"({"shapes": {"cube": {"box": [1, 1]}}, "bodies": []})",
       "shapes.cube.box: is no list of 3 numbers"},
      {R"({"shapes": {"cube": {"box": [1, 1, -1]}}, "bodies": []})",
       "shapes.cube.box: has a length that is not within"},
      {R"({"shapes": {"h": {"hull": {"vertices": 9, "semi_axes": [1e300, 1, 1]}}}, "bodies": []})",
       "shapes.h.hull.semi_axes: has a length"},
      {R"({"shapes": {"h": {"hull": {"vertices": 9, "semi_axes": [1e-9, 1, 1]}}}, "bodies": []})",
       "shapes.h.hull.semi_axes: is flatter"},
      {R"({"shapes": {"m": {"mesh": "torous"}}, "bodies": []})",
       "shapes.m.mesh: is neither a shape's name nor a file: 'torous'"},
      {head + R"({"shape": "cube", "name": "x"}, {"shape": "cube", "name": "x"}]})",
       "bodies[1]: there is another 'x' before it"},
      {R"({"shapes": {"cube": {"box": [1, 1, 0]}}, "bodies": []})", "shapes.cube.box: "},
      {R"({"shapes": {"m": {"mesh": "nothing.off"}}, "bodies": []})", "shapes.m.mesh: "},
      {R"({"shapes": {"m": {"file": "nothing.off"}}, "bodies": []})", "shapes.m.file: "},
      {head + R"({"shape": "cub"}]})", "bodies[0].shape: there is no shape 'cub'"},
      {head + R"({"shape": "cube"}, {"shape": "cube", "rotation": [1,0,0,0,1,0,0,0,2]}]})",
       "bodies[1]: "},
      {head + R"({"shape": "cube", "positoin": [0, 0, 0]}]})",
       "bodies[0]: has an unknown key 'positoin'"},
      {head + R"({"shape": "cube", "position": [0, 1e400, 0]}]})", "bad.json"},
      {head + R"({"shape": "cube", "subscriptions": {"distance": -1}}]})", "bodies[0]: "},
      {head + R"({"shape": "cube", "subscriptions": {"cpd": 1}}]})",
       "bodies[0].subscriptions.cpd: is neither true nor false"},
      {head + R"({"shape": "cube", "motion": {"parent": 0}}]})", "bodies[0].motion.parent: "},
      {head + R"({"shape": "cube"}], "ignore": [[0, 0]]})", "ignore[0]: names one body twice"},
      {head + R"({"shape": "cube"}], "pairs": [{"bodies": [0, 1], "subscriptions": {}}]})",
       "pairs[0].bodies[1]: "},
      {head + R"({"shape": "cube"}], "steps": -1})", "steps: is not within"}};
  for (const auto& [content, expected] : bad) {
    const ProgramRun run = RunProgram("scene " + folder.Write("bad.json", content));
    EXPECT_EQ(run.exit_code, 2) << content;
    EXPECT_THAT(run.err, HasSubstr("bad.json"));
    EXPECT_THAT(run.err, HasSubstr(expected)) << content;
  }
  EXPECT_EQ(RunProgram("scene").exit_code, 2);
  EXPECT_EQ(RunProgram("scene --demo nothing").exit_code, 2);
  EXPECT_EQ(RunProgram("scene " + folder.path("missing.json")).exit_code, 2);
  EXPECT_EQ(RunProgram("scene --demo tori --without nothing").exit_code, 2);
  EXPECT_EQ(RunProgram("scene " + folder.path("")).exit_code, 2);
  EXPECT_NE(RunProgram("scene --demo tori --steps -1").exit_code, 0);
  EXPECT_EQ(RunProgram("scene --demo tori --steps 1 --record " + folder.path("none/x")).exit_code,
            2);
}

}  // namespace
}  // namespace touchstone
