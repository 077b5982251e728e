// SPDX-License-Identifier: MIT
#include "touchstone/tools/case_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <sstream>
#include <string>

#include "touchstone/tests/tools/program.h"
#include "touchstone/tools/suites/registry.h"

namespace touchstone {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;

constexpr std::string_view kCase =
    "touchstone-case 1\n"
    "# A comment.\n"
    "suite none\n"
    "seed 7\n"
    "index 9\n"
    "search phased\n"
    "certainty exact\n"
    "early-exit yes\n"
    "finding wrong_verdict made up for a test\n"
    "pose relative\n"
    "row 0x1p+0 0 0 2.5\n"
    "row 0 1 0 0\n"
    "row 0 0 1 0\n"
    "body p 4 4\n"
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
    "f 0 2 1\nf 0 1 3\nf 0 3 2\nf 1 2 3\n"
    "body q 4 4\n"
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
    "f 0 2 1\nf 0 1 3\nf 0 3 2\nf 1 2 3\n"
    "end\n";

class CaseFiles : public testing::Test {
 protected:
  // kCase with one piece replaced must be refused with `text` after the file's name.
  void ExpectRefused(std::string_view piece, std::string_view replacement,
                     const std::string& text) {
    std::string content(kCase);
    content.replace(content.find(piece), piece.size(), replacement);
    const Loaded<CaseFile> loaded = ReadCase(folder.Write("bad.case", content));
    ASSERT_FALSE(loaded.ok()) << replacement;
    EXPECT_THAT(loaded.error(), AllOf(HasSubstr("bad.case:"), HasSubstr(text))) << replacement;
  }

  TemporaryFolder folder{"cases"};
};

std::string Written(const CaseFile& query) {
  std::ostringstream out;
  WriteCase(out, query);
  return out.str();
}

TEST_F(CaseFiles, WhatIsWrittenReadsBackBitForBit) {
  for (const std::unique_ptr<Suite>& suite : MakeSuites("")) {
    if (!suite->unavailable().empty()) continue;
    const CaseFile query{std::string(suite->name()),
                         5,
                         37,
                         Search::kPublished,
                         Certainty::kFloat,
                         true,
                         "wrong_verdict",
                         "one line",
                         suite->Generate(5, 37)};
    const std::string text = Written(query);
    const Loaded<CaseFile> loaded = ReadCase(folder.Write("a.case", text));
    ASSERT_TRUE(loaded.ok()) << loaded.error();
    EXPECT_EQ(Written(*loaded), text) << suite->name();
    EXPECT_EQ(loaded->pair.pose.world().has_value(), query.pair.pose.world().has_value());
  }
}

TEST_F(CaseFiles, FieldsAreRead) {
  const Loaded<CaseFile> loaded = ReadCase(folder.Write("good.case", kCase));
  ASSERT_TRUE(loaded.ok()) << loaded.error();
  EXPECT_EQ(loaded->seed, 7u);
  EXPECT_EQ(loaded->index, 9u);
  EXPECT_EQ(loaded->search, Search::kPhased);
  EXPECT_TRUE(loaded->early_exit);
  EXPECT_EQ(loaded->finding, "wrong_verdict");
  EXPECT_EQ(loaded->detail, "made up for a test");
  EXPECT_EQ(loaded->pair.pose.translation()[0], 2.5);
}

TEST_F(CaseFiles, MalformedLinesAreNamed) {
  ExpectRefused("touchstone-case 1", "something else", ":1: not a case file");
  ExpectRefused("touchstone-case 1", "touchstone-case 2", ":1: version 2 is unknown");
  ExpectRefused("seed 7", "seed seven", ":4: 'seven' is not a value for 'seed'");
  ExpectRefused("seed 7", "seed -7", ":4: '-7' is not a value");
  ExpectRefused("seed 7", "sead 7", ":4: unknown keyword 'sead'");
  ExpectRefused("search phased", "search fast", ":6: 'fast' is not a value");
  ExpectRefused("early-exit yes", "early-exit maybe", ":8: 'early-exit' takes yes or no");
  ExpectRefused("pose relative", "pose odd", ":10: 'pose' takes relative or world");
  ExpectRefused("row 0 1 0 0\n", "row 0 1 0\n", ":12: 'row' takes 4 words, not 3");
  ExpectRefused("row 0 1 0 0\n", "row 0 1 0 zero\n", ":12: 'zero' is not a value");
  ExpectRefused("0x1p+0", "0x1p+9", "bad_rotation");
  ExpectRefused("0x1p+0", "nan", "non_finite");
  ExpectRefused("body p 4 4", "body q 4 4", ":14: body 'q' where body 'p' should be");
  ExpectRefused("body p 4 4", "body p 2000000000 4", ":14: no body has that many");
  ExpectRefused("body p 4 4", "body p 5 4", ":19: 'f' where 'v' should be");
  ExpectRefused("f 0 2 1\n", "f 0 2 9\n", "bad_index");
  ExpectRefused("f 0 2 1\n", "f 0 1 2\n", "inconsistent_orientation");
  ExpectRefused("f 1 2 3\nend\n", "f 1 2 3\n", "the file ends where 'end' should be");
  EXPECT_THAT(ReadCase(folder.path("missing.case")).error(), EndsWith("cannot be opened"));
  EXPECT_THAT(ReadCase(folder.Write("empty.case", "")).error(), HasSubstr("not a case file"));
}

}  // namespace
}  // namespace touchstone
