// SPDX-License-Identifier: MIT
#include "touchstone/tests/layers/layers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace touchstone {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// A tree of its own, with one line in one file.
std::vector<std::string> ViolationsOf(const std::string& file, const std::string& line) {
  const fs::path root = fs::path(testing::TempDir()) / "touchstone_layers_test";
  fs::remove_all(root);
  fs::create_directories((root / file).parent_path());
  std::ofstream(root / file) << "// SPDX-License-Identifier: MIT\n" << line << '\n';
  return FindLayerViolations(root);
}

TEST(Layers, IncludesOfTheTreePointDown) {
  EXPECT_THAT(FindLayerViolations(TOUCHSTONE_SOURCE_DIR), IsEmpty());
}

TEST(Layers, ThisTestSeesTheTree) {
  // Should the folders move, the test above must not pass for having read nothing.
  EXPECT_TRUE(fs::exists(fs::path(TOUCHSTONE_SOURCE_DIR) / "core/cd_dual/cd_dual.h"));
  EXPECT_TRUE(fs::exists(fs::path(TOUCHSTONE_SOURCE_DIR) / "exact/judge.h"));
}

TEST(Layers, PlantedUpwardIncludesAreFound) {
  EXPECT_THAT(
      ViolationsOf("core/base/status.cc", "#include \"touchstone/core/convex/support.h\""),
      ElementsAre(HasSubstr("core/base/status.cc:2: core/base may not include core/convex")));
  EXPECT_THAT(ViolationsOf("core/convex/support.cc", "#include \"touchstone/exact/judge.h\""),
              ElementsAre(HasSubstr("core may not include exact")));
  EXPECT_THAT(
      ViolationsOf("core/mesh/mesh.h", "  #  include \"touchstone/core/cpd/solver.h\"  // up"),
      ElementsAre(HasSubstr("core/mesh may not include core/cpd")));
  EXPECT_THAT(ViolationsOf("exact/decide.cc", "#include \"touchstone/tools/case_file.h\""),
              ElementsAre(HasSubstr("exact may not include tools")));
  EXPECT_THAT(ViolationsOf("tools/case_file.h", "#include \"touchstone/tests/testing/shapes.h\""),
              ElementsAre(HasSubstr("tools may not include tests")));
  EXPECT_THAT(ViolationsOf("core/novelty/new.h", "#include \"touchstone/core/base/status.h\""),
              ElementsAre(HasSubstr("no place among the layers")));
}

TEST(Layers, TheJudgeReadsOnlyVerticesFacesPosesAndResults) {
  EXPECT_THAT(ViolationsOf("exact/decide.cc", "#include \"touchstone/core/convex/support.h\""),
              ElementsAre(HasSubstr("the judge may not read core/convex/support.h")));
  EXPECT_THAT(ViolationsOf("exact/judge/face.cc", "#include \"touchstone/core/base/dyadic.h\""),
              ElementsAre(HasSubstr("the judge may not read core/base/dyadic.h")));
  EXPECT_THAT(ViolationsOf("exact/decide.cc", "#include \"touchstone/core/cd_dual/result.h\""),
              IsEmpty());
}

TEST(Layers, OracleCodeAndPrivateHeadersStayOut) {
  EXPECT_THAT(ViolationsOf("core/base/status.cc", "#include <CGAL/Gmpq.h>"),
              ElementsAre(HasSubstr("no oracle code")));
  EXPECT_THAT(ViolationsOf("core/base/status.cc", "#include <gmpxx.h>"),
              ElementsAre(HasSubstr("no oracle code")));
  EXPECT_THAT(ViolationsOf("core/cd_dual/portal.cc",
                           "#include \"touchstone/core/convex/topology_internal.h\""),
              ElementsAre(HasSubstr("private to its folder")));
  EXPECT_THAT(ViolationsOf("core/cd_dual/portal.cc", "#include \"portal.h\""),
              ElementsAre(HasSubstr("own headers are included as")));
  EXPECT_THAT(ViolationsOf("exact/decide.cc", "#include <CGAL/Gmpq.h>"), IsEmpty());
}

}  // namespace
}  // namespace touchstone
