// SPDX-License-Identifier: MIT
#include "touchstone/core/base/host_arithmetic.h"

#include <gtest/gtest.h>

#include <cfenv>

#include "touchstone/tests/testing/host_modes.h"

namespace touchstone {
namespace {

TEST(HostArithmetic, NamesTheModeOfTheCallingThread) {
  EXPECT_EQ(DetectHostArithmetic(), HostArithmetic{});
  const std::pair<int, Rounding> modes[] = {{FE_UPWARD, Rounding::kUpward},
                                            {FE_DOWNWARD, Rounding::kDownward},
                                            {FE_TOWARDZERO, Rounding::kTowardZero},
                                            {FE_TONEAREST, Rounding::kToNearest}};
  for (const auto& [mode, expected] : modes) {
    const testing::HostMode set(mode, /*flush=*/false);
    EXPECT_EQ(DetectHostArithmetic().rounding, expected);
    EXPECT_FALSE(DetectHostArithmetic().extended);
  }
}

TEST(HostArithmetic, SeesFlushedDenormals) {
  if (!testing::HostMode::CanFlush()) GTEST_SKIP() << "this processor has no such mode";
  for (const int mode : {FE_TONEAREST, FE_UPWARD}) {
    const testing::HostMode set(mode, /*flush=*/true);
    const HostArithmetic host = DetectHostArithmetic();
    EXPECT_TRUE(host.flushes_results);
    EXPECT_TRUE(host.flushes_operands);
    EXPECT_FALSE(host.extended);
  }
  EXPECT_EQ(DetectHostArithmetic(), HostArithmetic{}) << "left behind";
}

TEST(HostArithmetic, IsDescribedInOneLine) {
  EXPECT_EQ(Describe({}), "rounds to nearest, keeps denormals");
  EXPECT_EQ(Describe({Rounding::kUpward, true, true, false}),
            "rounds upward, flushes denormal results, takes denormal operands for zero");
}

}  // namespace
}  // namespace touchstone
