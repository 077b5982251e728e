// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "touchstone/tests/tools/program.h"

namespace touchstone {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr std::string_view kCubeOff =
    "OFF\n8 6 0\n"
    "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
    "4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";

constexpr std::string_view kTetrahedronObj =
    "# a comment\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
    "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

constexpr std::string_view kTetrahedronStl =
    "solid t\n"
    "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 0 1 0\nvertex 1 0 0\nendloop\nendfacet\n"
    "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 0 1\nendloop\nendfacet\n"
    "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 0 0 1\nvertex 0 1 0\nendloop\nendfacet\n"
    "facet normal 0 0 0\nouter loop\nvertex 1 0 0\nvertex 0 1 0\nvertex 0 0 1\nendloop\nendfacet\n"
    "endsolid t\n";

constexpr std::string_view kTetrahedronPly =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty "
    "double z\n"
    "element face 4\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

// A cube with one corner pushed in.
constexpr std::string_view kDentedOff =
    "OFF\n8 12 0\n"
    "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n0.25 0.25 0.25\n0 1 1\n"
    "3 0 3 2\n3 0 2 1\n3 4 5 6\n3 4 6 7\n3 0 1 5\n3 0 5 4\n3 1 2 6\n3 1 6 5\n3 2 3 7\n3 2 7 6\n3 3 "
    "0 4\n3 3 4 7\n";

class CollideCommand : public testing::Test {
 protected:
  TemporaryFolder folder{"collide"};
  std::string cube = folder.Write("cube.off", kCubeOff);

  // Bad input: exit code 2, nothing on stdout, and one line on stderr that holds `text`.
  void ExpectRefused(const std::string& arguments, const std::string& text) {
    const ProgramRun run = RunProgram(arguments);
    EXPECT_EQ(run.exit_code, 2) << arguments << "\n" << run.err;
    EXPECT_THAT(run.out, IsEmpty()) << arguments;
    EXPECT_THAT(run.err, HasSubstr(text)) << arguments;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << arguments << "\n" << run.err;
  }
};

std::string PoseBy(const std::string& x, const std::string& y, const std::string& z) {
  return " --pose 1 0 0 " + x + " 0 1 0 " + y + " 0 0 1 " + z;
}

TEST_F(CollideCommand, EverySearchAnswersAndTheJudgeAgrees) {
  for (const std::string search : {"published", "phased", "portal"}) {
    const std::string tail = " --search " + search + " --judge --json";
    const ProgramRun apart =
        RunProgram("collide " + cube + " " + cube + PoseBy("2", "0.25", "0.125") + tail);
    EXPECT_EQ(apart.exit_code, 0) << apart.out << apart.err;
    EXPECT_EQ(apart.json()["verdict"], "separate");
    const ProgramRun meeting =
        RunProgram("collide " + cube + " " + cube + PoseBy("0.5", "0.25", "-0.125") + tail);
    EXPECT_EQ(meeting.exit_code, 0) << meeting.out << meeting.err;
    EXPECT_EQ(meeting.json()["verdict"], "overlap");
  }
  const ProgramRun touching =
      RunProgram("collide " + cube + " " + cube + PoseBy("1", "0.25", "0.125") + " --judge --json");
  EXPECT_EQ(touching.exit_code, 0);
  EXPECT_EQ(touching.json()["verdict"], "touch");
  EXPECT_THAT(touching.json()["judge"]["findings"], IsEmpty());
}

TEST_F(CollideCommand, JsonHasTheParts) {
  const ProgramRun run = RunProgram("collide " + cube + " " + cube + PoseBy("2", "0.25", "0.125") +
                                    " --search phased --judge --trace --json");
  const nlohmann::json json = run.json();
  for (const std::string key :
       {"p", "q", "search", "certainty", "verdict", "tier", "phase", "termination", "face",
        "signed_distance", "exit_travel", "exit_point", "certificate", "phases", "counts", "trace",
        "search_ns", "judge"}) {
    EXPECT_TRUE(json.contains(key)) << key;
  }
  EXPECT_GT(json["exit_travel"]["value"].get<double>(), 0.0);
  EXPECT_THAT(json["trace"], Not(IsEmpty()));
}

TEST_F(CollideCommand, TextNamesVerdictFaceCertificateAndJudge) {
  const ProgramRun run = RunProgram("collide " + cube + " " + cube + PoseBy("2", "0.25", "0.125") +
                                    " --search phased --judge --trace");
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.out, AllOf(HasSubstr("verdict          separate"), HasSubstr("exit face"),
                             HasSubstr("certificate"), HasSubstr("no findings"),
                             HasSubstr("faces visited")));
}

TEST_F(CollideCommand, ReadsAllFourFormats) {
  const std::string obj = folder.Write("t.obj", kTetrahedronObj);
  const std::string stl = folder.Write("t.STL", kTetrahedronStl);
  const std::string ply = folder.Write("t.ply", kTetrahedronPly);
  for (const std::string& file : {obj, stl, ply}) {
    const ProgramRun run = RunProgram("collide " + file + " " + cube + " --json");
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(run.json()["p"]["vertices"], 4) << file;  // equal points of the STL file are one
    EXPECT_EQ(run.json()["verdict"], "overlap");
  }
}

