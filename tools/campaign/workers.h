// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_CAMPAIGN_WORKERS_H_
#define TOUCHSTONE_TOOLS_CAMPAIGN_WORKERS_H_

#include <memory>
#include <vector>

#include "touchstone/tools/campaign/plan.h"

namespace touchstone {

// Those who run batches: processes on this machine, or ranks of a cluster.
class Workers {
 public:
  virtual ~Workers() = default;

  // How many more batches may be handed out now.
  virtual int Free() const = 0;
  // Requires Free() > 0.
  virtual void Give(const Batch& batch) = 0;
  // Results that have come in; waits up to `seconds` for the first.
  virtual std::vector<BatchResult> Collect(double seconds) = 0;
  // How many batches are handed out and have not come back.
  virtual int Running() const = 0;
};

// `count` child processes. One that crashes, or that stays at one query for `hang_seconds`, is
// replaced, and its batch run again without the query that ended it, which becomes a finding. The
// children end with this process, however it ends, and leave signals from a terminal to it.
// Requires a process without threads (it forks). `plan` outlives the workers.
std::unique_ptr<Workers> MakeLocalWorkers(const CampaignPlan& plan, int count, double hang_seconds);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_CAMPAIGN_WORKERS_H_
