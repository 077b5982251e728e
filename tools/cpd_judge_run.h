// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_CPD_JUDGE_RUN_H_
#define TOUCHSTONE_TOOLS_CPD_JUDGE_RUN_H_

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace touchstone {

// What continuous penetration depths are asked of, and how.
enum class CpdCase {
  kNearest,       // random pairs, each placement from nothing: the nearest of the local solutions
  kMoving,        // random pairs along slow motions, on kept triangles where they hold
  kOtherNormals,  // the same, weighted by area, uniform, and interpolated, in turn
  kMeanNormals,   // the same, over a radius
  kScene,         // the paper's scenes
  kSceneMean,     // the same, over a radius
};
inline constexpr int kCpdCaseCount = 6;
std::string_view ToString(CpdCase which);

struct CpdJudgeStats {
  std::uint64_t placements = 0, overlapping = 0;
  std::uint64_t found = 0;  // projections, which are judged
  std::uint64_t kept = 0;   // of them on kept triangles
  std::uint64_t wrong = 0;
  std::vector<std::string> samples;  // of what was wrong, one line each
};

struct CpdJudgeOptions {
  std::uint64_t seed = 1, first = 0, count = 0;
};

// Continuous penetration depths, each held against the exact half: on ∂M, no nearer than the depth,
// with the residual claimed; see exact/judge_cpd.h. Placement i is the same on every machine,
// whatever the range. Random pairs of all shapes, of about 50 to 200 faces.
std::array<CpdJudgeStats, kCpdCaseCount> RunCpdJudge(const CpdJudgeOptions& options,
                                                     const std::function<void(double)>& report);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_CPD_JUDGE_RUN_H_
