// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_PROXIMITY_JSON_H_
#define TOUCHSTONE_TOOLS_PROXIMITY_JSON_H_

#include <iosfwd>

#include "touchstone/core/proximity/result.h"
#include "touchstone/tools/result_json.h"

namespace touchstone {

// The words of core/proximity/result.h as keys and values; parts that a result of its kind does not
// have are left out.
Json ToJson(const DistanceResult& result);
Json ToJson(const PenetrationResult& result);
Json ToJson(const DirectionalResult& result);
Json ToJson(const PublishedTravel& result);

// The result as lines for a reader.
void PrintResult(std::ostream& out, const DistanceResult& result);
void PrintResult(std::ostream& out, const PenetrationResult& result);
void PrintResult(std::ostream& out, const DirectionalResult& result);
void PrintResult(std::ostream& out, const PublishedTravel& result);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_PROXIMITY_JSON_H_
