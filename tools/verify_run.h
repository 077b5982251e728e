// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_VERIFY_RUN_H_
#define TOUCHSTONE_TOOLS_VERIFY_RUN_H_

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "touchstone/core/cd_dual/cd_dual.h"
#include "touchstone/tools/judged_query.h"
#include "touchstone/tools/suites/suite.h"

namespace touchstone {

// Durations by count: every nanosecond up to 64, then 64 bins an octave, so that a quantile is
// right to 1.6 % whatever the number of samples.
class DurationHistogram {
 public:
  void Add(double nanoseconds);
  void Merge(const DurationHistogram& other);
  double Median() const;  // 0 when empty

 private:
  std::array<std::uint64_t, 64 * 40> bins_{};
  std::uint64_t total_ = 0;
};

// A combination of what can happen to a query. `face_class` is "none" where no face is owed.
using CoverageKey = std::tuple<Search, std::string, Phase, Verdict>;

// What became of the queries of one suite in one search.
struct SearchStats {
  std::uint64_t queries = 0;
  std::array<std::uint64_t, 4> verdicts{};  // by Verdict
  std::array<std::uint64_t, 4> tiers{};     // by Tier
  std::map<std::string, std::uint64_t> findings, rounding_findings;
  std::uint64_t failed_queries = 0;  // with at least one finding
  std::uint64_t n_at_least_100 = 0;  // the larger body has 100 vertices or more
  std::uint64_t early_exits_asked = 0;
  std::uint64_t phase_maxima_checked = 0;
  std::uint64_t constructed = 0;  // judged in the construction tier, too
  std::uint64_t twin_runs = 0;    // replays of the published pseudocode
  DurationHistogram search_ns;
  double judge_seconds = 0.0;
  std::map<CoverageKey, std::uint64_t> coverage;

  void Merge(const SearchStats& other);
  std::uint64_t FindingCount() const;
};

enum class EarlyExit { kNever, kAlways, kMixed };

// How far the judge looks at each query.
enum class Depth {
  kProof,   // certificates and values in O(m + n); the published pseudocode only where a query
            // failed
  kPhases,  // also the phase maxima, O(mn)
  kMixed,   // also phase maxima, construction and pseudocode: always for small bodies, else on a
            // sample
  kFull,    // everything at every query
};

struct VerifyOptions {
  std::vector<const Suite*> suites;
  std::vector<Search> searches;
  std::uint64_t seed = 1;
  std::uint64_t first = 0;  // the first index
  // Indices per suite, or, when 0, as many as `minutes` allow: every suite gets the same time.
  std::uint64_t count = 0;
  double minutes = 0.0;
  int threads = 1;
  Certainty certainty = Certainty::kExact;
  // Mixed: every fourth query of the proven searches asks for an early exit; the published never
  // does.
  EarlyExit early_exit = EarlyExit::kMixed;
  Depth depth = Depth::kMixed;
  std::string cases_dir;  // where failing queries are written; empty: nowhere
};

struct SuiteStats {
  std::string suite;
  std::vector<SearchStats> by_search;  // in step with VerifyOptions::searches
};

struct Progress {
  double fraction;
  std::uint64_t queries, findings;
};

// Runs the suites through the searches and the judge. With a count, all totals but the times depend
// on suites, seed and count alone, not on threads. `report`, when given, is called a few times a
// second.
std::vector<SuiteStats> RunVerify(const VerifyOptions& options,
                                  const std::function<void(const Progress&)>& report);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_VERIFY_RUN_H_
