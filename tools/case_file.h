// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_CASE_FILE_H_
#define TOUCHSTONE_TOOLS_CASE_FILE_H_

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include "touchstone/core/cd_dual/cd_dual.h"
#include "touchstone/tools/loaded.h"
#include "touchstone/tools/suites/suite.h"

namespace touchstone {

// One query that failed, with all that it takes to ask it again: the format is described in
// tools/README.md. Numbers are short decimals or hexadecimal doubles, so that nothing is lost.
struct CaseFile {
  std::string suite;  // where it came from; for the reader
  std::uint64_t seed = 0;
  std::uint64_t index = 0;
  Search search = Search::kPortal;
  Certainty certainty = Certainty::kExact;
  bool early_exit = false;
  std::string finding;  // its kind, or "none"
  std::string detail;   // one line
  PlacedPair pair;
  // Who was asked, when it was not `search`: a contestant of a campaign (campaign/contestant.h).
  std::string engine = {};
  // What the case shows, for the reader: comment lines. Not read back.
  std::vector<std::string> caption = {};
};

void WriteCase(std::ostream& out, const CaseFile& query);

// An error names the file and the line.
Loaded<CaseFile> ReadCase(const std::string& path);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_CASE_FILE_H_
