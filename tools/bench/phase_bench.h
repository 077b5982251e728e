// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_BENCH_PHASE_BENCH_H_
#define TOUCHSTONE_TOOLS_BENCH_PHASE_BENCH_H_

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace touchstone {

// The stages of CD-DUALITY as printed, in order: set-up (M, the choice of c), the first face
// (section 4.2, a look at every face of P), SEARCH-FV, SEARCH-VF, SEARCH-EE.
inline constexpr std::array<std::string_view, 5> kPublishedStages = {
    "set-up", "first-face", "SEARCH-FV", "SEARCH-VF", "SEARCH-EE"};

// The mean time in each stage at one gap: the paper's Figure 10. Means, not medians, so that they
// add up; zero where an early exit came before.
struct PhaseTimes {
  int n = 0;
  double gap = 0.0;
  std::array<double, kPublishedStages.size()> ns{};
};

struct PhaseBenchOptions {
  int n = 1000;  // ellipsoids 2:1:1
  std::vector<double> gaps;
  int orientations = 500;
  int repeats = 300;
  std::uint64_t seed = 1;
};

// Runs the published search up to the end of each stage and takes differences: the middle of
// several turns at each orientation.
std::vector<PhaseTimes> RunPhaseBench(const PhaseBenchOptions& options);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_BENCH_PHASE_BENCH_H_
