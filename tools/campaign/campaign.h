// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_CAMPAIGN_CAMPAIGN_H_
#define TOUCHSTONE_TOOLS_CAMPAIGN_CAMPAIGN_H_

#include <atomic>
#include <cstdint>
#include <functional>

#include "touchstone/tools/campaign/plan.h"
#include "touchstone/tools/campaign/store.h"
#include "touchstone/tools/campaign/workers.h"

namespace touchstone {

// How far to go on: to `count` indices a suite (0: no end), for `minutes` (0: no end), or until
// `stop` is set, whichever is first.
struct CampaignLimits {
  std::uint64_t count = 0;
  double minutes = 0.0;
  const std::atomic<bool>* stop = nullptr;
};

struct CampaignProgress {
  double fraction = 0.0;                    // of the count, or else of the minutes
  std::uint64_t queries = 0, findings = 0;  // of this run
  double seconds = 0.0, seconds_left = 0.0;
};

enum class CampaignEnd { kComplete, kTimeIsUp, kStopped };

// Hands out the batches that are not done yet and stores what comes back. With a count the suites
// take turns, and the totals at the end are a function of plan and count alone: not of workers,
// nor of how many runs it took. Without one every suite gets the same time. What was handed out is
// waited for, whatever ended the run.
CampaignEnd RunCampaign(const CampaignPlan& plan, const CampaignLimits& limits,
                        CampaignStore& store, Workers& workers,
                        const std::function<void(const CampaignProgress&)>& report);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_CAMPAIGN_CAMPAIGN_H_
