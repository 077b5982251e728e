// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_TOUCHSTONE_PROXIMITY_OUTPUT_H_
#define TOUCHSTONE_TOOLS_TOUCHSTONE_PROXIMITY_OUTPUT_H_

#include <iostream>

#include "touchstone/tools/judged_proximity.h"
#include "touchstone/tools/proximity_json.h"
#include "touchstone/tools/touchstone/body_arguments.h"

namespace touchstone {

// What `touchstone distance`, `depth` and `direction` say of one query that was judged as far as
// `depth` tells, if at all.
template <class Result>
Json DescribeQuery(const BodyArguments& arguments, const PlacedPair& pair,
                   const exact::ProximityJudgeOptions& depth, const Judged<Result>& query) {
  Json json = DescribeBodies(arguments, pair);
  json["certainty"] = arguments.certainty;
  json.update(ToJson(query.result));
  json["query_ns"] = query.query_ns;
  if (arguments.judge) {
    json["judge"] = {{"findings", ToJson(query.findings)},
                     {"constructed", depth.construct},
                     {"judge_ns", query.judge_ns}};
  }
  return json;
}

template <class Result>
void PrintQuery(const BodyArguments& arguments, const PlacedPair& pair,
                const exact::ProximityJudgeOptions& depth, const Judged<Result>& query) {
  PrintBodies(std::cout, arguments, pair);
  PrintResult(std::cout, query.result);
  if (arguments.judge) PrintFindings(std::cout, query.findings, depth.construct);
  PrintTimes(std::cout, query.query_ns, arguments.judge, query.judge_ns);
}

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_TOUCHSTONE_PROXIMITY_OUTPUT_H_
