// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_PROXIMITY_RUN_H_
#define TOUCHSTONE_TOOLS_PROXIMITY_RUN_H_

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "touchstone/tools/verify_run.h"

namespace touchstone {

// What is asked of every pair of a suite.
enum class ProximityQuery {
  kDistance,
  kDistanceWarm,  // again, Q moved a little, from the cache
  kDepth,
  kDepthWarm,
  kTravel,
  kPublished,  // the paper's own construction: its findings are counted, not an error
};
inline constexpr int kProximityQueryCount = 6;
std::string_view ToString(ProximityQuery query);

struct ProximityStats {
  std::uint64_t queries = 0;
  std::map<std::string, std::uint64_t> answers;  // by the kind of the answer
  std::uint64_t exact = 0;                       // took exact signs
  std::uint64_t warm = 0;                        // kDepthWarm: the cache served
  std::map<std::string, std::uint64_t> findings;
  std::vector<std::string> samples;  // the first few findings, one line each
  DurationHistogram query_ns;
  double judge_seconds = 0.0;

  void Merge(const ProximityStats& other);
  std::uint64_t FindingCount() const;
};

struct SuiteProximity {
  std::string suite;
  std::array<ProximityStats, kProximityQueryCount> by_query;
};

// Asks distance, depth and a travel of every pair of the suites, cold and from caches, judges all
// answers exactly, and holds the published construction against them. Of `options` it takes suites,
// seed, first, count or minutes, threads, certainty and depth: kFull looks at all faces of M always
// and builds M whole; kMixed does so for small bodies and on a sample; kProof neither. With a
// count, all totals but times depend on suites, seed and count alone.
std::vector<SuiteProximity> RunProximity(const VerifyOptions& options,
                                         const std::function<void(const Progress&)>& report);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_PROXIMITY_RUN_H_
