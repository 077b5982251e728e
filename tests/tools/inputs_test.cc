// SPDX-License-Identifier: MIT
//
// Files as they come: cut anywhere, empty, huge, full of NaN or nothing sensible. Each is refused
// with one line that names the file; none ends the program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include "touchstone/tests/tools/program.h"
#include "touchstone/tools/case_file.h"
#include "touchstone/tools/mesh_io.h"

namespace touchstone {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string kOff =
    "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
const std::string kObj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
const std::string kPly =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\n"
    "property double z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
const std::string kStl =
    "solid s\n"
    "facet normal 0 0 -1\nouter loop\nvertex 0 0 0\nvertex 0 1 0\nvertex 1 0 0\nendloop\nendfacet\n"
    "facet normal 0 -1 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 0 1\nendloop\nendfacet\n"
    "facet normal -1 0 0\nouter loop\nvertex 0 0 0\nvertex 0 0 1\nvertex 0 1 0\nendloop\nendfacet\n"
    "facet normal 1 1 1\nouter loop\nvertex 1 0 0\nvertex 0 1 0\nvertex 0 0 1\nendloop\nendfacet\n"
    "endsolid s\n";

struct Format {
  const char* extension;
  const std::string* good;
};
const std::vector<Format> kFormats = {
    {".off", &kOff}, {".obj", &kObj}, {".ply", &kPly}, {".stl", &kStl}};

class Inputs : public testing::Test {
 protected:
  // Refused with the file's name, or read as a body.
  void TryMesh(const std::string& name, const std::string& content, bool must_fail) {
    const std::string path = folder.Write(name, content);
    const Loaded<ConvexPolyhedron> body = ReadBody(path, false);
    if (!body.ok()) {
      EXPECT_THAT(body.error(), StartsWith(path)) << content.substr(0, 200);
    } else {
      EXPECT_FALSE(must_fail) << name << ": " << content.substr(0, 200);
      EXPECT_TRUE(body->FindValidationError().ok());
    }
  }

  TemporaryFolder folder{"inputs"};
};

TEST_F(Inputs, GoodMeshesAreRead) {
  for (const Format& format : kFormats) {
    const Loaded<ConvexPolyhedron> body =
        ReadBody(folder.Write(std::string("good") + format.extension, *format.good), false);
    ASSERT_TRUE(body.ok()) << body.error();
    EXPECT_EQ(body->vertex_count(), 4);
  }
}

TEST_F(Inputs, MeshesCutAtEveryByteAreRefusedOrWhole) {
  for (const Format& format : kFormats) {
    for (std::size_t size = 0; size < format.good->size(); ++size)
      TryMesh(std::string("cut") + format.extension, format.good->substr(0, size), false);
    TryMesh(std::string("empty") + format.extension, "", true);
    TryMesh(std::string("half") + format.extension, format.good->substr(0, format.good->size() / 2),
            true);
  }
}

TEST_F(Inputs, MeshesWithEveryWordReplacedAreRefusedOrWhole) {
  const std::vector<std::string> words = {"nan",   "inf",        "-inf",        "1e999", "-1",
                                          "99999", "2147483648", "1,5",         "x",     "0x",
                                          "",      "\xff\xfe",   "99999999999", "1e-400"};
  for (const Format& format : kFormats) {
    const std::string& good = *format.good;
    for (std::size_t begin = 0; begin < good.size();) {
      const std::size_t end = std::min(good.find_first_of(" \n", begin), good.size());
      for (const std::string& word : words) {
        TryMesh(std::string("word") + format.extension,
                good.substr(0, begin) + word + good.substr(end), false);
      }
      begin = end + 1;
    }
  }
}

TEST_F(Inputs, HugeCountsTakeNoMemory) {
  TryMesh("huge.off", "OFF\n2000000000 2000000000 0\n0 0 0\n", true);
  TryMesh("huge.ply",
          "ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty double x\nproperty double "
          "y\nproperty double z\nend_header\n0 0 0\n",
          true);
  TryMesh("huge.stl", std::string(80, ' ') + "\xff\xff\xff\xff" + std::string(50, 'a'), true);
  TryMesh("noise.stl", std::string(1000, '\x80'), true);
  TryMesh("noise.obj", std::string(1000, '\xff'), true);
  TryMesh("long.obj", "f " + std::string(100000, '1') + "\n", true);
}

TEST_F(Inputs, CasesCutAtEveryByteAreRefusedWithTheirLine) {
  const std::string good =
      "touchstone-case 1\nsuite a\nseed 7\nengine portal\nfinding none\npose relative\n"
      "row 1 0 0 2.5\nrow 0 1 0 0\nrow 0 0 1 0\n"
      "body p 4 4\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 0 2 1\nf 0 1 3\nf 0 3 2\nf 1 2 3\n"
      "body q 4 4\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 0 2 1\nf 0 1 3\nf 0 3 2\nf 1 2 3\nend\n";
  ASSERT_TRUE(ReadCase(folder.Write("good.case", good)).ok());
  for (std::size_t size = 0; size + 1 < good.size(); ++size) {
    const std::string path = folder.Write("cut.case", good.substr(0, size));
    const Loaded<CaseFile> loaded = ReadCase(path);
    ASSERT_FALSE(loaded.ok()) << size;
    EXPECT_THAT(loaded.error(), StartsWith(path + ":"));
  }
  for (std::size_t begin = good.find("row"); begin < good.size();) {
    const std::size_t end = std::min(good.find_first_of(" \n", begin), good.size());
    for (const char* word : {"nan", "inf", "-1", "1e999", "4294967296", "1,5", "\xff"}) {
      const std::string path =
          folder.Write("word.case", good.substr(0, begin) + word + good.substr(end));
      const Loaded<CaseFile> loaded = ReadCase(path);
      if (!loaded.ok()) {
        EXPECT_THAT(loaded.error(), StartsWith(path + ":"));
      }
    }
    begin = end + 1;
  }
}

// A comma for a point would change every number.
TEST_F(Inputs, TheLocaleChangesNothing) {
  setenv("LC_ALL", "de_DE.UTF-8", 1);
  const std::string mesh = folder.Write("a.off", kOff);
  const ProgramRun run =
      RunProgram("collide " + mesh + ' ' + mesh + " --pose 1 0 0 0.25 0 1 0 0.25 0 0 1 0.5 --json");
  unsetenv("LC_ALL");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.json()["verdict"], "touch");
}

TEST_F(Inputs, TheProgramSaysOneLine) {
  const std::string good = folder.Write("good.off", kOff);
  const std::string bad = folder.Write("bad.off", kOff.substr(0, 40));
  for (const std::string& command :
       {"collide " + good + ' ' + bad, "collide " + bad + ' ' + good, "distance " + bad + ' ' + bad,
        "replay " + bad, "replay " + folder.path("none.case"), "collide " + good + " /",
        "membership " + bad + " shape:torus:200 --at 0 0 0",
        "fuzz --report " + folder.path("none")}) {
    const ProgramRun run = RunProgram(command);
    EXPECT_EQ(run.exit_code, 2) << command << run.out << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    EXPECT_THAT(run.err, AnyOf(HasSubstr("bad.off"), HasSubstr("none"), HasSubstr("/")));
  }
}

}  // namespace
}  // namespace touchstone
