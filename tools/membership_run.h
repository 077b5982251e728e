// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_MEMBERSHIP_RUN_H_
#define TOUCHSTONE_TOOLS_MEMBERSHIP_RUN_H_

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "touchstone/core/base/verdict.h"

namespace touchstone {

// How B is placed.
enum class MembershipPlacement {
  kAnywhere,  // in the box that M fills, turned anyhow
  kOnGrid,    // turned by a rotation of the cube, a vertex on a vertex, or quarters off: touches
  kNear,      // a travel of 1e-3 of the size down to one ulp from where contact begins or ends
};
inline constexpr int kMembershipPlacementCount = 3;
std::string_view ToString(MembershipPlacement placement);

struct MembershipStats {
  std::uint64_t placements = 0;
  std::array<std::uint64_t, 3> verdicts{};  // the exact ones: separate, touch, overlap
  std::uint64_t wrong = 0;                  // the core's exact answer is not the exact half's
  std::uint64_t wrong_in_doubles = 0;       // doubles alone decided, and wrongly
  std::uint64_t undecided = 0;              // doubles alone did not decide
  std::vector<std::string> samples;         // of what was wrong, one line each
};

struct MembershipRunOptions {
  std::uint64_t seed = 1, first = 0, count = 0;
};

// How many placements of how many are judged, and how many answers were wrong.
struct MembershipProgress {
  std::uint64_t placements = 0, count = 0, wrong = 0;
};

// Asks the core where B stands, with certainty and in doubles alone, and holds both against the
// exact half. Placement i is the same on every machine, whatever the range: a run can be made in
// pieces, and counts add up. Pairs of all shapes with up to about 100 faces, some with B in two
// sizes. Reports after each pair, 48 placements.
std::array<MembershipStats, kMembershipPlacementCount> RunMembershipPlacements(
    const MembershipRunOptions& options,
    const std::function<void(const MembershipProgress&)>& report);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_MEMBERSHIP_RUN_H_
