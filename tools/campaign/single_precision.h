// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_CAMPAIGN_SINGLE_PRECISION_H_
#define TOUCHSTONE_TOOLS_CAMPAIGN_SINGLE_PRECISION_H_

#include <optional>

#include "touchstone/tools/campaign/contestant.h"

namespace touchstone {

// Whether all lengths of the query are where floats, and products of three of them, neither
// overflow nor vanish: beyond that there is no question to ask a single-precision engine.
bool IsInReachOfFloats(const PlacedPair& pair);

// Queries rounded to what floats hold exactly, so that a single-precision engine is judged on the
// very question it is asked.
class RoundedPairs {
 public:
  // The hulls of the vertices rounded to floats, under the pose rounded to floats. Nothing where
  // floats do not reach that far, or the rounded body is flat, or the rounded pose none.
  std::optional<PlacedPair> Round(const PlacedPair& pair);

 private:
  PerBody<std::optional<ConvexPolyhedron>> rounded_;
};

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_CAMPAIGN_SINGLE_PRECISION_H_
