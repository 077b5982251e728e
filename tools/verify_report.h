// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_VERIFY_REPORT_H_
#define TOUCHSTONE_TOOLS_VERIFY_REPORT_H_

#include <cstdint>
#include <iosfwd>
#include <vector>

#include "touchstone/tools/result_json.h"
#include "touchstone/tools/verify_run.h"

namespace touchstone {

// Findings by whom they count against.
struct VerifyTotals {
  std::uint64_t queries = 0;
  std::uint64_t proven_findings = 0;     // in kPhased and kPortal: there must be none
  std::uint64_t published_findings = 0;  // in kPublished, by its exact replay
};
VerifyTotals Total(const VerifyOptions& options, const std::vector<SuiteStats>& stats);

// {"results": one object a suite and search, "coverage": ..., "total": ...}.
Json VerifyJson(const VerifyOptions& options, const std::vector<SuiteStats>& stats);

// One row a suite, then what was found, then the closing line.
void PrintVerify(std::ostream& out, const VerifyOptions& options,
                 const std::vector<SuiteStats>& stats);
// Every combination that occurred, with its count.
void PrintCoverage(std::ostream& out, const VerifyOptions& options,
                   const std::vector<SuiteStats>& stats);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_VERIFY_REPORT_H_
