// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_PROXIMITY_REPORT_H_
#define TOUCHSTONE_TOOLS_PROXIMITY_REPORT_H_

#include <iosfwd>
#include <vector>

#include "touchstone/tools/proximity_run.h"
#include "touchstone/tools/result_json.h"

namespace touchstone {

// Findings in all but the published construction.
std::uint64_t ProvenFindings(const std::vector<SuiteProximity>& suites);

// Counts per suite and query, and the findings.
void PrintProximity(std::ostream& out, const std::vector<SuiteProximity>& suites);
// `results`: one object a suite and query with suite, query, seed, queries, answers,
// exact_fallbacks, warm, findings (kind -> count), samples, median_ns, judged_per_second; `total`.
Json ProximityJson(const VerifyOptions& options, const std::vector<SuiteProximity>& suites);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_PROXIMITY_REPORT_H_