TEST_F(CollideCommand, HexadecimalPosesAreExact) {
  // One ulp beyond contact, then contact.
  const ProgramRun apart = RunProgram("collide " + cube + " " + cube +
                                      PoseBy("0x1.0000000000001p0", "0.25", "0.25") + " --json");
  EXPECT_EQ(apart.json()["verdict"], "separate");
  const ProgramRun touching =
      RunProgram("collide " + cube + " " + cube + PoseBy("0x1p0", "0.25", "0.25") + " --json");
  EXPECT_EQ(touching.json()["verdict"], "touch");
}

TEST_F(CollideCommand, LocalesDoNotMatter) {
  // In this locale, where it is installed, the decimal point is a comma.
  setenv("LC_ALL", "de_DE.UTF-8", 1);
  const ProgramRun run =
      RunProgram("collide " + cube + " " + cube + PoseBy("0.5", "0.25", "0.125") + " --json");
  unsetenv("LC_ALL");
  EXPECT_EQ(run.json()["verdict"], "overlap");
}

TEST_F(CollideCommand, NonconvexMeshIsRefusedWithTheReasonUnlessHullIsAsked) {
  const std::string dented = folder.Write("dented.off", kDentedOff);
  ExpectRefused("collide " + dented + " " + cube, "not_convex");
  ExpectRefused("collide " + cube + " " + dented, "--hull");
  const ProgramRun run = RunProgram("collide --hull " + dented + " " + cube + " --judge --json");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.json()["p"]["vertices"], 7);
}

TEST_F(CollideCommand, BadUsageIsOneLineAndCodeTwo) {
  ExpectRefused("", "subcommand");
  ExpectRefused("collide", "required");
  ExpectRefused("frobnicate", "frobnicate");
  ExpectRefused("collide " + cube + " " + cube + " --pose 1 0 0", "12 numbers");
  ExpectRefused("collide " + cube + " " + cube + PoseBy("1", "2", "3") + " 4", "12 numbers");
  ExpectRefused("collide " + cube + " " + cube + PoseBy("one", "2", "3"), "'one' is not a number");
  ExpectRefused("collide " + cube + " " + cube + PoseBy("nan", "2", "3"), "non_finite");
  ExpectRefused("collide " + cube + " " + cube + " --pose 2 0 0 0 0 1 0 0 0 0 1 0", "bad_rotation");
  ExpectRefused("collide " + cube + " " + cube + " --pose -1 0 0 0 0 1 0 0 0 0 1 0",
                "bad_rotation");
  ExpectRefused("collide " + cube + " " + cube + " --search fast", "'fast' is none of");
  ExpectRefused("collide " + cube + " " + cube + " --certainty perhaps", "'perhaps' is none of");
}

TEST_F(CollideCommand, MalformedFilesAreNamedWithTheLine) {
  const auto refused = [&](const std::string& name, std::string_view content,
                           const std::string& text) {
    ExpectRefused("collide " + folder.Write(name, content) + " " + cube, text);
  };
  ExpectRefused("collide " + folder.path("missing.off") + " " + cube,
                "missing.off: cannot be opened");
  ExpectRefused("collide " + folder.path("") + " " + cube, "unknown kind of file");
  refused("cube.txt", kCubeOff, "unknown kind of file");
  refused("empty.off", "", "empty.off: the file is empty");
  refused("noise.off", "this is no mesh\n", "noise.off");
  refused("truncated.off", kCubeOff.substr(0, kCubeOff.size() - 20), "truncated.off: line 1");
  refused("vertices_only.off", "OFF\n8 6 0\n0 0 0\n1 0 0\n", "vertices_only.off: line ");
  refused("nan.off",
          "OFF\n4 4 0\n0 0 0\n1 0 nan\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n",
          "nan.off: line 4");
  refused("huge_count.off", "OFF\n1000000000 1 0\n0 0 0\n", "huge_count.off");
  refused("huge_face.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n4000000000 0 2 1\n",
          "huge_face.off");
  refused("bad_index.off",
          "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 9\n3 0 1 3\n3 0 3 2\n3 1 2 3\n",
          "bad_index.off: line 7");
  refused("open.off", "OFF\n4 3 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n",
          "open.off: ");
  refused("no_faces.off", "OFF\n4 0 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n", "no_faces.off");
  refused("letters.obj", "v 0 0 0\nv 1 zero 0\n", "letters.obj: line 2");
  refused("index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 5\nf 1 4 3\nf 2 3 4\n",
          "names a vertex that does not exist");
  refused("truncated.stl", kTetrahedronStl.substr(0, 200), "truncated.stl: line ");
  refused("short.stl", "sol", "short.stl");
  refused("truncated.ply", kTetrahedronPly.substr(0, kTetrahedronPly.size() - 12), "truncated.ply");
  refused("header.ply", "ply\nformat ascii 1.0\nelement vertex 4\n", "header.ply");
  std::string binary(100, '\0');
  binary[80] = '\x7f';
  refused("short_binary.stl", binary, "short_binary.stl: byte ");
}

TEST_F(CollideCommand, HelpIsFineAndNamesTheOptions) {
  const ProgramRun run = RunProgram("collide --help");
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.out, AllOf(HasSubstr("--pose"), HasSubstr("--search"), HasSubstr("--certainty"),
                             HasSubstr("--early-exit"), HasSubstr("--judge"), HasSubstr("--hull"),
                             HasSubstr("--trace"), HasSubstr("--json")));
  EXPECT_EQ(RunProgram("--help").exit_code, 0);
}

}  // namespace
}  // namespace touchstone
