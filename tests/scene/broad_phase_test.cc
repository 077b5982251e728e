// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdio>
#include <set>
#include <utility>
#include <vector>

#include "touchstone/core/scene/broad_phase_internal.h"
#include "touchstone/core/scene/pair_table_internal.h"
#include "touchstone/tests/testing/random.h"

namespace touchstone::testing {
namespace {

using internal::BroadPhaseFinder;
using internal::PairTable;
using Pairs = std::set<std::pair<int, int>>;

// Boxes of all sizes that come, move, and go: each update must report every meeting pair of an
// updated item, and none that does not meet.
void CheckAgainstAllPairs(BroadPhase kind, std::uint64_t seed) {
  std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
  Random random(seed);
  const auto finder = internal::MakeBroadPhase(kind);
  std::vector<Box3> boxes(300, Box3{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()});
  std::vector<char> is_in(300, 0);
  long found_pairs = 0;
  for (int round = 0; round < 400; ++round) {
    std::set<int> chosen;
    const int count = random.Int(0, 9) == 0 ? 300 : random.Int(0, 12);
    for (int k = 0; k < count; ++k) chosen.insert(random.Int(0, 299));
    std::vector<int> updated;
    for (const int item : chosen) {
      if (is_in[item] && random.Int(0, 4) == 0) {
        finder->Remove(item);
        is_in[item] = 0;
        continue;
      }
      const double size = random.Int(0, 40) == 0 ? 1e9 : random.Int(0, 3) == 0 ? 0.0 : 1.0;
      const Eigen::Vector3d low(random.Int(-9, 9), random.Int(-9, 9), random.Int(-9, 9));
      boxes[item] = {low, low + size * Eigen::Vector3d(random.Int(0, 2), 1, random.Unit())};
      is_in[item] = 1;
      updated.push_back(item);
    }
    finder->Update(boxes, updated);
    std::vector<std::pair<int, int>> reported;
    finder->FindPairs(boxes, updated, &reported);
    Pairs found;
    for (auto [a, b] : reported) {
      ASSERT_TRUE(is_in[a] && is_in[b] && a != b);
      ASSERT_TRUE(kind == BroadPhase::kAllPairs || internal::Meet(boxes[a], boxes[b]));
      found.insert(std::minmax(a, b));
    }
    for (const int a : updated) {
      for (int b = 0; b < 300; ++b) {
        if (!is_in[b] || a == b || !internal::Meet(boxes[a], boxes[b])) continue;
        ASSERT_TRUE(found.contains(std::minmax(a, b))) << a << ' ' << b << " round " << round;
        ++found_pairs;
      }
    }
  }
  EXPECT_GT(found_pairs, 1000);
}

TEST(BroadPhaseFinder, TreeFindsAllPairs) { CheckAgainstAllPairs(BroadPhase::kTree, 21); }
TEST(BroadPhaseFinder, SweepFindsAllPairs) { CheckAgainstAllPairs(BroadPhase::kSweep, 22); }
TEST(BroadPhaseFinder, AllPairsFindsAllPairs) { CheckAgainstAllPairs(BroadPhase::kAllPairs, 23); }

TEST(PairTable, KeepsWhatASetKeeps) {
  std::printf("seed 24\n");
  Random random(24);
  PairTable table;
  Pairs expected;
  for (int round = 0; round < 20000; ++round) {
    const int p = random.Int(0, 40), q = random.Int(0, 40);
    const int place = table.Find(p, q);
    ASSERT_EQ(place >= 0, expected.contains({p, q}));
    if (place < 0) {
      const int added = table.Add(p, q);
      table.limit(added) = 100.0 * p + q;
      expected.insert({p, q});
    } else {
      ASSERT_EQ(table.p(place), p);
      ASSERT_EQ(table.q(place), q);
      ASSERT_EQ(table.limit(place), 100.0 * p + q);
      if (random.Int(0, 1) == 0) {
        table.RemoveAt(place);
        expected.erase({p, q});
      }
    }
    ASSERT_EQ(table.size(), static_cast<int>(expected.size()));
  }
}

}  // namespace
}  // namespace touchstone::testing
