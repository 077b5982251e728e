// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_BOUNDARY_RUN_H_
#define TOUCHSTONE_TOOLS_BOUNDARY_RUN_H_

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace touchstone {

// How B is turned.
enum class BoundaryTurn {
  kAligned,  // by a rotation of the cube: faces and edges parallel exactly
  kNearly,   // off such a one by 1e-15 to 1e-3
  kAnyhow,
};
inline constexpr int kBoundaryTurnCount = 3;
std::string_view ToString(BoundaryTurn turn);

struct BoundaryStats {
  std::uint64_t cases = 0, triangles = 0, components = 0;
  std::uint64_t with_thin_parts = 0;  // cases with sheets, segments or points
  std::uint64_t enumerated = 0;       // cases with every piece of every facet of M placed exactly
  std::uint64_t findings = 0;
  std::vector<std::string> samples;  // of the findings, one line each
};

struct BoundaryRunOptions {
  std::uint64_t seed = 1, first = 0, count = 0;
};

// Builds whole boundaries and judges each exactly (exact/judge_minkowski.h); the bodies swapped,
// and both moved alike, must have the same surface up to a linear map. Case i is the same on every
// machine: pairs of all shapes in turn, with few faces, some snapped to a coarse grid, some of two
// components, some with one body far smaller; sizes from 1e-100 to 1e100. Reports after each.
std::array<BoundaryStats, kBoundaryTurnCount> RunBoundaryCases(
    const BoundaryRunOptions& options,
    const std::function<void(std::uint64_t cases, std::uint64_t findings)>& report);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_BOUNDARY_RUN_H_
