// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_RESULT_JSON_H_
#define TOUCHSTONE_TOOLS_RESULT_JSON_H_

#include <array>
#include <iosfwd>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "touchstone/tools/judged_query.h"

namespace touchstone {

using Json = nlohmann::ordered_json;

// The parts that results are made of, for JSON and for a reader.
Json ToJson(const Eigen::Vector3d& v);
Json ToJson(const Feature& feature);
Json ToJson(const BoundedValue& value);
Json ToJson(const std::array<VertexPair, 3>& pairs);
Json ToJson(const Certificate& certificate);
std::string Text(const Feature& feature);
std::string Text(const Eigen::Vector3d& v);
std::string Text(const std::array<VertexPair, 3>& pairs);
std::string Text(const BoundedValue& value);
void PrintCertificate(std::ostream& out, const Certificate& certificate);

// The words of core/cd_dual/result.h as keys and values.
Json ToJson(const CollideResult& result);
Json ToJson(const std::vector<NamedFinding>& findings);

// The result as lines for a reader: verdict, tier, face, d, g, certificate, and the trace when
// there is one.
void PrintResult(std::ostream& out, const CollideResult& result);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_RESULT_JSON_H_
