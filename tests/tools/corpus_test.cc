// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include "touchstone/tools/bad_input.h"
#include "touchstone/tools/campaign/shrink.h"
#include "touchstone/tools/case_file.h"
#include "touchstone/tools/engines/registry.h"

namespace touchstone {
namespace {

std::vector<std::filesystem::path> Cases() {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(TOUCHSTONE_CORPUS)) {
    if (entry.path().extension() == ".case") paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

bool IsAvailable(const std::string& engine) {
  const std::string base = engine.substr(0, engine.find(':'));
  const std::vector<EngineDescription> all = AllEngines();
  return std::any_of(all.begin(), all.end(), [&](const EngineDescription& description) {
    return description.name == base && description.unavailable.empty();
  });
}

bool Shows(const std::vector<NamedFinding>& findings, const std::string& kind) {
  return std::any_of(findings.begin(), findings.end(),
                     [&](const NamedFinding& finding) { return finding.kind == kind; });
}

// What other engines got wrong, shrunk: it shows the same today, and our searches answer it right.
TEST(Corpus, EveryCaseShowsWhatItRecords) {
  int replayed = 0;
  std::set<std::string> kinds;
  for (const std::filesystem::path& path : Cases()) {
    const Loaded<CaseFile> loaded = ReadCase(path.string());
    ASSERT_TRUE(loaded.ok()) << loaded.error();
    if (!IsAvailable(loaded->engine)) continue;
    EXPECT_TRUE(Shows(AskApart(loaded->engine, loaded->pair, 20.0), loaded->finding)) << path;
    for (const char* ours : {"portal", "phased"})
      EXPECT_TRUE(AskApart(ours, loaded->pair, 20.0).empty()) << path << ' ' << ours;
    kinds.insert(loaded->finding);
    ++replayed;
  }
  if (replayed == 0) GTEST_SKIP() << "no engine of the corpus was found at configuration";
  EXPECT_GE(kinds.size(), 3u);
}

// They are there to be read.
TEST(Corpus, CasesAreSmallAndHaveACaption) {
  for (const std::filesystem::path& path : Cases()) {
    const Loaded<CaseFile> loaded = ReadCase(path.string());
    ASSERT_TRUE(loaded.ok()) << loaded.error();
    EXPECT_LE(loaded->pair.p.vertex_count() + loaded->pair.q.vertex_count(), 24) << path;
    std::ifstream in(path);
    int captions = 0;
    for (std::string line; std::getline(in, line);)
      captions += line.starts_with("# ") && !line.starts_with("# Replay");
    EXPECT_GE(captions, 1) << path;
  }
  EXPECT_FALSE(Cases().empty());
}

// Any property of a query survives shrinking, and nothing else does.
TEST(Shrink, KeepsThePropertyAndLittleElse) {
  const std::filesystem::path path = Cases().front();
  const Loaded<CaseFile> loaded = ReadCase(path.string());
  ASSERT_TRUE(loaded.ok());
  PlacedPair pair = loaded->pair;
  int asked = 0;
  const PlacedPair small = ShrinkWhile(pair, 2.0, [&](const PlacedPair& candidate) {
    ++asked;
    return candidate.q.max_coordinate() >= 0.25 * pair.q.max_coordinate();
  });
  EXPECT_GT(asked, 0);
  EXPECT_GE(small.q.max_coordinate(), 0.25 * pair.q.max_coordinate());
  EXPECT_EQ(small.p.vertex_count(), 4);
  EXPECT_EQ(small.q.vertex_count(), 4);
  EXPECT_TRUE(small.pose.rotation().isIdentity(0.0));
  EXPECT_TRUE(small.pose.translation().isZero(0.0));
}

TEST(Shrink, AskingApartSeesTheEngineThatIsNot) {
  EXPECT_THROW(MakeContestants({"nobody"}), BadInput);
}

}  // namespace
}  // namespace touchstone
