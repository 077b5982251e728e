// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_BENCH_OTHER_PROGRAM_H_
#define TOUCHSTONE_TOOLS_BENCH_OTHER_PROGRAM_H_

#include <optional>
#include <string>
#include <vector>

#include "touchstone/tools/bench/convex_bench.h"

namespace touchstone {

// The path of a program beside the running one; nothing where there is none.
std::optional<std::string> ProgramBeside(const std::string& name);

// What `PROGRAM bench convex ARGUMENTS --json` prints, run as a child; nothing when it fails.
std::optional<std::vector<ConvexBenchRow>> RunConvexBenchOf(const std::string& program,
                                                            const std::string& arguments);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_BENCH_OTHER_PROGRAM_H_
