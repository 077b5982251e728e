// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_CAMPAIGN_SHRUNK_CASE_H_
#define TOUCHSTONE_TOOLS_CAMPAIGN_SHRUNK_CASE_H_

#include <string>

#include "touchstone/tools/campaign/plan.h"
#include "touchstone/tools/campaign/shrink.h"
#include "touchstone/tools/campaign/store.h"

namespace touchstone {

// Shrinks the query of a finding and writes FOLDER/cases/ENGINE-KIND.case. Returns its path within
// FOLDER; empty where the query, asked alone, does not show the finding. Throws BadInput where the
// file cannot be written.
std::string WriteShrunkCase(const StoredFinding& finding, const CampaignPlan& plan,
                            const std::string& folder, const ShrinkOptions& options);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_CAMPAIGN_SHRUNK_CASE_H_
