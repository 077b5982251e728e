// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_RESULT_JSON_H_
#define TOUCHSTONE_TOOLS_RESULT_JSON_H_

#include <iosfwd>
#include <nlohmann/json.hpp>

#include "touchstone/tools/judged_query.h"

namespace touchstone {

using Json = nlohmann::ordered_json;

// The words of core/cd_dual/result.h as keys and values.
Json ToJson(const CollideResult& result);
Json ToJson(const std::vector<NamedFinding>& findings);

// The result as lines for a reader: verdict, tier, face, d, g, certificate, and the trace when
// there is one.
void PrintResult(std::ostream& out, const CollideResult& result);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_RESULT_JSON_H_
