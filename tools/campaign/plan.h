// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_CAMPAIGN_PLAN_H_
#define TOUCHSTONE_TOOLS_CAMPAIGN_PLAN_H_

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "touchstone/tools/campaign/batch.h"
#include "touchstone/tools/campaign/contestant.h"

namespace touchstone {

// What a campaign asks of whom: with a seed, it fixes every query.
struct CampaignPlan {
  std::vector<const Suite*> suites;
  // Made anew in every process that asks: engines keep state.
  std::vector<std::string> engines;
  std::uint64_t seed = 1;
  SamplingRates rates;
};

// Said before each step, so that who watches knows what a process died of: the index, and the
// contestant's number or -1.
using SayPosition = std::function<void(std::uint64_t index, int contestant)>;

// Asks whole batches. One per process.
class BatchRunner {
 public:
  explicit BatchRunner(const CampaignPlan& plan);
  ~BatchRunner();

  // Every query but the fatal ones, which are counted as findings of their kind. A pure function of
  // plan, batch and fatal queries, but for the time. Exceptions of an engine are findings.
  BatchResult Run(const Batch& batch, std::span<const FatalQuery> fatal, const SayPosition& say);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_CAMPAIGN_PLAN_H_
