// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_BENCH_CONVEX_REPORT_H_
#define TOUCHSTONE_TOOLS_BENCH_CONVEX_REPORT_H_

#include <iosfwd>
#include <span>

#include "touchstone/tools/bench/convex_bench.h"
#include "touchstone/tools/bench/targets.h"
#include "touchstone/tools/result_json.h"

namespace touchstone {

// The rows of modes repeat, mixed and warm: `engine, shape, n, gap, mode, median_ns, queries,
// wrong, undecided`.
Json ConvexBenchJson(std::span<const ConvexBenchRow> rows);

// The same columns, all modes.
void WriteConvexBenchCsv(std::ostream& out, std::span<const ConvexBenchRow> rows);

enum class TableStyle { kText, kMarkdown };

// A table for each shape, n and mode: an engine a line, a gap a column, then its wrong and its
// undecided answers over all gaps.
void PrintConvexBench(std::ostream& out, std::span<const ConvexBenchRow> rows, TableStyle style);
// What a reader wants first: ellipsoids 2:1:1, our default against the fastest other without a
// wrong verdict in these rows, a mode and n a line, a gap a column.
void PrintSummary(std::ostream& out, std::span<const ConvexBenchRow> rows, TableStyle style);
void PrintTargets(std::ostream& out, std::span<const Target> targets, TableStyle style);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_BENCH_CONVEX_REPORT_H_
